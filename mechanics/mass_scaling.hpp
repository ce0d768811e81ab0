#pragma once
// More inertia than mass, so that slow processes can take longer steps.
#include "core/fields/state.hpp"
#include "core/operators/operators.hpp"

namespace cnem {

/// What is asked for; by default nothing.
struct MassScaling {
  double factor = 1.0; ///< – on the inertia of all nodes, ≥ 1
  double step = 0.0;   ///< s, stable step wanted of each cloud, safety included; 0: none
  double cell = 0.0;   ///< m: that of square cells so wide, instead of `step`; 0: none

  bool active() const { return factor != 1.0 || wants_step(); }
  bool wants_step() const { return step > 0.0 || cell > 0.0; }
};

/// Factors ≥ 1 on the masses of nodes, [node], such that the bound on ω² of mechanics/stable_step.hpp is at
/// most `most` (1/s²): only nodes of cells that limit the step grow heavier. deformation [component][point],
/// wave_modulus [point] λ + 2μ in Pa, mass [node]. rounds: of making factors smaller, each of two bounds;
/// with none the bound is `most` only about, from one bound.
template<int dim>
Field scales_for_frequency(const DiscreteOperators<dim>& operators,
                           const Fields<tensor_size<dim>>& deformation, const Field& wave_modulus,
                           const Field& mass, double most, int rounds);

extern template Field scales_for_frequency<2>(const DiscreteOperators<2>&, const Fields<5>&, const Field&,
                                              const Field&, double, int);
extern template Field scales_for_frequency<3>(const DiscreteOperators<3>&, const Fields<9>&, const Field&,
                                              const Field&, double, int);

} // namespace cnem
