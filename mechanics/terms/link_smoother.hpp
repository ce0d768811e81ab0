#pragma once
// Smooths values at some nodes towards what is linear between neighbours, and keeps their sum and first
// moment.
#include "core/fields/state.hpp"
#include "core/operators/discretisation.hpp"

#include <Eigen/Core>

#include <vector>

namespace cnem {

/// For values x of nodes that take part, (M + DᵀWD) δ = −DᵀWDx over the links between them, with
///
///   (Dx)_ij = x_j − x_i − ½ (g_i + g_j)·X_ij,  W_ij = c L_ij d_ij min(s_i, s_j)
///
/// and g_i the least-squares gradient of x over these links (weights 1/d²; eigenvalues of its matrix below a
/// twentieth of the largest are dropped, as at the end of a row of nodes). D annihilates linear fields, so
/// that Σ M δ = 0 and Σ M δ X = 0. Solved by conjugate gradients preconditioned with M, which keep both sums
/// in every iteration.
template<int dim> class LinkSmoother {
public:
  using Values = Eigen::Array<double, symmetric_size<dim>, 1>;

  /// reference: [node] m, side by side; share: [node] s, 0 for nodes that take no part; kind: [node],
  /// links between different ones do not count; mass: [node] M, m² or m³; strength: c.
  LinkSmoother(const StabilisationLinks<dim>& links, const Field& reference, const Field& share,
               const std::vector<std::int32_t>& kind, const Field& mass, double strength);

  /// The nodes that take part and have a link, in increasing order.
  const std::vector<std::int32_t>& nodes() const { return nodes_; }
  /// δ of `nodes()`, from x of `nodes()`, component by component.
  std::vector<Values> change(const std::vector<Values>& x) const;

private:
  using Gradient = Eigen::Array<double, symmetric_size<dim>, dim>;
  struct Link {
    std::int32_t other; ///< in nodes_
    double weight;      ///< W
    double near;        ///< 1/d²
    Vec<dim> way;       ///< X_ij
  };
  std::vector<Values> apply(const std::vector<Values>& x) const; ///< DᵀWD x
  Gradient solved(std::size_t a, const Gradient& g) const { return (g.matrix() * inverse_[a]).array(); }

  std::vector<std::int32_t> nodes_;
  std::vector<std::size_t> begin_; ///< [nodes_ + 1]
  std::vector<Link> links_;
  std::vector<Mat<dim>> inverse_; ///< pseudo-inverse of Σ X ⊗ X/d²
  Field mass_;
};

extern template class LinkSmoother<2>;
extern template class LinkSmoother<3>;

} // namespace cnem
