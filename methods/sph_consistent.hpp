#pragma once
// Particles with which constant stress is in balance.
#include "methods/sph.hpp"

namespace cnem::methods {

/// Changes nodal gradients b_ij, which are linearly exact, as little as it takes for constant stress to be in
/// balance: Σ_i V_i b_ij = n_j, half the outward lengths of the two facets at a node of the boundary, 0
/// inside. This is the integration constraint of variational consistency (Chen, Hillman, Rüter 2013, (19));
/// Bonet and Kulasegaram (2000) approach it by iterating on the volumes. Over the links of the rows
///
///   δb_ij = w_ij (λ_j − λ_i − β_i X_ij),  w_ij = V_j/V_i²,  β_i = Σ_j w_ij (λ_j − λ_i) ⊗ X_ij (Σ_j w_ij X_ij
///   ⊗ X_ij)⁻¹
///
/// is the least change in Σ V_i |δb_ij|²/w_ij that keeps linear fields exact. The multipliers λ_j (–, one for
/// each component of the gradient) are those of Σ_i V_i δb_ij = n_j − Σ_i V_i b_ij. Its operator is symmetric
/// and positive but for linear fields, to which the right side is orthogonal because cells tile the domain;
/// solved by conjugate gradients to 1e-13 of the width of the largest cell. Builds the transpose.
/// Throws GeometryError when they do not come to that.
void balance_constant_stress(const Cloud<2>& cloud, DiscreteOperators<2>& op);

/// Corrected particles (methods/sph.hpp) with balance_constant_stress(): the affine patch test is exact in
/// whatever cloud, at the boundary too, and stays so on new references.
class ConsistentSph final : public Discretisation<2> {
public:
  static constexpr Promises promised{Promise::identity_values, Promise::non_negative_values,
                                     Promise::tiling_cells, Promise::balanced_constant_stress};

  /// As Sph.
  explicit ConsistentSph(Kernel kernel = Kernel::cubic_spline, double smoothing = 2.4)
      : particles_(kernel, smoothing) {}

  /// Throws GeometryError as Sph and balance_constant_stress() do. Cost O(N^1.5).
  Approximation<2> rebuild(const Cloud<2>& cloud) override;
  std::string name() const override { return "consistent_" + particles_.name(); }
  Promises promises() const override { return promised; }

private:
  Sph particles_;
};

} // namespace cnem::methods
