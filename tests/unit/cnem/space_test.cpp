// Nodal integration in space (cnem/space.hpp): what the contract suite does not ask.
#include "cnem/median.hpp"
#include "cnem/space.hpp"
#include "core/error.hpp"
#include "core/operators/operator_checks.hpp"
#include "tests/space_clouds.hpp"
#include "voronoi/space/conduction.hpp"
#include "voronoi/space/median_cells.hpp"

#include <gtest/gtest.h>

namespace cnem::testing {
namespace {

using scni::CellKind;
using scni::CnemInSpace;
using voronoi::Functions;

std::vector<scni::SpaceOptions> all_options() {
  return {{CellKind::median, Functions::linear, 1},
          {CellKind::voronoi, Functions::laplace, 1},
          {CellKind::voronoi, Functions::sibson, 1},
          {CellKind::voronoi, Functions::sibson, 3}};
}

/// Nothing of one face of a slit is in rows of the other, but round its end: zero, not small.
TEST(CnemInSpace, nothing_acts_across_a_slit) {
  const int n = 8;
  const Cloud<3> cloud = recovered({.shape = SpaceShape::slit, .cells = n, .jitter = 0.3}).cloud;
  const double plane = 0.5, from_end = 2.5 / n;
  IndexedVector<NodeIndex, int> side(cloud.position.size(), 0);
  for (const NodeIndex i : cloud.position.indices())
    side[i] = cloud.position[i].y() > plane + 1e-9 ? 1 : cloud.position[i].y() < plane - 1e-9 ? -1 : 0;
  for (const auto& facet : cloud.facets) { // nodes on the slit are of the side that they are the surface of
    const double out = area_normal<3>(corners_of<3>(facet, cloud.position)).normalized().y();
    for (const NodeIndex i : facet.node)
      if (side[i] == 0 && std::abs(out) > 0.99) side[i] = out > 0 ? -1 : 1;
  }
  for (const auto& options : all_options()) {
    CnemInSpace method(options);
    const auto approximation = method.rebuild(cloud);
    const auto& op = approximation.mechanics;
    std::size_t beside = 0;
    for (const NodeIndex i : cloud.position.indices()) {
      if (side[i] == 0 || cloud.position[i].x() > 0.5 - from_end) continue;
      ++beside;
      for (auto e = index_of(op.row_begin[index_of(i)]); e < index_of(op.row_begin[index_of(i) + 1]); ++e)
        if (side[op.node[e]] != 0) { EXPECT_EQ(side[op.node[e]], side[i]); }
      const auto& links = approximation.links;
      for (auto l = index_of(links.begin[index_of(i)]); l < index_of(links.begin[index_of(i) + 1]); ++l)
        if (side[links.neighbour[l]] != 0) { EXPECT_EQ(side[links.neighbour[l]], side[i]); }
    }
    EXPECT_GE(beside, 100U);
  }
}

/// The antisymmetric part of the rows are the area vectors of the median dual.
TEST(CnemInSpace, median_links_are_the_facets_of_the_median_dual) {
  const auto body = recovered({.shape = SpaceShape::l, .cells = 4, .jitter = 0.3});
  const auto op = scni::median_gradients(body.cloud, body.tetrahedra);
  const auto links = scni::median_links(body.cloud, op);
  const auto cells = voronoi::median_cells(body.cloud, body.tetrahedra.node);
  EXPECT_EQ(links.neighbour, cells.neighbours.item);
  std::map<std::pair<NodeIndex, NodeIndex>, Vec3> area;
  for (const auto& face : cells.interior) {
    area.try_emplace({face.cell[0], face.cell[1]}, Vec3::Zero()).first->second += face.normal();
    area.try_emplace({face.cell[1], face.cell[0]}, Vec3::Zero()).first->second -= face.normal();
  }
  for (const NodeIndex i : body.cloud.position.indices())
    for (auto l = index_of(links.begin[index_of(i)]); l < index_of(links.begin[index_of(i) + 1]); ++l) {
      const NodeIndex j = links.neighbour[l];
      const double distance = (body.cloud.position[j] - body.cloud.position[i]).norm();
      EXPECT_NEAR(links.weight[l], scni::link_weight<3>(area.at({i, j}).norm(), distance), 1e-12 * distance);
    }
  for (std::size_t i = 0; i < cells.cells(); ++i) EXPECT_NEAR(op.volume[i], cells.volume[i], 1e-15);
}

/// Of a quadratic field gradients err less, the smaller the spacing is, with all functions.
TEST(CnemInSpace, gradients_of_a_quadratic_field_converge) {
  for (const auto& options : all_options()) {
    const auto error = [&](int n) {
      const Cloud<3> cloud = recovered({.shape = SpaceShape::cube, .cells = n, .jitter = 0.2}).cloud;
      CnemInSpace method(options);
      const auto op = method.rebuild(cloud).mechanics;
      double squared = 0.0;
      for (std::size_t i = 0; i < index_of(op.points); ++i) {
        Vec3 g = Vec3::Zero();
        for (auto e = index_of(op.row_begin[i]); e < index_of(op.row_begin[i + 1]); ++e)
          for (std::size_t d = 0; d < 3; ++d)
            g[static_cast<Eigen::Index>(d)] += cloud.position[op.node[e]].squaredNorm() * op.gradient[d][e];
        squared += op.volume[i] * (g - 2.0 * cloud.position[i]).squaredNorm();
      }
      return std::sqrt(squared);
    };
    EXPECT_GT(error(4) / error(8), 1.8);
  }
}

/// An octahedron whose square is cut along one diagonal as seen from above and along the other from below:
/// the tetrahedron of its nodes has no volume.
TEST(CnemInSpace, conduction_is_finite_on_flat_tetrahedra) {
  for (const double height : {0.0, 1e-17, 1e-12}) {
    Cloud<3> cloud;
    cloud.position = {{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, -height}, {0, 0, 1}, {0, 0, -1}};
    cloud.piece_names = {"surface"};
    for (const auto& [i, j, k] :
         {std::array{0, 1, 4}, std::array{1, 2, 4}, std::array{2, 3, 4}, std::array{3, 0, 4},
          std::array{1, 0, 5}, std::array{2, 1, 5}, std::array{3, 2, 5}, std::array{0, 3, 5}})
      cloud.facets.push_back({{as<NodeIndex>(i), as<NodeIndex>(j), as<NodeIndex>(k)}, {}});
    std::vector<voronoi::Simplex<3>> list;
    for (const auto& [i, j, k, l] : {std::array{0, 1, 2, 4}, std::array{0, 2, 3, 4}, std::array{0, 3, 1, 5},
                                     std::array{1, 3, 2, 5}, std::array{0, 2, 1, 3}})
      list.push_back({as<NodeIndex>(i), as<NodeIndex>(j), as<NodeIndex>(k), as<NodeIndex>(l)});
    const auto mesh = voronoi::connected(cloud, list);
    const auto op = voronoi::linear_tetrahedra(cloud, mesh);
    EXPECT_EQ(op.points, 4);
    EXPECT_TRUE(rows_are_complete(op));
    EXPECT_TRUE(reproduces_linear_fields(op, cloud.position));
    for (const Field& gradient : op.gradient)
      for (const double g : gradient) EXPECT_LT(std::abs(g), 2.0);
    auto kept = op;
    voronoi::keep_pattern(kept);
    const auto pattern = voronoi::conduction_pattern(cloud, mesh);
    EXPECT_GT(pattern.gradient[0].size(), 0U);
    EXPECT_EQ(pattern.gradient, kept.gradient);
    EXPECT_EQ(pattern.volume, kept.volume);
    EXPECT_EQ(pattern.row_begin, kept.row_begin);
    EXPECT_EQ(pattern.node, kept.node);
    EXPECT_EQ(pattern.col_begin, kept.col_begin);
    EXPECT_TRUE(pattern.value.empty());
    for (const auto& options : all_options()) {
      scni::SpaceOptions on_mesh = options;
      on_mesh.tetrahedra = list;
      const auto rows = CnemInSpace(on_mesh).rebuild(cloud).mechanics;
      EXPECT_TRUE(rows_are_complete(rows));
      EXPECT_TRUE(reproduces_linear_fields(rows, cloud.position));
    }
  }
}

/// What a solver builds when it has let go of its former operators.
TEST(CnemInSpace, rows_and_their_transpose_are_those_of_a_rebuild) {
  const Cloud<3> cloud = recovered({.shape = SpaceShape::cube, .cells = 4, .jitter = 0.3}).cloud;
  for (const auto& options : all_options()) {
    const auto whole = CnemInSpace(options).rebuild(cloud).mechanics;
    auto rows = CnemInSpace(options).rebuild_rows(cloud).mechanics;
    if (options.cells == CellKind::voronoi) { EXPECT_TRUE(rows.point.empty()); }
    rows.build_transpose();
    EXPECT_EQ(rows.node, whole.node);
    EXPECT_EQ(rows.gradient, whole.gradient);
    EXPECT_EQ(rows.point, whole.point);
    EXPECT_EQ(rows.weighted_gradient, whole.weighted_gradient);
  }
}

TEST(CnemInSpace, falls_back_rarely) {
  CnemInSpace method({CellKind::voronoi, Functions::sibson, 1});
  method.rebuild(recovered({.shape = SpaceShape::cube, .cells = 6, .jitter = 0.3}).cloud);
  EXPECT_EQ(method.fallbacks().to_laplace, 0);
  EXPECT_EQ(method.fallbacks().to_linear, 0);
  const Cloud<3> shell = recovered({.shape = SpaceShape::shell, .cells = 6, .jitter = 0.3}).cloud;
  const auto approximation = method.rebuild(shell);
  EXPECT_LT(static_cast<double>(method.fallbacks().to_linear),
            0.02 * static_cast<double>(approximation.links.neighbour.size()));
}

TEST(CnemInSpace, takes_one_point_a_facet_or_one_a_triangle) {
  EXPECT_THROW(CnemInSpace({CellKind::voronoi, Functions::sibson, 2}), InputError);
  EXPECT_THROW(CnemInSpace({CellKind::voronoi, Functions::sibson, 0}), InputError);
  const Cloud<3> cloud = recovered({.shape = SpaceShape::cube, .cells = 3, .jitter = 0.3}).cloud;
  CnemInSpace one({CellKind::voronoi, Functions::sibson, 1}),
      three({CellKind::voronoi, Functions::sibson, 3});
  EXPECT_GT(three.rebuild(cloud).mechanics.node.size(), one.rebuild(cloud).mechanics.node.size());
  EXPECT_EQ(one.name(), "cnem_sibson");
}

} // namespace
} // namespace cnem::testing
