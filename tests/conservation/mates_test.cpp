// Faces that belong together: interfaces, closed cracks and periodic sides stay matched, node on node,
// through sequences of deformation and resampling, and nothing goes through them.
#include "adapt/marking.hpp"
#include "adapt/plane/resample.hpp"
#include "core/geometry/mates.hpp"
#include "tests/conservation/blank.hpp"
#include "tests/index_literals.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numeric>

namespace cnem::adapt {

using namespace testing::literals;
namespace {

constexpr double spacing = 0.1;

void add_block(Cloud<2>& cloud, double from, double to, double height = 0.6) {
  testing::add_loop(cloud, {{from, 0}, {to, 0}, {to, height}, {from, height}}, spacing);
}

Blank finished(Cloud<2> cloud, std::uint64_t seed) {
  Blank b;
  b.cloud = std::move(cloud);
  testing::declare_twins(b.cloud);
  pair_coincident_facets(b.cloud);
  testing::fill(b.cloud, testing::Lattice::hexagonal, spacing, 0.2, 0.5 * spacing, seed);
  b.weigh(spacing);
  return b;
}

/// Two blocks bonded at x = 0.5: parts 0 and 1.
Blank bonded(std::uint64_t seed = 1) {
  Cloud<2> cloud;
  add_block(cloud, 0.0, 0.5);
  add_block(cloud, 0.5, 1.0);
  Blank b = finished(std::move(cloud), seed);
  for (const Vec2& x : b.cloud.position) b.node.part.push_back(x.x() > 0.5 ? 1 : 0);
  for (const Facet<2>& facet : b.cloud.facets)
    if (facet.node[0] >= b.cloud.facets[b.cloud.facets.size() / 2].node[0]) b.node.part[facet.node[0]] = 1;
  return b;
}

/// A block with a closed crack inside, or one that comes from its lower side.
Blank cracked(bool open, std::uint64_t seed) {
  Cloud<2> cloud;
  if (open) {
    testing::add_loop(cloud, {{0, 0}, {0.5, 0}, {0.5, 0.35}, {0.5, 0}, {1, 0}, {1, 0.6}, {0, 0.6}}, spacing);
  } else {
    testing::add_loop(cloud, testing::rectangle(1.0, 0.6), spacing);
    testing::add_loop(cloud, {{0.3, 0.3}, {0.7, 0.3}}, spacing);
  }
  Blank b = finished(std::move(cloud), seed);
  for (const NodeIndex i : b.cloud.position.indices())
    if ((b.cloud.position[i] - Vec2(0.5, 0.35)).norm() < 1e-9) b.node.held[i] = 1;
  return b;
}

/// A strip whose left and right sides are a period apart.
Blank periodic(std::uint64_t seed) {
  Cloud<2> cloud;
  add_block(cloud, 0.0, 1.0);
  Blank b = finished(std::move(cloud), seed);
  std::vector<std::array<NodeIndex, 2>> sides;
  for (const NodeIndex i : b.cloud.position.indices())
    for (const NodeIndex k : b.cloud.position.indices())
      if (b.cloud.position[i].x() == 0.0 &&
          (b.cloud.position[k] - b.cloud.position[i] - Vec2(1, 0)).norm() < 1e-12)
        sides.push_back({i, k});
  pair_facets(b.cloud, sides);
  return b;
}

/// Sums to 1 over each old node, and what is in one part stays there.
void expect_parcels(const Resampling<2>& change, const IndexedVector<NodeIndex, std::int32_t>& old_part,
                    const IndexedVector<NodeIndex, std::int32_t>& part) {
  Field of_old(change.new_of.size(), 0.0);
  for (std::size_t p = 0; p < change.parcels.size(); ++p)
    for (auto e = index_of(change.parcels.begin[p]); e < index_of(change.parcels.begin[p + 1]); ++e) {
      of_old[index_of(change.parcels.from[e])] += change.parcels.weight[e];
      if (!part.empty()) { ASSERT_EQ(old_part[change.parcels.from[e]], part[p]); }
    }
  for (const double sum : of_old) ASSERT_NEAR(sum, 1.0, 1e-12);
}

/// Facet for facet; `shift` from one node of a pair to the other, or back.
void expect_matched(const Cloud<2>& cloud, double shift) {
  ASSERT_EQ(cloud.mates.size(), cloud.facets.size());
  int faces = 0;
  for (const CloudFacetIndex f : cloud.mates.indices()) {
    if (!exists(cloud.mates[f])) continue;
    ++faces;
    ASSERT_EQ(cloud.mates[cloud.mates[f]], f);
  }
  ASSERT_GE(faces, 4);
  for (const auto& [a, b] : mated_nodes(cloud)) {
    if (shift == 0.0) { ASSERT_EQ(cloud.position[a], cloud.position[b]); }
    const Vec2 apart = cloud.position[a] - cloud.position[b];
    ASSERT_NEAR(std::abs(apart.x()), shift, 1e-14);
    ASSERT_NEAR(apart.y(), 0.0, 1e-14);
  }
}

struct Mated {
  const char* name;
  Blank (*make)(std::uint64_t seed);
  double shift;
};

class Matched : public ::testing::TestWithParam<Mated> {};

TEST_P(Matched, through_sequences) {
  PassReport total;
  int on_faces = 0, fewer = 0; // facets of faces that were divided, and joined
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE(seed);
    testing::Random random(seed);
    Blank b = GetParam().make(seed);
    for (int pass = 0; pass < 4; ++pass) {
      const double shear = random.uniform(-0.3, 0.3), wave = random.uniform(-0.06, 0.06);
      std::vector<char> boundary(b.cloud.position.size(), 0);
      for (const Facet<2>& facet : b.cloud.facets) boundary[index_of(facet.node[0])] = 1;
      for (std::size_t i = 0; i < b.cloud.position.size(); ++i) {
        Vec2& x = b.cloud.position[i];
        x = {x.x() + wave * std::sin(9.0 * x.y()) + shear * x.y(), x.y()};
        if (GetParam().shift == 0.0) x.y() += wave * std::sin(7.0 * x.x());
        if (!boundary[i] && random.uniform(0, 1) < 0.03) // some pass others, or a boundary
          x += spacing * Vec2(random.uniform(-1, 1), random.uniform(-1, 1));
      }
      const double factor = pass % 2 == 0 ? 0.5 : 2.0; // one side, or the other, finer and coarser
      for (std::size_t i = 0; i < b.cloud.position.size(); ++i)
        if ((b.cloud.position[i].y() > 0.3) == (seed % 2 == 0))
          b.node.size[i] = std::clamp(factor * b.node.size[i], 0.5 * spacing, 2.0 * spacing);
      const auto faces = [](const Cloud<2>& cloud) { return static_cast<int>(mated_nodes(cloud).size()); };
      PassReport report;
      const double mass = std::accumulate(b.node.mass.begin(), b.node.mass.end(), 0.0);
      const Resampling<2> change = resample(b.cloud, structure_if_valid(b.cloud), b.node, {}, report);
      (faces(change.cloud) > faces(b.cloud) ? on_faces : fewer) +=
          std::abs(faces(change.cloud) - faces(b.cloud));
      const auto old_part = b.node.part;
      if (!old_part.empty()) carry_label(change.labels, b.node.part);
      ASSERT_NO_FATAL_FAILURE(expect_parcels(change, old_part, b.node.part));
      carry_mean(change.parcels, b.node.mass, b.node.jacobian);
      carry_sum(change.parcels, b.node.mass);
      carry_label(change.labels, b.node.size);
      b.node.density.assign(b.node.size.size(), 1.0);
      IndexedVector<NodeIndex, char> held(b.node.size.size(), 0);
      for (const NodeIndex i : held.indices())
        if (exists(change.old_of[i])) held[i] = b.node.held[change.old_of[i]];
      b.node.held = std::move(held);
      EXPECT_NEAR(std::accumulate(b.node.mass.begin(), b.node.mass.end(), 0.0), mass, 1e-12 * mass);
      b.cloud = change.cloud;
      ASSERT_NO_FATAL_FAILURE(expect_matched(b.cloud, GetParam().shift));
      ASSERT_NO_FATAL_FAILURE(expect_exact_patch(b.cloud));
      total += report;
    }
  }
  EXPECT_GT(on_faces, 100);
  EXPECT_GT(fewer, 100);
  EXPECT_GT(total.inserted, 100);
  EXPECT_GT(total.removed, 100);
  EXPECT_LT(total.undone, 20);
}

INSTANTIATE_TEST_SUITE_P(
    Of, Matched,
    ::testing::Values(Mated{"interface", bonded, 0.0}, Mated{"period", periodic, 1.0},
                      Mated{"crack_inside", [](std::uint64_t s) { return cracked(false, s); }, 0.0},
                      Mated{"crack_from_a_side", [](std::uint64_t s) { return cracked(true, s); }, 0.0}),
    [](const auto& kind) { return kind.param.name; });

TEST(Mates, a_node_that_strays_through_an_interface_goes_back) {
  Blank b = bonded();
  const auto near = std::min_element(b.cloud.position.begin(), b.cloud.position.end(), [&](auto& x, auto& y) {
    const auto away = [](const Vec2& z) { return (z - Vec2(0.42, 0.3)).norm(); };
    return away(x) < away(y);
  });
  const auto stray = as<NodeIndex>(near - b.cloud.position.begin());
  ASSERT_EQ(b.node.part[stray], 0);
  near->x() = 0.56;
  const double mass = [&] {
    double sum = 0.0;
    for (const NodeIndex i : b.cloud.position.indices())
      if (b.node.part[i] == 0) sum += b.node.mass[index_of(i)];
    return sum;
  }();
  PassReport report;
  const Resampling<2> change = resample(b.cloud, structure_if_valid(b.cloud), b.node, {}, report);
  EXPECT_EQ(report.outside, 1);
  EXPECT_FALSE(exists(change.new_of[stray]));
  auto part = b.node.part;
  carry_label(change.labels, part);
  carry_sum(change.parcels, b.node.mass);
  double after = 0.0;
  for (const NodeIndex i : part.indices())
    if (part[i] == 0) after += b.node.mass[index_of(i)];
  EXPECT_NEAR(after, mass, 1e-14);
  expect_matched(change.cloud, 0.0);
}

TEST(Mates, inner_nodes_do_not_become_part_of_one_face) {
  Blank b = bonded();
  const auto near = std::min_element(b.cloud.position.begin(), b.cloud.position.end(), [&](auto& x, auto& y) {
    const auto away = [](const Vec2& z) { return (z - Vec2(0.42, 0.35)).norm(); };
    return away(x) < away(y);
  });
  *near = {0.49, 0.35};
  PassReport report;
  const Resampling<2> change = resample(b.cloud, structure_if_valid(b.cloud), b.node, {}, report);
  EXPECT_EQ(report.promoted, 0);
  EXPECT_FALSE(exists(change.new_of[as<NodeIndex>(near - b.cloud.position.begin())]));
}

TEST(Mates, finest_of_both_sides_is_wanted) {
  Blank b = bonded();
  for (std::size_t i = 0; i < b.node.size.size(); ++i)
    if (b.node.part[i] == 1) b.node.size[i] = 0.04;
  limit_growth<2>(b.cloud, build_structure(b.cloud), 0.3, b.node.size);
  for (const auto& [one, other] : mated_nodes(b.cloud))
    EXPECT_EQ(b.node.size[index_of(one)], b.node.size[index_of(other)]);
  for (std::size_t i = 0; i < b.node.size.size(); ++i)
    EXPECT_LE(b.node.size[i], 0.04 + 0.3 * 1.2 * std::hypot(b.cloud.position[i].x() - 0.5, 0.5 * spacing));
}

} // namespace
} // namespace cnem::adapt
