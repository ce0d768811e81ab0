#pragma once
// Plane stress of metals: the strain out of the plane that leaves no stress there.
#include "plasticity/material.hpp"
#include "plasticity/stress_points.hpp"

namespace cnem::plasticity {

/// A return map of the plane with the strain out of it that is given (plasticity/return_map.hpp).
using PlaneReturn = std::ptrdiff_t (*)(const Material&, const StressPoints<2>&, std::ptrdiff_t begin,
                                       std::ptrdiff_t end, double dt);

/// update_stress of the points [begin, end) with F_zz = thickness, the present over the initial one, found by
/// a secant on τ_zz from that of t_n; C_p⁻¹_zz stays that of the initial thickness when the reference is
/// renewed, so that P, energies and V_stress-free/V_reference are per initial thickness.
/// Broken matter, ω = 1, does not grow thicker than at the start, or than it is: closed cracks bear pressure.
/// Returns the first point that means nothing or finds no thickness, or −1.
std::ptrdiff_t update_plane_stress(PlaneReturn given, const Material& material, const StressPoints<2>& points,
                                   std::ptrdiff_t begin, std::ptrdiff_t end, double dt);

} // namespace cnem::plasticity
