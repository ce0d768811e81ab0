#pragma once
// Edge-defect stabilisation of nodal integration: a penalty on what the smoothed gradients of two neighbours
// do not explain of their relative motion. Objective, zero on linear fields, and without λ, so that it does
// not lock (docs/theory.md, "Weak modes").
#include "core/archive.hpp"
#include "core/discretisation.hpp"
#include "core/state.hpp"

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

  /// Secant moduli of the nodes [begin, end) for the step that follows. flow_stress and shear_modulus in Pa.
  void update_modulus(const Field& shear_modulus, const Field& flow_stress, const Field& plastic_strain,
                      std::size_t begin, std::size_t end);

  struct Energy {
    double stored = 0.0;   ///< J/m^(3−dim) ½ Σ k |r|² of the block's half of its links
    double released = 0.0; ///< J/m^(3−dim) given up by falling moduli in this step
  };

  /// Adds k r to the force of the nodes [begin, end) and the penalty's share −½ Σ_j k r ⊗ X_ij / V_i to their
  /// first Piola stress. Rows of `operators` are nodes.
  Energy apply(const StabilisationLinks<dim>& links, const DiscreteOperators<dim>& operators,
               const Fields<dim>& reference, const Fields<dim>& position,
               const Fields<tensor_size<dim>>& deformation, Fields<tensor_size<dim>>& piola,
               Fields<dim>& force, std::size_t begin, std::size_t end) const;

  /// Carries the moduli out or in.
  void archive(Archive& archive);

private:
  double alpha_;
  Field modulus_;        ///< [node] μ̃ of this step, Pa
  Field modulus_before_; ///< [node] μ̃ of the step before, Pa
};

extern template class EdgeDefect<2>;
extern template class EdgeDefect<3>;

} // namespace cnem
