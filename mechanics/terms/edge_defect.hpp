#pragma once
// Edge-defect stabilisation of nodal integration: a penalty on what the smoothed gradients of two neighbours
// do not explain of their relative motion. Objective, zero on linear fields, and without λ, so that it does
// not lock (docs/theory.md, "Weak modes").
#include "mechanics/terms/term.hpp"

namespace cnem {

/// r_ij = x_j − x_i − ½(F_i + F_j) X_ij on each link, E = ½ Σ k_ij |r_ij|², k_ij = α ½(μ̃_i + μ̃_j) L_ij/d_ij.
///
/// μ̃ is the secant shear modulus μ e/(e + ε̄p), e = σ_y/3μ: with the elastic one the penalty would carry
/// stress that the flowing metal cannot. Energy released when k falls is reported, so that the ledger closes.
template<int dim> class EdgeDefect : public Term<dim> {
public:
  /// alpha: dimensionless factor, 0.05 restores the free-plate frequencies. 0 switches the stabilisation off.
  /// failing: plies may fail; a link has the smaller of μ̃_i and μ̃_j in the place of their mean, in the plane
  /// (mechanics/failing_links.hpp).
  explicit EdgeDefect(double alpha, bool failing = false) : alpha_(alpha), failing_(failing) {}

  bool active(const StabilisationLinks<dim>& links) const { return alpha_ > 0.0 && !links.neighbour.empty(); }

  /// The moduli at the start, [node] Pa.
  void reset(const Field& shear_modulus) { modulus_before_ = modulus_ = shear_modulus; }

  /// Stores what `apply` reads of the nodes [begin, end), F, moduli and places in the reference (side by
  /// side), of a state that no step has made.
  void store_records(const Fields<tensor_size<dim>>& deformation, const Field& reference, std::size_t begin,
                     std::size_t end);

  /// Takes the moduli of the nodes [begin, end) back to what they were before the step: with local time steps
  /// they change only where all links are due.
  void hold_moduli(std::size_t begin, std::size_t end);

  /// Adds k r to the force of the nodes [begin, end) and the penalty's share −½ Σ_j k r ⊗ X_ij / V_i to their
  /// first Piola stress. `position` side by side; volume [node]. Expects `store_records` of all nodes.
  EdgeEnergy apply(const StabilisationLinks<dim>& links, const Field& volume, const Field& position,
                   ColumnStress<dim>& stress, Fields<dim>& force, std::size_t begin, std::size_t end) const;

  FieldTable* fields() override { return &table_; }
  std::vector<Energy*> energies() override { return {&stored_, &released_}; }
  void limit(const Body<dim>& body, StepLimit& limit) override;
  void start(const Body<dim>& body) override { reset(body.state.point.shear_modulus); }
  void release() override { record_ = Field(); }
  void leave(const Body<dim>& body) override;
  void renew(const Body<dim>& body) override;
  void begin_stress(const Body<dim>& body, const DuePoints& due) override;
  void after_stress(const Body<dim>& body, const DuePoints& due, const LevelRange& range) override;
  void begin_forces(const Body<dim>& body, int activity) override;
  void add_forces(const Body<dim>& body, int activity, const LevelRange& range) override;
  void end_forces(const Body<dim>& body, int activity) override;
  void attach(const Body<dim>& body) override { restore(body); }
  void restore(const Body<dim>& body) override;

private:
  /// What each step renews beside the stresses (mechanics/terms/bulk_viscosity.hpp): secant moduli and
  /// records.
  EdgePoints points(const PointState<dim>& point) {
    return {point.shear_modulus.data(), point.plastic_strain.data(), modulus_.data(), modulus_before_.data(),
            record_.data()};
  }

  double alpha_;
  bool failing_;
  FieldTable table_{"solver/point"};
  /// μ̃ of this step and of the step before
  ScalarField modulus_{table_, {"penalty_modulus", "Pa", Carry::mass_mean, Checkpoint::holds}};
  ScalarField modulus_before_{table_, {"penalty_modulus_before", "Pa", Carry::renewed, Checkpoint::holds}};
  Field record_;                   ///< [node] as edge_defect of mechanics/step_kernels.hpp reads them
  std::vector<EdgeEnergy> energy_; ///< [range]
  Energy stored_{"stabilisation", EnergyKind::held};
  Energy released_{"penalty_release", EnergyKind::dissipated};
};

extern template class EdgeDefect<2>;
extern template class EdgeDefect<3>;

} // namespace cnem
