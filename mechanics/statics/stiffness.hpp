#pragma once
// The stiffness of linear statics on the operators of any discretisation, with the edge defect.
#include "core/sparse_cholesky.hpp"
#include "mechanics/statics/statics.hpp"

#include <utility>
#include <vector>

namespace cnem {

/// Unknowns q: what supports leave free of the coefficients u_a, u = T q + u0.
template<int dim> class FreeUnknowns {
public:
  explicit FreeUnknowns(const StaticProblem<dim>& problem);

  Eigen::Index size() const { return size_; }
  const Fields<dim>& given() const { return given_; }

  /// visit(q, T_{(a,k) q}) for the unknowns that coefficient k of function a depends on.
  template<class Visit> void each(std::size_t a, std::size_t k, Visit&& visit) const {
    for (const auto& [q, direction] : map_[a])
      if (const double c = direction[static_cast<Eigen::Index>(k)]; c != 0.0) visit(q, c);
  }

  /// T q + u0, [k][function].
  Fields<dim> expand(const Eigen::VectorXd& q) const;
  /// Tᵀ f.
  Eigen::VectorXd restrict(const Fields<dim>& f) const;

private:
  std::vector<std::vector<std::pair<int, Vec<dim>>>> map_; ///< [function] free directions
  Fields<dim> given_;                                      ///< [k][function] u0, m
  Eigen::Index size_ = 0;
};

/// Tᵀ K T, K = Σ_p V_p Bᵀ D B + the edge defect.
template<int dim>
SparseMatrix stiffness(const StaticProblem<dim>& problem, const FreeUnknowns<dim>& unknowns);

/// ∇u of all points, [component][point]: the strain out of the plane is filled in by stresses().
template<int dim> Fields<tensor_size<dim>> gradients(const StaticProblem<dim>& problem, const Fields<dim>& u);

/// σ = λ* tr ε 1 + 2μ ε − 3κ* θ 1, θ the thermal strain; in the plane fills the out-of-plane component of ∇u
/// where no hoop strain is there. Without stress out of the plane λ* and 3κ* are 2μ/(λ + 2μ) of λ and 3κ.
/// Of a ply σ = D ε.
template<int dim>
Fields<symmetric_size<dim>> stresses(const StaticProblem<dim>& problem, Fields<tensor_size<dim>>& gradient);

/// Σ V σ b: what the stresses of the points hold up, [k][function].
template<int dim>
Fields<dim> internal_force(const StaticProblem<dim>& problem, const Fields<symmetric_size<dim>>& stress);

/// Adds K_s u of the edge defect to `force` and returns its energy ½ uᵀ K_s u.
template<int dim>
double add_defect_force(const StaticProblem<dim>& problem, const Fields<dim>& u, Fields<dim>& force);

extern template class FreeUnknowns<2>;
extern template class FreeUnknowns<3>;

} // namespace cnem
