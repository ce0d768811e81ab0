#pragma once
// Springback: how far a body moves when all that pressed on it is taken away, and what stress stays in it.
#include "core/fields/state.hpp"
#include "core/operators/discretisation.hpp"
#include "mechanics/supports.hpp"
#include "plasticity/material.hpp"

#include <vector>

namespace cnem {

/// A body under stress, in the configuration x it has on a reference X. References must outlive it.
struct StressedBody {
  const Approximation<2>& approximation; ///< on the reference
  const PointState<2>& point;            ///< F, P, temperature and the material of each point are read
  const Fields<2>& position;             ///< [k][node] m, present
  const Field& mass;                     ///< [node] kg/m (kg of revolution)
  const std::vector<plasticity::Material>& materials;
  const Supports<2>& supports;      ///< its planes of symmetry stay, what else it holds is let go
  double stabilisation = 0.05;      ///< α of the edge defect, on μ
  const Field* cooled_to = nullptr; ///< [node] K, what the body is brought to; null: temperatures stay
};

struct Springback {
  Fields<2> displacement;         ///< [k][node] m, from the present to the unloaded configuration
  std::vector<std::int32_t> body; ///< [node] connected part, numbered from 0 in the order of first nodes
  int bodies = 0;
  double energy = 0.0;   ///< J/m (J), ½ uᵀ K u: without cooling the elastic energy given back
  double residual = 0.0; ///< – force left where bodies were pinned, over the largest nodal force: rounding
  Fields<4> stress_change; ///< [·][point] Pa, what is added to the Cauchy stress: xx, yy, zz (hoop), xy
};

/// Solves K u = −Σ V (σ + s 1) b once, σ the Cauchy stress, s = −3κα ΔT what cooling by ΔT < 0 would make
/// where nothing gives: both are taken off by linear elasticity (λ, μ, α of each point, also of damaged ones)
/// on the operators pushed forward to the present configuration, with the edge defect of
/// mechanics/statics/statics. σ + s 1 + D ∇u stays. First order in σ/E and in the turn of the bodies. What
/// the penalty and the bulk viscosity held at the end of the run is dropped, as at a new reference.
///
/// Rigid motion is taken out by inertia relief: internal forces have neither resultant nor moment, so that no
/// acceleration remains, and each part keeps its mean position and angle, weighted with mass, as far as
/// planes of symmetry leave them free. Throws InputError when K cannot be factorised.
Springback springback(const StressedBody& body);

} // namespace cnem
