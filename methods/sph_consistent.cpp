#include "methods/sph_consistent.hpp"

#include "core/error.hpp"
#include "core/index.hpp"
#include "core/operators/operator_checks.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <fmt/format.h>

namespace cnem::methods {
namespace {

/// [node][k]: one right side for each component of the gradient.
using Columns = Eigen::Array<double, Eigen::Dynamic, 2, Eigen::RowMajor>;
using Row = Eigen::Array<double, 1, 2>;

auto row(auto& columns, std::size_t i) { return columns.row(static_cast<Eigen::Index>(i)); }

/// n_j − Σ_i V_i b_ij, m.
Columns missing(const Cloud<2>& cloud, const DiscreteOperators<2>& op) {
  Columns result = Columns::Zero(cloud.nodes(), 2);
  for (const Facet<2>& facet : cloud.facets) {
    const Vec2 along = cloud.position[facet.node[1]] - cloud.position[facet.node[0]];
    for (const NodeIndex j : facet.node) row(result, index_of(j)) += Row(0.5 * along.y(), -0.5 * along.x());
  }
  for (std::size_t i = 0; i < op.volume.size(); ++i)
    for (auto e = index_of(op.row_begin[i]); e < index_of(op.row_begin[i + 1]); ++e)
      row(result, index_of(op.node[e])) -= op.volume[i] * Row(op.gradient[0][e], op.gradient[1][e]);
  return result;
}

/// λ → δb on the links of rows.
class Change {
public:
  Change(const Cloud<2>& cloud, const DiscreteOperators<2>& op)
      : op_(op), way_(op.node.size()), weight_(op.node.size()), inverse_(op.volume.size()) {
    for (std::size_t i = 0; i < inverse_.size(); ++i) {
      Mat2 moment = Mat2::Zero();
      each_link(i, [&](std::size_t e, std::size_t j) {
        way_[e] = cloud.position[as<NodeIndex>(j)] - cloud.position[as<NodeIndex>(i)];
        weight_[e] = op.volume[j] / (op.volume[i] * op.volume[i]);
        moment += weight_[e] * way_[e] * way_[e].transpose();
      });
      inverse_[i] = moment.inverse();
    }
  }

  /// act(i, j, e, δb) at each entry e of a link i–j.
  void each(const Columns& lambda, auto&& act) const {
    for (std::size_t i = 0; i < inverse_.size(); ++i) {
      const auto jump = [&](std::size_t j) -> Vec2 {
        return (row(lambda, j) - row(lambda, i)).matrix().transpose();
      };
      Mat2 slope = Mat2::Zero();
      each_link(i,
                [&](std::size_t e, std::size_t j) { slope += weight_[e] * jump(j) * way_[e].transpose(); });
      slope *= inverse_[i];
      each_link(i, [&](std::size_t e, std::size_t j) {
        act(i, j, e, Vec2(weight_[e] * (jump(j) - slope * way_[e])));
      });
    }
  }

  /// Σ_i V_i δb_ij, m.
  Columns apply(const Columns& lambda) const {
    Columns sum = Columns::Zero(lambda.rows(), 2);
    each(lambda, [&](std::size_t i, std::size_t j, std::size_t, const Vec2& change) {
      const Row part = op_.volume[i] * change.transpose().array();
      row(sum, j) += part;
      row(sum, i) -= part;
    });
    return sum;
  }

  /// What apply() has on its diagonal but for β.
  Columns diagonal() const {
    Columns sum = Columns::Zero(static_cast<Eigen::Index>(inverse_.size()), 2);
    for (std::size_t i = 0; i < inverse_.size(); ++i)
      each_link(i, [&](std::size_t e, std::size_t j) {
        row(sum, i) += op_.volume[i] * weight_[e];
        row(sum, j) += op_.volume[i] * weight_[e];
      });
    return sum;
  }

private:
  void each_link(std::size_t i, auto&& act) const {
    for (auto e = index_of(op_.row_begin[i]); e < index_of(op_.row_begin[i + 1]); ++e)
      if (const auto j = index_of(op_.node[e]); j != i) act(e, j);
  }

  const DiscreteOperators<2>& op_;
  std::vector<Vec2> way_;     ///< [entry] X_ij, m
  Field weight_;              ///< [entry] w_ij, 1/m²
  std::vector<Mat2> inverse_; ///< [node]
};

/// Multipliers whose change makes up for what is `missing`.
Columns multipliers(const Change& change, const Columns& missing, double most) {
  constexpr int iterations = 5000;
  Columns lambda = Columns::Zero(missing.rows(), 2), residual = missing;
  const Columns diagonal = change.diagonal();
  Columns direction = residual / diagonal;
  Row product = (residual * direction).colwise().sum();
  for (int k = 0; residual.abs().maxCoeff() > most; ++k) {
    if (k == iterations)
      throw GeometryError(fmt::format("constant stress cannot be brought into balance on these particles: "
                                      "{:.2g} m of {:.2g} m are left",
                                      residual.abs().maxCoeff(), missing.abs().maxCoeff()));
    const Columns image = change.apply(direction);
    const Row curvature = (direction * image).colwise().sum();
    const Row step = (curvature > 0.0).select(product / curvature, 0.0);
    lambda += direction.rowwise() * step;
    residual -= image.rowwise() * step;
    const Row next = (residual.square() / diagonal).colwise().sum();
    direction =
        residual / diagonal + direction.rowwise() * (product > 0.0).select(next / product, 0.0).eval();
    product = next;
  }
  return lambda;
}

} // namespace

void balance_constant_stress(const Cloud<2>& cloud, DiscreteOperators<2>& op) {
  constexpr double rounding = 1e-13;
  const double widest = std::sqrt(*std::max_element(op.volume.begin(), op.volume.end()));
  const Change change(cloud, op);
  const Columns lambda = multipliers(change, missing(cloud, op), rounding * widest);
  std::vector<Vec2> sum(op.volume.size(), Vec2::Zero());
  change.each(lambda, [&](std::size_t i, std::size_t, std::size_t e, const Vec2& by) {
    op.gradient[0][e] += by.x();
    op.gradient[1][e] += by.y();
    sum[i] += by;
  });
  for (std::size_t i = 0; i < sum.size(); ++i) {
    const auto first = op.node.begin() + op.row_begin[i], last = op.node.begin() + op.row_begin[i + 1];
    const auto own = index_of(std::lower_bound(first, last, as<NodeIndex>(i)) - op.node.begin());
    op.gradient[0][own] -= sum[i].x();
    op.gradient[1][own] -= sum[i].y();
  }
  op.build_transpose();
  assert(reproduces_linear_fields(op, cloud.position));
}

Approximation<2> ConsistentSph::rebuild(const Cloud<2>& cloud) {
  Approximation<2> result = particles_.rebuild(cloud);
  balance_constant_stress(cloud, result.mechanics);
  return result;
}

} // namespace cnem::methods
