#pragma once
// Rubs out the noise of stress that freezes where metal ceases to flow, so that residual stresses can be read.
#include "mechanics/terms/term.hpp"

namespace cnem {

/// On every new reference the elastic strains of nodes that have lately ceased to flow are drawn towards what
/// is linear between neighbours (mechanics/terms/link_smoother.hpp), each the weaker the longer ago it flowed:
/// s = e^(−n/K) with n references since. Volumes and first moments of ln b_e are kept, what is linear is
/// untouched, deviators are drawn back to yield; the stored energy that goes is booked.
template<int dim> class StressAnnealing : public Term<dim> {
public:
  /// strength: c, – .
  explicit StressAnnealing(double strength) : strength_(strength) {}

  FieldTable* fields() override { return &table_; }
  std::vector<Energy*> energies() override { return {&dissipated_}; }
  void stressed(const Body<dim>& body) override;

private:
  Field shares(const PointState<dim>& point);

  double strength_;
  FieldTable table_{"solver/point"};
  /// ε̄p on the last reference
  ScalarField strain_before_{table_, {"strain_before", "1", Carry::mass_mean, Checkpoint::holds}};
  /// references since it last flowed
  ScalarField idle_{table_, {"references_without_flow", "1", Carry::mass_mean, Checkpoint::holds}};
  Energy dissipated_{"stress_annealing", EnergyKind::dissipated};
};

} // namespace cnem
