#include "voronoi/plane/triangulation.hpp"

#include "core/error.hpp"
#include "core/index.hpp"
#include "tests/unit/voronoi/small_clouds.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <limits>

namespace cnem::voronoi::test {
namespace {

double area(const Cloud<2>& cloud, const Triangulation& mesh) {
  double sum = 0.0;
  for (const auto& [a, b, c] : mesh.node)
    sum += 0.5 * cross(cloud.position[b] - cloud.position[a], cloud.position[c] - cloud.position[a]);
  return sum;
}

std::string message_of(const Cloud<2>& cloud) {
  try {
    triangulate(cloud);
  } catch (const GeometryError& e) { return e.what(); }
  return "no error";
}

void expect_error(const Cloud<2>& cloud, std::initializer_list<const char*> parts) {
  const std::string message = message_of(cloud);
  for (const char* part : parts)
    EXPECT_NE(message.find(part), std::string::npos) << message << "; expected: " << part;
}

bool has(const std::array<NodeIndex, 3>& nodes, NodeIndex i) {
  return std::find(nodes.begin(), nodes.end(), i) != nodes.end();
}

/// Neighbours are mutual and share their edge, every facet stands in one triangle and every node has one.
void expect_consistent(const Cloud<2>& cloud, const Triangulation& mesh) {
  IndexedVector<CloudFacetIndex, int> seen(cloud.facets.size(), 0);
  for (const SimplexIndex t : mesh.node.indices())
    for (std::size_t k = 0; k < 3; ++k) {
      const NodeIndex a = mesh.node[t][(k + 1) % 3], b = mesh.node[t][(k + 2) % 3];
      const SimplexIndex next = mesh.neighbour[t][k];
      const CloudFacetIndex facet = mesh.facet[t][k];
      ASSERT_EQ(!exists(next), exists(facet));
      if (exists(facet)) {
        ++seen[facet];
        EXPECT_EQ(cloud.facets[facet].node[0], a);
        EXPECT_EQ(cloud.facets[facet].node[1], b);
        continue;
      }
      std::size_t back = 0;
      while (back < 3 && mesh.neighbour[next][back] != t) ++back;
      ASSERT_LT(back, 3u);
      EXPECT_EQ(mesh.node[next][(back + 1) % 3], b);
      EXPECT_EQ(mesh.node[next][(back + 2) % 3], a);
    }
  for (const int count : seen) EXPECT_EQ(count, 1);
  for (const NodeIndex i : cloud.position.indices()) EXPECT_TRUE(has(mesh.node[mesh.triangle_of_node[i]], i));
}

TEST(Triangulation, SquareHasTwoTriangles) {
  const auto cloud = unit_square();
  const auto mesh = triangulate(cloud);
  EXPECT_EQ(mesh.triangles(), 2);
  EXPECT_DOUBLE_EQ(area(cloud, mesh), 1.0);
  expect_consistent(cloud, mesh);
}

TEST(Triangulation, CocircularGridIsConsistentAndRepeatable) {
  const auto cloud = grid(6);
  const auto mesh = triangulate(cloud);
  EXPECT_EQ(mesh.triangles(), 72);
  EXPECT_DOUBLE_EQ(area(cloud, mesh), 36.0);
  expect_consistent(cloud, mesh);
  EXPECT_EQ(triangulate(cloud).node, mesh.node);
}

TEST(Triangulation, HolesAndConcavitiesStayEmpty) {
  Cloud<2> cloud;
  add_loop(cloud, {{0, 0}, {4, 0}, {4, 2}, {2, 2}, {2, 4}, {0, 4}});
  add_loop(cloud, {{0.5, 0.5}, {0.5, 1.5}, {1.5, 1.5}, {1.5, 0.5}});
  const auto mesh = triangulate(cloud);
  EXPECT_DOUBLE_EQ(area(cloud, mesh), 11.0);
  expect_consistent(cloud, mesh);
}

TEST(Triangulation, SeparateBodiesMayTouchAtTwins) {
  Cloud<2> cloud;
  add_loop(cloud, {{0, 0}, {1, 0}, {1, 1}, {0, 1}});
  add_loop(cloud, {{1, 0}, {2, 0}, {2, 1}, {1, 1}});
  cloud.twins = {{1_node, 4_node}, {2_node, 7_node}};
  const auto mesh = triangulate(cloud);
  EXPECT_DOUBLE_EQ(area(cloud, mesh), 2.0);
  expect_consistent(cloud, mesh);
  for (const auto& nodes : mesh.node) // no triangle mixes the nodes of the two bodies
    EXPECT_EQ(nodes[0] < 4_node, nodes[1] < 4_node) << index_of(nodes[0]) << ' ' << index_of(nodes[1]);
}

TEST(Triangulation, BodiesMayLieInEachOther) {
  Cloud<2> cloud;
  add_loop(cloud, {{0, 0}, {1, 0}, {1, 1}, {0, 1}});
  add_loop(cloud, {{0.9, 0.2}, {2, 0.2}, {2, 0.8}, {0.9, 0.8}});
  cloud.position.push_back({0.95, 0.5}); // in both, and of the first
  EXPECT_THROW(triangulate(cloud), GeometryError);
  cloud.body.assign(9, 7);
  for (std::size_t i = 4; i < 8; ++i) cloud.body[i] = 2;
  const auto mesh = triangulate(cloud);
  EXPECT_NEAR(area(cloud, mesh), 1.0 + 1.1 * 0.6, 1e-15);
  expect_consistent(cloud, mesh);
  for (const auto& nodes : mesh.node)
    for (const NodeIndex i : nodes) EXPECT_EQ(cloud.body[i], cloud.body[nodes[0]]);
  cloud.simplices = mesh.node;
  cloud.across = mesh.neighbour;
  EXPECT_EQ(triangulate(cloud).node, mesh.node) << "from what there was";
}

TEST(Triangulation, BodiesMayNotCrossThemselves) {
  Cloud<2> cloud;
  add_loop(cloud, {{0, 0}, {1, 0}, {0, 1}, {1, 1}});
  add_loop(cloud, {{0, -1}, {2, -1}, {2, 0.2}, {0, 0.2}});
  cloud.body = {0, 0, 0, 0, 1, 1, 1, 1};
  expect_error(cloud, {"crosses itself at (0.5, 0.5) m", "facet 1", "facet 3"});
  cloud.body = {0, 0, 0, 1, 1, 1, 1, 1};
  expect_error(cloud, {"facet 2", "leads from one body to another"});
}

TEST(Triangulation, EmbeddedCrackHasTwoFaces) {
  const auto cloud = embedded_crack();
  const auto mesh = triangulate(cloud);
  EXPECT_DOUBLE_EQ(area(cloud, mesh), 16.0);
  expect_consistent(cloud, mesh);
  for (const auto& nodes : mesh.node) {
    double y = 0.0;
    for (const auto i : nodes) y += cloud.position[i].y() / 3.0;
    for (const auto i : nodes) {
      if (i == 17_node) { EXPECT_GT(y, 2.0); }
      if (i == 19_node) { EXPECT_LT(y, 2.0); }
    }
  }
}

TEST(Triangulation, CrackOpenToTheBoundaryHasTwoFaces) {
  const auto cloud = open_crack();
  const auto mesh = triangulate(cloud);
  EXPECT_DOUBLE_EQ(area(cloud, mesh), 4.0);
  expect_consistent(cloud, mesh);
  for (const auto& nodes : mesh.node) EXPECT_FALSE(has(nodes, 7_node) && has(nodes, 9_node));
}

TEST(Triangulation, OpenedCrackNeedsNoCoincidence) {
  auto cloud = embedded_crack();
  cloud.position[17].y() += 0.25;
  cloud.position[19].y() -= 0.25;
  const auto mesh = triangulate(cloud);
  EXPECT_DOUBLE_EQ(area(cloud, mesh), 15.5);
  expect_consistent(cloud, mesh);
}

TEST(TriangulationErrors, CoincidentNodes) {
  auto cloud = grid(2);
  cloud.position.push_back({1, 1});
  expect_error(cloud, {"node 9 at (1, 1) m", "coincides with node 8"});
  auto crack = embedded_crack();
  crack.twins.clear();
  expect_error(crack, {"coincides"});
}

TEST(TriangulationErrors, TwinWithoutFacet) {
  auto cloud = grid(2);
  cloud.position.push_back({1, 1});
  cloud.twins = {{8_node, 9_node}};
  expect_error(cloud, {"belongs to no facet"});
}

TEST(TriangulationErrors, SelfCrossingLoop) {
  Cloud<2> cloud;
  add_loop(cloud, {{0, 0}, {2, 0}, {0, 1}, {2, 1}});
  expect_error(cloud, {"crosses itself", "(1, 0.5) m"});
}

TEST(TriangulationErrors, LoopsThatCrossEachOther) {
  auto cloud = unit_square();
  add_loop(cloud, {{0.5, 0.5}, {0.5, 0.7}, {1.5, 0.7}, {1.5, 0.5}});
  expect_error(cloud, {"crosses itself at (1, 0.7) m"});
}

TEST(TriangulationErrors, LoopsThatCrossAtTwins) {
  Cloud<2> neck; // a neck of no width: its strands meet at (1, 1)
  add_loop(neck, {{0, 0}, {1, 1}, {2, 0}, {2, 2}, {1, 1}, {0, 2}});
  neck.twins = {{1_node, 4_node}};
  expect_error(neck, {"touches or crosses itself at node 1 at (1, 1) m"});
  Cloud<2> eight;
  add_loop(eight, {{0, 0}, {1, 1}, {2, 2}, {2, 0}, {1, 1}, {0, 2}});
  eight.twins = {{1_node, 4_node}};
  expect_error(eight, {"facet"});
}

TEST(TriangulationErrors, NodeOutside) {
  auto cloud = unit_square();
  cloud.position.push_back({1.5, 0.5});
  expect_error(cloud, {"node 4 at (1.5, 0.5) m lies outside the domain"});
}

TEST(TriangulationErrors, NodeInHole) {
  auto cloud = grid(3);
  add_loop(cloud, {{1.2, 1.2}, {1.2, 1.8}, {1.8, 1.8}, {1.8, 1.2}});
  cloud.position.push_back({1.5, 1.5});
  expect_error(cloud, {"outside the domain"});
}

TEST(TriangulationErrors, NodeOnForeignFacet) {
  auto cloud = unit_square();
  cloud.position.push_back({0.5, 0});
  expect_error(cloud, {"node 4", "lies on facet 0"});
}

TEST(TriangulationErrors, EmptyDomain) {
  expect_error(Cloud<2>{}, {"empty domain"});
  Cloud<2> line;
  add_loop(line, {{0, 0}, {1, 0}, {2, 0}});
  expect_error(line, {"empty domain"});
}

TEST(TriangulationErrors, WrongOrientation) {
  Cloud<2> clockwise;
  add_loop(clockwise, {{0, 0}, {0, 1}, {1, 1}, {1, 0}});
  expect_error(clockwise, {"wrong way round"});
  auto hole = grid(3);
  add_loop(hole, {{1.2, 1.2}, {1.8, 1.2}, {1.8, 1.8}, {1.2, 1.8}});
  expect_error(hole, {"wrong way round"});
}

TEST(TriangulationErrors, OpenAndBranchingLoops) {
  auto open = unit_square();
  open.facets.pop_back();
  expect_error(open, {"open boundary"});
  auto branching = unit_square();
  branching.facets.push_back({{0_node, 2_node}, {}});
  expect_error(branching, {"branches"});
}

TEST(TriangulationErrors, NonFiniteAndAbsentNodes) {
  auto cloud = unit_square();
  cloud.position[2].x() = std::numeric_limits<double>::quiet_NaN();
  expect_error(cloud, {"node 2", "not finite"});
  auto absent = unit_square();
  absent.facets[1].node[1] = 7_node;
  expect_error(absent, {"names node 7"});
}

TEST(TriangulationErrors, ZeroLengthFacet) {
  Cloud<2> cloud;
  add_loop(cloud, {{0, 0}, {1, 0}, {1, 0}, {0, 1}});
  expect_error(cloud, {"zero length"});
}

} // namespace
} // namespace cnem::voronoi::test
