#pragma once
// Ductile damage by any law of plasticity/damage_laws/list.hpp with softening regularised by the fracture
// energy (Hillerborg, Modéer, Petersson 1976), as a pass of its own after the return map.
#include "core/fields/state.hpp"
#include "plasticity/damage_points.hpp"
#include "plasticity/material.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace cnem::plasticity {

/// What the pass over a range has changed beside the fields.
struct DamageSums {
  double released = 0.0; ///< J/m^(3−dim), elastic energy of tension let go as points break, ≥ 0
};

/// Share of its flow stress that a point of a material with damage has left, for its softening and a pressure
/// (Pa): broken matter under pressure rubs (Breaking::friction), with √3 times the strength in shear.
template<int dim>
double flow_share(const Material& material, const PointState<dim>& point, std::size_t p, double pressure);

/// Pointers into the fields of `state` and to lengths [point], m, volumes [point] and openings [point], –;
/// valid until one of them is resized.
template<int dim>
DamagePoints<dim> damage_points(PointState<dim>& state, const Field& length, const Field& volume,
                                const Field& opening);

/// Takes the points [begin, end) from the stress that update_stress has just made (with the flow stress
/// lowered by the softening ω of the last step) to the damaged one:
///
///   dD = dε̄p/ε_f until softening is initiated;  d(1 − ω)² = −σ_eq dε̄p ℓ/G_f,
///
/// so that a band of thickness ℓ takes G_f per area whatever it hardens and however long ℓ is, and 1 − ω
/// falls linearly with ℓ ε̄p at constant flow stress. The mean stress is multiplied by 1 − ω in tension and
/// kept in compression, in P, pressure and stored energy; what that lets go of the stored energy is returned.
/// In plane stress every tension is flow's to take, and what is left of it is ω's: nothing else is done
/// there. Dilatation up to the opening of a point, a gap that it holds, makes no tension. dt = 0: nothing
/// evolves. Points of materials without damage are left alone. material[p] as for update_stress.
template<int dim>
DamageSums update_damage(const std::vector<Material>& materials, const std::vector<std::int32_t>& material,
                         const DamagePoints<dim>& points, std::ptrdiff_t begin, std::ptrdiff_t end,
                         double dt);

} // namespace cnem::plasticity
