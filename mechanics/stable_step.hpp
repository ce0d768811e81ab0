#pragma once
// The largest step central differences can take, from a rigorous bound on the highest frequency.
#include "core/fields/state.hpp"
#include "core/operators/operators.hpp"

#include <vector>

namespace cnem {

/// Bound on the largest eigenvalue of M⁻¹ Gᵀ V k G for scalar weights M at nodes and moduli k at stress
/// points, on the current configuration (b = F⁻ᵀ b_r, V = V_r det F):
///
///   λ ≤ max_p k_p Σ_J |b_pJ| s_J,  s_J = (1/M_J) Σ_q V_q |b_qJ|
///
/// (norms of the blocks of a Gershgorin row, at stress points). With k = λ + 2μ it bounds ω² of elastic
/// waves, with the conductivity the decay rate of heat. Moves with |F⁻ᵀ b| ≤ the bound's own tensor norm, so
/// it holds for any F. Of revolution |b| becomes max(|b + h e_r|, √(|b|² + h²)), which bounds the energy norm
/// of u ↦ (u ⊗ b, u_r h) for λ ≥ 0.
template<int dim> class SpectralBound {
public:
  struct Result {
    double value;      ///< 1/s² (or 1/s for heat)
    std::size_t point; ///< row that attains it
  };
  /// The bound of each of the ranges of `width` points; width divides block_size.
  std::vector<Result> evaluate(const DiscreteOperators<dim>& operators,
                               const Fields<tensor_size<dim>>& deformation, const Field& modulus,
                               const Field& weight, std::size_t width);

private:
  void prepare(const DiscreteOperators<dim>& operators, const Fields<tensor_size<dim>>& deformation,
               const Field& weight);

  Field transfer_; ///< [node] s_J
  Field inverse_;  ///< [point] F⁻ᵀ and det F as mechanics/step_kernels.hpp lays them
};

/// Δt ≤ 2/ω of elastic waves, s, from the bound on ω² with λ + 2μ (Pa) and masses (kg); infinite for 0.
/// `stabilisation` is the factor α of the edge defect, which raises ω² by less than the fraction α.
double stable_wave_step(double bound, double stabilisation, double viscosity_ratio);

extern template class SpectralBound<2>;
extern template class SpectralBound<3>;

} // namespace cnem
