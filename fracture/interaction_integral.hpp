#pragma once
// Stress intensity factors from the interaction integral in domain form (paper 004, 5.4.1).
#include "core/operators/operators.hpp"
#include "fracture/crack_tip.hpp"
#include "fracture/williams.hpp"

#include <vector>

namespace cnem::fracture {

/// A solved field of plane elasticity at stress points.
struct ElasticField {
  const DiscreteOperators<2>& operators; ///< columns beyond the nodes (enrichment) do not matter here
  const std::vector<Vec2>& node;         ///< [node] m
  const std::vector<Vec2>& position;     ///< [point] m
  const Fields<5>& gradient;             ///< [·][point] ∇u as in PointState::deformation
  const Fields<4>& stress;               ///< [·][point] Pa
};

/// q = 1 within `inner` of the tip, falls linearly to 0 at `outer`; m.
struct Ring {
  double inner = 0.0, outer = 0.0;
};

struct StressIntensity {
  double K_I = 0.0, K_II = 0.0; ///< Pa √m
};

/// K = ½ E' I, I = ∫ (σ_ij u^a_i,1 + σ^a_ij u_i,1 − σ^a_kl ε_kl δ_1j) q_,j dA − ∫ t·u^a_,1 q dΓ, `a` the
/// field of unit stress intensity; q is nodal. `loads`: tractions on facets within the ring, those on the
/// faces of the crack above all.
StressIntensity stress_intensity(const CrackTip& tip, const Ring& ring, const PlaneElasticity& elasticity,
                                 const ElasticField& field, const std::vector<FacetLoad>& loads);

/// Rings from small to large, the default one last: the outer radius is 0.7 of what the crack, its straight
/// piece and the nearest boundary leave, the inner one half of it; the others are 0.85, 0.7 and 0.55 times
/// that.
std::vector<Ring> default_rings(const CrackTip& tip);

} // namespace cnem::fracture
