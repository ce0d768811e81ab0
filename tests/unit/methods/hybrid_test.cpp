// The hybrid of natural elements and triangles beyond the contract (tests/contract): which functions are
// where.
#include "core/index.hpp"
#include "methods/hybrid.hpp"
#include "tests/unit/mechanics/models.hpp"

#include <array>
#include <gtest/gtest.h>
#include <map>

namespace cnem::testing {
namespace {

constexpr double zone_spacing = 0.11; ///< m, of a cloud of 0.1 m

Cloud<2> cloud_of_both() { return rectangle(2.0, 1.0, 0.1, Lattice::hexagonal, 0.2); }

/// Entries of a row: nodes with the gradients of their functions, 1/m.
std::map<NodeIndex, std::array<double, 2>> row_of(const DiscreteOperators<2>& op, NodeIndex i) {
  std::map<NodeIndex, std::array<double, 2>> row;
  for (auto e = index_of(op.row_begin[index_of(i)]); e < index_of(op.row_begin[index_of(i) + 1]); ++e)
    row[op.node[e]] = {op.gradient[0][e], op.gradient[1][e]};
  return row;
}

TEST(Hybrid, is_cnem_in_the_zone_and_triangles_beyond) {
  const Cloud<2> cloud = cloud_of_both();
  const auto mesh = voronoi::triangulate(cloud);
  const auto zone = methods::natural_zone(cloud, mesh, zone_spacing);
  IndexedVector<NodeIndex, int> around(cloud.position.size(), 0), fine(cloud.position.size(), 0);
  for (const SimplexIndex t : mesh.node.indices())
    for (const NodeIndex i : mesh.node[t]) {
      ++around[i];
      if (zone[t]) ++fine[i];
    }
  const auto natural = scni::Cnem().rebuild(cloud).mechanics,
             linear = methods::Hybrid().rebuild(cloud).mechanics,
             hybrid = methods::Hybrid(zone_spacing).rebuild(cloud).mechanics;
  int natural_rows = 0, linear_rows = 0;
  for (const NodeIndex i : cloud.position.indices()) {
    if (fine[i] == around[i]) {
      EXPECT_EQ(row_of(hybrid, i), row_of(natural, i));
      ++natural_rows;
    }
    if (fine[i] == 0) {
      EXPECT_EQ(row_of(hybrid, i), row_of(linear, i));
      ++linear_rows;
    }
  }
  EXPECT_GT(natural_rows, 10);
  EXPECT_GT(linear_rows, 10);
  EXPECT_EQ(row_of(methods::Hybrid(10.0).rebuild(cloud).mechanics, 0_node), row_of(natural, 0_node));
}

TEST(Hybrid, triangles_have_fewer_neighbours) {
  const Cloud<2> cloud = cloud_of_both();
  const auto entries = [&](double spacing) {
    return static_cast<double>(methods::Hybrid(spacing).rebuild(cloud).mechanics.node.size());
  };
  EXPECT_LT(entries(0.0), 0.9 * entries(10.0));
  EXPECT_LT(entries(0.0), entries(zone_spacing));
  EXPECT_LT(entries(zone_spacing), entries(10.0));
}

TEST(Hybrid, zone_ends_with_the_longest_edge) {
  Cloud<2> cloud;
  add_loop(cloud, {{0, 0}, {3, 0}, {3, 4}}, 10.0);
  const auto mesh = voronoi::triangulate(cloud);
  ASSERT_EQ(mesh.triangles(), 1);
  EXPECT_TRUE(methods::natural_zone(cloud, mesh, 5.0)[0]);
  EXPECT_FALSE(methods::natural_zone(cloud, mesh, 4.999)[0]);
}

} // namespace
} // namespace cnem::testing
