#pragma once
// Operators as Eigen matrices, for small static problems.
#include "core/operators/discretisation.hpp"

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

#include <array>
#include <set>
#include <vector>

namespace cnem::testing {

using Sparse = Eigen::SparseMatrix<double>;
using Vector = Eigen::VectorXd;

/// G_x and G_y, points × nodes.
inline std::array<Sparse, 2> gradient_matrices(const DiscreteOperators<2>& op) {
  std::array<Sparse, 2> g;
  for (std::size_t k = 0; k < 2; ++k) {
    std::vector<Eigen::Triplet<double>> entries;
    for (std::int32_t p = 0; p < op.points; ++p)
      for (auto e = op.row_begin[std::size_t(p)]; e < op.row_begin[std::size_t(p) + 1]; ++e)
        entries.emplace_back(p, as<int>(op.node[std::size_t(e)]), op.gradient[k][std::size_t(e)]);
    g[k].resize(op.points, op.nodes);
    g[k].setFromTriplets(entries.begin(), entries.end());
  }
  return g;
}

/// The edge defect of a scalar field, r = u_j − u_i − ½ (∇u_i + ∇u_j)·X_ij, one row per link i < j scaled by
/// the root of its weight: Σ w r² = |D u|².
inline Sparse defect_matrix(const Approximation<2>& approximation, const std::vector<Vec2>& position) {
  const auto& op = approximation.mechanics;
  const auto& links = approximation.links;
  std::vector<Eigen::Triplet<double>> entries;
  int row = 0;
  for (std::int32_t i = 0; i < op.nodes; ++i)
    for (auto l = links.begin[std::size_t(i)]; l < links.begin[std::size_t(i) + 1]; ++l) {
      const auto j = as<int>(links.neighbour[std::size_t(l)]);
      if (j < i) continue;
      const double root = std::sqrt(links.weight[std::size_t(l)]);
      const Vec2 x = position[std::size_t(j)] - position[std::size_t(i)];
      entries.emplace_back(row, j, root);
      entries.emplace_back(row, i, -root);
      for (const auto p : {i, j})
        for (auto e = std::size_t(op.row_begin[std::size_t(p)]);
             e < std::size_t(op.row_begin[std::size_t(p) + 1]); ++e)
          entries.emplace_back(row, as<int>(op.node[e]),
                               -0.5 * root * (op.gradient[0][e] * x.x() + op.gradient[1][e] * x.y()));
      ++row;
    }
  Sparse d(row, op.nodes);
  d.setFromTriplets(entries.begin(), entries.end());
  return d;
}

inline Vector as_vector(const Field& field) {
  return Eigen::Map<const Vector>(field.data(), Eigen::Index(field.size()));
}

/// Numbers of the nodes on the boundary of the cloud.
inline std::set<int> boundary_nodes(const Cloud<2>& cloud) {
  std::set<int> nodes;
  for (const auto& f : cloud.facets) nodes.insert(as<int>(f.node[0]));
  return nodes;
}

/// Solves K u = f with u given at the fixed unknowns.
inline Vector solve(const Sparse& stiffness, const Vector& load, const Vector& given,
                    const std::set<int>& fixed) {
  std::vector<Eigen::Triplet<double>> entries;
  int unknowns = 0;
  for (Eigen::Index i = 0; i < given.size(); ++i)
    if (!fixed.contains(as<int>(i))) entries.emplace_back(i, unknowns++, 1.0);
  Sparse free(given.size(), unknowns);
  free.setFromTriplets(entries.begin(), entries.end());
  Vector u = given;
  for (const auto& e : entries) u[e.row()] = 0.0;
  const Sparse reduced = free.transpose() * stiffness * free;
  const Vector right = free.transpose() * (load - stiffness * u);
  return u + free * Eigen::SimplicialLDLT<Sparse>(reduced).solve(right);
}

} // namespace cnem::testing
