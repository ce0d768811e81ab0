#pragma once
// Finite-strain return mapping in logarithmic strain, paper 004 Box 2, for ranges of stress points.
#include "core/fields/state.hpp"
#include "plasticity/material.hpp"
#include "plasticity/stress_points.hpp"

#include <cstdint>
#include <vector>

namespace cnem::plasticity {

/// Pointers into the fields of `state`; valid until one of them is resized.
template<int dim> StressPoints<dim> stress_points(PointState<dim>& state);

/// Brings the stress of the points [begin, end) to t_{n+1} (paper 004, Box 2): elastic trial from F and
/// C_p⁻¹, radial return to the flow stress at the step's mean rate Δγ/dt, then P, energies and C_p⁻¹.
///
/// dt > 0 in s; dt = 0 evaluates the stress of the state as it is, without flow, and keeps plastic_rate.
/// The result at a point depends on that point alone, to the last bit, however ranges are cut (for one
/// instruction set, core/machine/isa.hpp).
/// Returns the first point whose input or result means nothing (det F ≤ 0, C_p⁻¹ not positive definite,
/// negative temperature or strain, any NaN), or −1. Such points are left as they were; the others are
/// updated.
template<int dim>
std::ptrdiff_t update_stress(const Material& material, const StressPoints<dim>& points, std::ptrdiff_t begin,
                             std::ptrdiff_t end, double dt);

/// The same for points of several materials: material[p] is the index into `materials` of point p.
template<int dim>
std::ptrdiff_t update_stress(const std::vector<Material>& materials,
                             const std::vector<std::int32_t>& material, const StressPoints<dim>& points,
                             std::ptrdiff_t begin, std::ptrdiff_t end, double dt);

} // namespace cnem::plasticity
