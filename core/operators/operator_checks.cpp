#include "core/operators/operator_checks.hpp"

#include "core/index.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace cnem {

template<int dim> bool rows_are_complete(const DiscreteOperators<dim>& op) {
  const std::size_t points = index_of(op.points), entries = op.node.size();
  if (op.row_begin.size() != points + 1 || op.volume.size() != points) return false;
  if (op.row_begin.front() != 0 || index_of(op.row_begin.back()) != entries) return false;
  for (const Field& g : op.gradient)
    if (g.size() != entries) return false;
  if (!op.value.empty() && op.value.size() != entries) return false;
  if (op.hoop.size() != (op.of_revolution() ? entries : 0)) return false;
  if (op.nodal && (op.points != op.nodes || !op.value.empty())) return false;
  for (std::size_t p = 0; p < points; ++p) {
    if (!(op.volume[p] > 0.0) || op.row_begin[p + 1] - op.row_begin[p] <= dim) return false;
    const auto first = op.node.begin() + op.row_begin[p], last = op.node.begin() + op.row_begin[p + 1];
    if (!exists(*first) || *(last - 1) >= as<NodeIndex>(op.nodes)) return false;
    if (std::adjacent_find(first, last, std::greater_equal<>()) != last) return false;
  }
  return true;
}

template<int dim>
bool reproduces_linear_fields(const DiscreteOperators<dim>& op,
                              const IndexedVector<NodeIndex, Vec<dim>>& position) {
  constexpr double epsilon = std::numeric_limits<double>::epsilon(), relative = 1e-9;
  for (std::size_t p = 0; p < index_of(op.points); ++p) {
    const Vec<dim>& origin = position[op.first_node(p)];
    Vec<dim> sum = Vec<dim>::Zero();
    Mat<dim> identity = Mat<dim>::Zero();
    double terms = 0.0, moments = 1.0, width = 0.0, size = 0.0;
    for (auto e = index_of(op.row_begin[p]); e < index_of(op.row_begin[p + 1]); ++e) {
      const Vec<dim>& x = position[op.node[e]];
      Vec<dim> b;
      for (std::size_t k = 0; k < dim; ++k) b[static_cast<Eigen::Index>(k)] = op.gradient[k][e];
      sum += b;
      identity += (x - origin) * b.transpose();
      terms += b.norm();
      moments += (x - origin).norm() * b.norm();
      width = std::max(width, (x - origin).norm());
      size = std::max(size, x.cwiseAbs().maxCoeff());
    }
    const double volume =
        op.of_revolution() ? op.volume[p] / (2.0 * std::numbers::pi * op.radius[p]) : op.volume[p];
    if (volume < relative * std::pow(width, dim)) continue;
    const double rounding = 100.0 * epsilon * size * std::pow(width, dim - 2) / volume; // of ∮ n dΓ, over V
    if (!(sum.norm() <= relative * terms + rounding)) return false;
    if (!((identity - Mat<dim>::Identity()).norm() <= relative * moments + rounding * width)) return false;
  }
  return true;
}

template bool rows_are_complete(const DiscreteOperators<2>&);
template bool rows_are_complete(const DiscreteOperators<3>&);
template bool reproduces_linear_fields(const DiscreteOperators<2>&, const IndexedVector<NodeIndex, Vec<2>>&);
template bool reproduces_linear_fields(const DiscreteOperators<3>&, const IndexedVector<NodeIndex, Vec<3>>&);

} // namespace cnem
