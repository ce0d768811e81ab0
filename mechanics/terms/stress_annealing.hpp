#pragma once
// Rubs out the noise of stress that freezes where metal ceases to flow, so that residual stresses can be
// read.
#include "mechanics/terms/term.hpp"

namespace cnem {

/// What of A is due in the time `elapsed` before t, the time without flow, of a node that flowed for t_f, s.
double annealing_due(double idle, double elapsed, double flow_time);

/// On every new reference the elastic strains of nodes that have lately ceased to flow are drawn towards what
/// is linear between neighbours (mechanics/terms/link_smoother.hpp). A node that flowed for t_f in all and is
/// idle since t < 5 τ, τ = 3 t_f, takes part with
///
///   s = A (e^(−(t − Δt)/τ) − e^(−t/τ)),  A = 100,
///
/// Δt since the last reference: A in all, however often references are renewed. Volumes and first moments of
/// ln b_e are kept, what is linear is untouched, deviators are drawn back to yield; the stored energy that
/// goes is booked. Softened nodes take no part.
template<int dim> class StressAnnealing : public Term<dim> {
public:
  /// strength: c, – .
  explicit StressAnnealing(double strength) : strength_(strength) {}

  FieldTable* fields() override { return &table_; }
  std::vector<Energy*> energies() override { return {&dissipated_}; }
  void stressed(const Body<dim>& body, Booked& booked) override;
  void end_step(const Body<dim>&, double dt) override { elapsed_ += dt; }
  void archive(Archive& archive) override { archive.number("solver/annealing/elapsed", "s", elapsed_); }

private:
  Field shares(const PointState<dim>& point);

  double strength_;
  FieldTable table_{"solver/point"};
  /// ε̄p on the last reference
  ScalarField strain_before_{table_, {"strain_before", "1", Carry::mass_mean, Checkpoint::holds}};
  ScalarField idle_{table_, {"time_without_flow", "s", Carry::mass_mean, Checkpoint::holds}};
  ScalarField flow_time_{table_, {"flow_time", "s", Carry::mass_mean, Checkpoint::holds}};
  double elapsed_ = 0.0; ///< s, since the last reference
  Energy dissipated_{"stress_annealing", EnergyKind::dissipated};
};

} // namespace cnem
