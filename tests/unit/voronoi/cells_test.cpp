#include "core/index.hpp"
#include "voronoi/plane/cells.hpp"

#include "tests/unit/voronoi/small_clouds.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace cnem::voronoi::test {
namespace {

Cells cells_of(const Cloud<2>& cloud) {
  const auto mesh = triangulate(cloud);
  return constrained_cells(cloud, mesh, circumcircles(cloud, mesh));
}

CellGeometry<2> polygons_of(const Cloud<2>& cloud) {
  const auto mesh = triangulate(cloud);
  const auto circles = circumcircles(cloud, mesh);
  return cell_geometry(cloud, mesh, circles, constrained_cells(cloud, mesh, circles));
}

TEST(Cells, GridHasSquareCellsHalvedAndQuarteredOnTheBoundary) {
  const auto cloud = grid(4);
  const auto cells = cells_of(cloud);
  for (const NodeIndex i : cloud.position.indices()) {
    const Vec2& x = cloud.position[i];
    const double half_x = x.x() == 0 || x.x() == 4 ? 0.5 : 1.0, half_y = x.y() == 0 || x.y() == 4 ? 0.5 : 1.0;
    EXPECT_DOUBLE_EQ(cells.volume[index_of(i)], half_x * half_y) << "node " << index_of(i);
  }
  for (const auto& f : cells.interior) {
    const Vec2 link = cloud.position[f.cell[1]] - cloud.position[f.cell[0]];
    EXPECT_GE(f.normal().dot(link), 0.0);
  }
}

TEST(Cells, ThirdNodeOwnsPartOfABoundaryFacet) {
  Cloud<2> cloud; // obtuse at node 2: the circumcentre lies at (2, -3.75), below the long side
  add_loop(cloud, {{0, 0}, {4, 0}, {2, 0.5}});
  const auto cells = cells_of(cloud);
  std::vector<BoundaryPart<2>> base;
  for (const auto& piece : cells.boundary)
    if (piece.facet == CloudFacetIndex{}) base.push_back(piece);
  ASSERT_EQ(base.size(), 3u);
  EXPECT_EQ(base[0].cell, 0_node);
  EXPECT_EQ(base[1].cell, 2_node);
  EXPECT_EQ(base[2].cell, 1_node);
  EXPECT_DOUBLE_EQ(base[0].place[1][0],
                   1.0625 / 4); // the bisector of (0, 0) and (2, 0.5) meets y = 0 at x = 1.0625
  EXPECT_DOUBLE_EQ(base[1].place[1][0], 1.0 - 1.0625 / 4);
  EXPECT_DOUBLE_EQ(cells.volume[0], 0.5 * 1.0625 * 0.25);
  EXPECT_DOUBLE_EQ(cells.volume[2], 1.0 - 1.0625 * 0.25);
}

TEST(Cells, CrackFacesShareNothing) {
  const auto cloud = embedded_crack();
  const auto cells = cells_of(cloud);
  EXPECT_DOUBLE_EQ(cells.volume[17], cells.volume[19]); // mirror images
  for (const auto& f : cells.interior) {
    EXPECT_FALSE((f.cell[0] == 17_node && f.cell[1] == 19_node) ||
                 (f.cell[0] == 19_node && f.cell[1] == 17_node));
    // No facet cuts through the crack 1 < x < 3, y = 2.
    const auto& [start, end] = f.corner;
    if ((start.y() - 2.0) * (end.y() - 2.0) < 0.0) {
      const double x = start.x() + (end.x() - start.x()) * (2.0 - start.y()) / (end.y() - start.y());
      EXPECT_TRUE(x <= 1.0 || x >= 3.0);
    }
  }
  double sum = 0.0;
  for (const double v : cells.volume) sum += v;
  EXPECT_NEAR(sum, 16.0, 1e-13);
}

TEST(Cells, PolygonsMoveWithTheNodes) {
  auto cloud = grid(3);
  for (auto& x : cloud.position)
    x += 0.1 * Vec2(std::sin(7 * x.x() + 3 * x.y()), std::cos(5 * x.x() - 2 * x.y()));
  const auto cells = polygons_of(cloud);
  Mat2 gradient;
  gradient << 1.3, 0.4, -0.2, 0.8;
  for (std::size_t v = 0; v < cells.vertex.size(); ++v) {
    Vec2 moved = Vec2::Zero();
    for (std::int32_t e = cells.vertex_begin[v]; e < cells.vertex_begin[v + 1]; ++e)
      moved += cells.vertex_weight[index_of(e)] * gradient *
               cloud.position[index_of(cells.vertex_node[index_of(e)])];
    EXPECT_LT((moved - gradient * cells.vertex[v]).norm(), 1e-13);
  }
}

} // namespace
} // namespace cnem::voronoi::test
