#pragma once
// The largest step central differences can take, from a rigorous bound on the highest frequency.
#include "core/fields/archive.hpp"
#include "core/fields/state.hpp"
#include "core/operators/operators.hpp"
#include "mechanics/step_kernels.hpp"
#include "mechanics/ties.hpp"

#include <vector>

namespace cnem {

/// Bound on the largest eigenvalue of M⁻¹ Gᵀ V k G for scalar weights M at nodes and moduli k at stress
/// points, on the current configuration (b = F⁻ᵀ b_r, V = V_r det F):
///
///   λ ≤ max_p (A x)_p / x_p,  (A x)_p = k_p Σ_J |b_pJ| (1/M_J) Σ_q V_q |b_qJ| x_q
///
/// for any x > 0: A holds the norms of blocks at stress points and is not negative, so that its spectral
/// radius is below the largest quotient (Collatz 1942, Wielandt 1950); x = 1 gives Gershgorin's rows. With k
/// = λ + 2μ it bounds ω² of elastic waves, with the conductivity the decay rate of heat. Moves with |F⁻ᵀ b| ≤
/// the bound's own tensor norm, so it holds for any F. Of revolution |b| becomes max(|b + h e_r|, √(|b|² +
/// h²)), which bounds the energy norm of u ↦ (u ⊗ b, u_r h) for λ ≥ 0. Tied nodes are one column: the sum of
/// their blocks has no more than the sum of their norms, and their masses add up.
template<int dim> class SpectralBound {
public:
  struct Result {
    double value;      ///< 1/s² (or 1/s for heat)
    std::size_t point; ///< row that attains it
  };
  /// Gershgorin's bound (x = 1) of each of the ranges of `width` points; width divides block_size.
  std::vector<Result> of_ranges(const DiscreteOperators<dim>& operators,
                                const Fields<tensor_size<dim>>& deformation, const Field& modulus,
                                const Field& weight, std::size_t width, const Ties<dim>& ties = {});

  /// The bound of all points with an x near the eigenvector of the largest eigenvalue of A: power iterations
  /// from x = 1, which go on once the bound has grown by a twentieth since (no iteration raises it) and begin
  /// again where it has doubled. `point`: where A x is largest.
  Result of_all(const DiscreteOperators<dim>& operators, const Fields<tensor_size<dim>>& deformation,
                const Field& modulus, const Field& weight, const Ties<dim>& ties = {});
  /// The operators are others: x begins at 1 again.
  void forget() { share_.clear(); }
  /// Lets go of what each bound makes anew.
  void release() { transfer_ = inverse_ = image_ = Field(); }

  void archive(Archive& archive);

private:
  SpectralView<dim> prepare(const DiscreteOperators<dim>& operators,
                            const Fields<tensor_size<dim>>& deformation, const Field& modulus,
                            const Field& weight, const Field& share);
  void map(const SpectralView<dim>& view, const Field& weight, const Ties<dim>& ties);
  Result largest_quotient() const;

  Field share_;          ///< [point] x; empty: to be found
  double settled_ = 0.0; ///< the bound when x was found
  Field transfer_;       ///< [node] (1/M_J) Σ_q V_q |b_qJ| x_q
  Field inverse_;        ///< [point] F⁻ᵀ and det F as mechanics/step_kernels.hpp lays them
  Field image_;          ///< [point] A x
};

/// √(1 + ξ²) − ξ: what a share ξ of critical damping leaves of the stable step; and the ξ that leaves a
/// share.
double damped_step(double damping);
double damping_of_step(double share);

/// Δt ≤ 2/ω of elastic waves, s, from the bound on ω² with λ + 2μ (Pa) and masses (kg); infinite for 0.
/// `stabilisation` is the factor α of the edge defect, which raises ω² by less than the fraction α.
double stable_wave_step(double bound, double stabilisation, double viscosity_ratio);

extern template class SpectralBound<2>;
extern template class SpectralBound<3>;

} // namespace cnem
