// Accuracy of the edge quadrature: the operator against one with sixteen Gauss points per edge, assembled
// here term by term from (75)–(79).
#include "cnem/scni.hpp"
#include "core/error.hpp"
#include "tests/clouds.hpp"
#include "voronoi/plane/cells.hpp"

#include <gtest/gtest.h>

#include <array>
#include <map>

namespace cnem::testing {
namespace {

using Rows = std::vector<std::map<NodeIndex, Vec2>>;

/// Composite Gauss rule on [0, 1]: eight pieces with two points each.
std::vector<double> sixteen_points() {
  std::vector<double> points;
  for (int piece = 0; piece < 8; ++piece)
    for (const double s : {0.5 - std::sqrt(3.0) / 6, 0.5 + std::sqrt(3.0) / 6})
      points.push_back((piece + s) / 8);
  return points;
}

Rows reference_rows(const Cloud<2>& cloud, voronoi::Functions functions) {
  const auto triangulation = voronoi::triangulate(cloud);
  const auto circles = voronoi::circumcircles(cloud, triangulation);
  const auto cells = voronoi::constrained_cells(cloud, triangulation, circles);
  voronoi::NaturalNeighbours phi(cloud, triangulation, circles);
  Rows rows(cloud.position.size());
  const auto add = [&](NodeIndex cell, NodeIndex node, const Vec2& flux) {
    rows[std::size_t(cell)].try_emplace(node, Vec2::Zero()).first->second +=
        flux / cells.volume[std::size_t(cell)];
  };
  const auto points = sixteen_points();
  for (const auto& facet : cells.interior) {
    const Vec2 along = facet.corner[1] - facet.corner[0];
    if (along.norm() == 0) continue;
    for (const double s : points) {
      phi.evaluate(functions, facet.corner[0] + s * along, std::max(facet.simplex[0], facet.simplex[1]));
      for (std::size_t k = 0; k < phi.nodes().size(); ++k) {
        const Vec2 flux = phi.values()[k] / 16 * right_normal(along);
        add(facet.cell[0], phi.nodes()[k], flux);
        add(facet.cell[1], phi.nodes()[k], -flux);
      }
    }
  }
  for (const auto& piece : cells.boundary) {
    const auto [a, b] = cloud.facets[piece.facet].node;
    const Vec2 normal = (piece.place[1][0] - piece.place[0][0]) *
                        right_normal(cloud.position[std::size_t(b)] - cloud.position[std::size_t(a)]);
    add(piece.cell, a, (1 - 0.5 * (piece.place[0][0] + piece.place[1][0])) * normal);
    add(piece.cell, b, 0.5 * (piece.place[0][0] + piece.place[1][0]) * normal);
  }
  return rows;
}

/// |b − b_ref| / |b_ref| over all entries.
double difference(const DiscreteOperators<2>& op, Rows reference) {
  double squares = 0.0, norm = 0.0;
  for (const auto& row : reference)
    for (const auto& [j, b] : row) norm += b.squaredNorm();
  for (std::size_t i = 0; i < std::size_t(op.points); ++i) {
    for (auto e = std::size_t(op.row_begin[i]); e < std::size_t(op.row_begin[i + 1]); ++e)
      reference[i].try_emplace(op.node[e], Vec2::Zero()).first->second -=
          Vec2(op.gradient[0][e], op.gradient[1][e]);
    for (const auto& [j, b] : reference[i]) squares += b.squaredNorm();
  }
  return std::sqrt(squares / norm);
}

double mean_row_length(const DiscreteOperators<2>& op) { return double(op.node.size()) / op.points; }

std::array<DiscreteOperators<2>, 3> operators(const Cloud<2>& cloud, voronoi::Functions functions) {
  return {scni::Cnem({functions, 1}).rebuild(cloud).mechanics,
          scni::Cnem({functions, 2}).rebuild(cloud).mechanics,
          scni::Cnem({functions, 3}).rebuild(cloud).mechanics};
}

TEST(Quadrature, more_points_come_closer_to_the_integral) {
  const Cloud<2> cloud = jittered_square(0.04, 0.25, 3);
  const Rows sibson = reference_rows(cloud, voronoi::Functions::sibson);
  const Rows laplace = reference_rows(cloud, voronoi::Functions::laplace);
  const auto by_sibson = operators(cloud, voronoi::Functions::sibson);
  const auto by_laplace = operators(cloud, voronoi::Functions::laplace);
  std::array<double, 3> s, l;
  for (std::size_t k = 0; k < 3; ++k) {
    s[k] = difference(by_sibson[k], sibson);
    l[k] = difference(by_laplace[k], laplace);
    RecordProperty("sibson_" + std::to_string(k + 1), std::to_string(s[k]));
    RecordProperty("laplace_" + std::to_string(k + 1), std::to_string(l[k]));
  }
  EXPECT_LT(s[0], 0.3);
  EXPECT_LT(s[1], 0.25 * s[0]);
  EXPECT_LT(s[2], 0.7 * s[1]);
  EXPECT_LT(l[1], l[0]);
  EXPECT_LT(l[2], l[1]);
}

TEST(Quadrature, rows_are_as_short_as_natural_neighbours_allow) {
  const auto op = operators(jittered_square(0.04, 0.25, 3), voronoi::Functions::sibson);
  EXPECT_GT(mean_row_length(op[0]), 8.0);
  EXPECT_LT(mean_row_length(op[0]), 9.7);
  EXPECT_GT(mean_row_length(op[1]), mean_row_length(op[0]));
  EXPECT_LT(mean_row_length(op[1]), 10.8);
}

TEST(Quadrature, refuses_rules_it_does_not_have) {
  EXPECT_THROW(scni::Cnem({scni::Functions::sibson, 0}), InputError);
  EXPECT_THROW(scni::Cnem({scni::Functions::sibson, 4}), InputError);
}

} // namespace
} // namespace cnem::testing
