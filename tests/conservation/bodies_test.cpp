// Bodies that lie in each other: each goes through a pass as if it were alone.
#include "adapt/plane/resample.hpp"
#include "core/index.hpp"
#include "tests/conservation/blank.hpp"

#include <gtest/gtest.h>
#include <numeric>

namespace cnem::adapt {
namespace {

constexpr double body_spacing = 0.1;

/// A blank that has been stretched, with its lower left corner there.
Blank stretched(const Vec2& corner, double by) {
  Blank b = blank(body_spacing);
  for (Vec2& x : b.cloud.position) x = corner + Vec2(by * x.x(), x.y() / by);
  return b;
}

/// Both as bodies of one cloud.
Blank together(const Blank& one, const Blank& other) {
  Blank b = one;
  const auto n = one.cloud.position.size();
  b.cloud.body.assign(n, 0);
  b.cloud.position.insert(b.cloud.position.end(), other.cloud.position.begin(), other.cloud.position.end());
  b.cloud.body.resize(b.cloud.position.size(), 1);
  for (Facet<2> facet : other.cloud.facets) {
    for (NodeIndex& i : facet.node) i = as<NodeIndex>(n + index_of(i));
    b.cloud.facets.push_back(facet);
  }
  b.weigh(body_spacing);
  b.node.part = b.cloud.body;
  return b;
}

TEST(OverlappingBodies, go_through_a_pass_as_each_would_alone) {
  const Blank one = stretched({0, 0}, 2.5), other = stretched({0.03, 0.6 / 2.5 - 0.04}, 0.5);
  const Blank both = together(one, other);
  PassReport of_one, of_other, of_both;
  resample(one.cloud, structure_if_valid(one.cloud), one.node, {}, of_one);
  resample(other.cloud, structure_if_valid(other.cloud), other.node, {}, of_other);
  const Resampling<2> change = resample(both.cloud, structure_if_valid(both.cloud), both.node, {}, of_both);
  EXPECT_GT(of_both.inserted, 5);
  EXPECT_GT(of_both.removed, 5);
  EXPECT_EQ(of_both.undone, 0);
  EXPECT_EQ(of_both.inserted, of_one.inserted + of_other.inserted);
  EXPECT_EQ(of_both.inserted_boundary, of_one.inserted_boundary + of_other.inserted_boundary);
  EXPECT_EQ(of_both.removed, of_one.removed + of_other.removed);
  EXPECT_EQ(of_both.removed_boundary, of_one.removed_boundary + of_other.removed_boundary);
  EXPECT_NEAR(of_both.volume_change, of_one.volume_change + of_other.volume_change, 1e-14);
  expect_exact_patch(change.cloud);
  Field mass(2, 0.0), before(2, 0.0);
  for (std::size_t p = 0; p < change.parcels.size(); ++p)
    for (auto e = index_of(change.parcels.begin[p]); e < index_of(change.parcels.begin[p + 1]); ++e) {
      const NodeIndex from = change.parcels.from[e];
      ASSERT_EQ(both.cloud.body[from], change.cloud.body[p]) << "matter of one body in another";
      mass[index_of(change.cloud.body[p])] += change.parcels.weight[e] * both.node.mass[index_of(from)];
    }
  for (const NodeIndex i : both.cloud.position.indices())
    before[index_of(both.cloud.body[i])] += both.node.mass[index_of(i)];
  for (std::size_t k = 0; k < 2; ++k) EXPECT_NEAR(mass[k], before[k], 1e-14);
}

TEST(OverlappingBodies, take_back_inner_nodes_that_have_left_them) {
  Blank both = together(stretched({0, 0}, 1.0), stretched({0, 0.55}, 1.0));
  NodeIndex stray{}; // of the lower body, into the other where both are
  for (const NodeIndex i : both.cloud.position.indices())
    if (both.cloud.body[i] == 0 && (both.cloud.position[i] - Vec2(0.5, 0.5)).norm() <
                                       (both.cloud.position[stray] - Vec2(0.5, 0.5)).norm())
      stray = i;
  both.cloud.position[stray] = {0.5, 0.62};
  EXPECT_FALSE(structure_if_valid(both.cloud));
  PassReport report;
  const Resampling<2> change = resample(both.cloud, std::nullopt, both.node, {}, report);
  EXPECT_EQ(report.outside, 1);
  EXPECT_FALSE(exists(change.new_of[stray]));
  for (std::size_t p = 0; p < change.parcels.size(); ++p)
    for (auto e = index_of(change.parcels.begin[p]); e < index_of(change.parcels.begin[p + 1]); ++e)
      ASSERT_EQ(both.cloud.body[change.parcels.from[e]], change.cloud.body[p]);
}

} // namespace
} // namespace cnem::adapt
