#pragma once
// Edge-defect stabilisation of nodal integration: a penalty on what the smoothed gradients of two neighbours
// do not explain of their relative motion. Objective, zero on linear fields, and without λ, so that it does
// not lock (docs/theory.md, "Weak modes").
#include "core/archive.hpp"
#include "core/discretisation.hpp"
#include "core/resampling.hpp"
#include "core/state.hpp"
#include "mechanics/kinematics.hpp"
#include "mechanics/step_kernels.hpp"

namespace cnem {

/// r_ij = x_j − x_i − ½(F_i + F_j) X_ij on each link, E = ½ Σ k_ij |r_ij|², k_ij = α ½(μ̃_i + μ̃_j) L_ij/d_ij.
///
/// μ̃ is the secant shear modulus μ e/(e + ε̄p), e = σ_y/3μ: with the elastic one the penalty would carry
/// stress that the flowing metal cannot. Energy released when k falls is reported, so that the ledger closes.
template<int dim> class EdgeDefect {
public:
  /// alpha: dimensionless factor, 0.05 restores the free-plate frequencies. 0 switches the stabilisation off.
  explicit EdgeDefect(double alpha) : alpha_(alpha) {}

  bool active(const StabilisationLinks<dim>& links) const { return alpha_ > 0.0 && !links.neighbour.empty(); }

  /// Links of a new reference: its penalty starts from zero defect with the moduli as they stand. [node]
  /// shear_modulus in Pa.
  void reset(const Field& shear_modulus);

  /// What each step renews beside the stresses (mechanics/terms/bulk_viscosity.hpp): secant moduli and
  /// records.
  EdgePoints points(const Field& shear_modulus, const Field& plastic_strain) {
    return {shear_modulus.data(), plastic_strain.data(), modulus_.data(), modulus_before_.data(),
            record_.data()};
  }

  /// Stores what `apply` reads of the nodes [begin, end), F and moduli, of a state that no step has made.
  void store_records(const Fields<tensor_size<dim>>& deformation, std::size_t begin, std::size_t end);

  /// Takes the moduli of the nodes [begin, end) back to what they were before the step: with local time steps
  /// they change only where all links are due.
  void hold_moduli(std::size_t begin, std::size_t end);

  /// Adds k r to the force of the nodes [begin, end) and the penalty's share −½ Σ_j k r ⊗ X_ij / V_i to their
  /// first Piola stress. `reference` and `position` side by side; volume [node]. Expects `store_records` of
  /// all nodes.
  EdgeEnergy apply(const StabilisationLinks<dim>& links, const Field& volume, const Field& reference,
                   const Field& position, ColumnStress<dim>& stress, Fields<dim>& force, std::size_t begin,
                   std::size_t end) const;

  /// The moduli go with the matter of a resampled cloud; `mass` [old node].
  void carry_over(const NodeRows& parcels, const Field& mass) { carry_mean(parcels, mass, modulus_); }

  /// Carries the moduli out or in.
  void archive(Archive& archive);

private:
  double alpha_;
  Field modulus_;        ///< [node] μ̃ of this step, Pa
  Field modulus_before_; ///< [node] μ̃ of the step before, Pa
  Field record_;         ///< [node] as edge_defect of mechanics/step_kernels.hpp reads them
};

extern template class EdgeDefect<2>;
extern template class EdgeDefect<3>;

} // namespace cnem
