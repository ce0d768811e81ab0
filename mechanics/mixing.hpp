#pragma once
// The elastic state of stress points that are made of the matter of several.
#include "core/fields/state.hpp"
#include "core/operators/parcels.hpp"
#include "plasticity/material.hpp"

#include <vector>

namespace cnem {

/// (1 − ω)⟨θ − opening⟩² of each point, θ the dilatation: the energy of its tension over κ/2. Expects b_e in
/// place of C_p⁻¹ (push_forward). Empty without damage.
template<int dim>
Field held_tension(const std::vector<plasticity::Material>& materials, const PointState<dim>& point);

/// ln b_e averaged over the parcels of a point, so that the mean is objective and its volume change additive,
/// drawn back to the yield surface of the averaged state without counting plastic work. Where broken matter
/// is mixed with sound matter its gap must not come to bear on the latter: as much of the dilatation becomes
/// an opening as leaves no more than the tension that the parts held. Expects all other fields of the points
/// carried over already; mass [old point] kg/m^(3−dim); tension: held_tension() carried over; elastic_volume
/// [new point]: the volume over the stress-free one, –, where cells tile the matter, else empty. Plies are
/// left to set_plies (mechanics/ply_mixing.hpp).
template<int dim>
void mix_elastic(const PointRows& parcels, const Field& mass, const Field& tension,
                 const Field& elastic_volume, const std::vector<plasticity::Material>& materials,
                 PointState<dim>& point);

} // namespace cnem
