// Resampling in the meridian plane of a body of revolution: volumes are those of rings, and the axis stays
// one.
#include "core/index.hpp"
#include "tests/conservation/blank.hpp"

#include <gtest/gtest.h>
#include <numbers>

namespace cnem::adapt {
namespace {

constexpr Space revolution = Space::revolution;

/// A disc of radius 1 m and 0.6 m thick.
Blank disc(double spacing) {
  Blank b = blank(spacing);
  b.weigh(spacing, revolution);
  return b;
}

double sum_of(const Field& field) {
  double sum = 0.0;
  for (const double v : field) sum += v;
  return sum;
}

TEST(OfRevolution, cells_turn_to_rings_that_fill_the_body) {
  const Blank b = disc(0.1);
  EXPECT_NEAR(sum_of(b.node.mass), 0.6 * std::numbers::pi, 1e-13);
  EXPECT_NEAR(enclosed_measure(b.cloud, revolution), 0.6 * std::numbers::pi, 1e-13);
}

TEST(OfRevolution, a_new_node_takes_the_rings_that_its_cell_takes) {
  Blank b = disc(0.1);
  // a hole of one cell near the axis, where the volume of a ring changes most across it
  NodeIndex inner = NodeIndex::none;
  for (const NodeIndex i : b.cloud.position.indices())
    if ((b.cloud.position[i] - Vec2(0.2, 0.3)).norm() < 0.06) inner = i;
  ASSERT_TRUE(exists(inner));
  Cloud<2> sparse = b.cloud;
  sparse.position = {};
  for (const NodeIndex i : b.cloud.position.indices())
    if (i != inner) sparse.position.push_back(b.cloud.position[i]);
  ASSERT_LT(b.cloud.facets.size(), index_of(inner)) << "boundary nodes come first";
  b.cloud = sparse;
  b.weigh(0.1, revolution);
  PassReport report;
  const Resampling<2> change =
      resample(b.cloud, structure_if_valid(b.cloud, revolution), b.node, {.space = revolution}, report);
  ASSERT_EQ(report.inserted, 1);
  Field mass = b.node.mass;
  carry_sum(change.parcels, mass);
  const Structure structure = build_structure(change.cloud, revolution);
  for (const NodeIndex i : change.cloud.position.indices())
    EXPECT_NEAR(mass[index_of(i)], structure.volume(i), 1e-12 * structure.volume(i)) << index_of(i);
}

TEST(OfRevolution, refinement_keeps_mass_and_the_axis) {
  Blank b = disc(0.1);
  for (double& h : b.node.size) h *= 0.5;
  PassReport report;
  const Resampling<2> change =
      resample(b.cloud, structure_if_valid(b.cloud, revolution), b.node, {.space = revolution}, report);
  EXPECT_GT(report.inserted, 100);
  EXPECT_NEAR(report.volume_change, 0.0, 1e-14);
  Field mass = b.node.mass;
  carry_sum(change.parcels, mass);
  EXPECT_NEAR(sum_of(mass), sum_of(b.node.mass), 1e-13);
  const Structure structure = build_structure(change.cloud, revolution);
  for (const NodeIndex i : change.cloud.position.indices()) {
    EXPECT_GT(structure.volume(i) / mass[index_of(i)], 0.8 - 1e-9);
    EXPECT_LT(structure.volume(i) / mass[index_of(i)], 1.25 + 1e-9);
  }
  int on_axis = 0;
  for (const Facet<2>& facet : change.cloud.facets) {
    const Vec2 &a = change.cloud.position[facet.node[0]], &c = change.cloud.position[facet.node[1]];
    if (a.x() < 1e-3 && c.x() < 1e-3) {
      EXPECT_EQ(a.x(), 0.0);
      EXPECT_EQ(c.x(), 0.0);
      ++on_axis;
    }
  }
  EXPECT_GE(on_axis, 10);
}

TEST(OfRevolution, what_lies_beyond_the_axis_has_no_structure) {
  Blank b = disc(0.1);
  for (Vec2& x : b.cloud.position) x.x() -= 0.3;
  EXPECT_TRUE(structure_if_valid(b.cloud));
  EXPECT_FALSE(structure_if_valid(b.cloud, revolution));
}

} // namespace
} // namespace cnem::adapt
