// Sequences of insertion, removal and new references on random deforming clouds: nothing fails, parcels add
// up, and the patch test stays exact after each.
#include "adapt/plane/resample.hpp"
#include "core/error.hpp"
#include "core/index.hpp"
#include "tests/clouds.hpp"
#include "tests/conservation/blank.hpp"
#include "tests/index_literals.hpp"

#include <gtest/gtest.h>

namespace cnem::adapt {

using namespace testing::literals;
namespace {

using cnem::testing::Random;

Cloud<2> domain(int kind, double spacing, std::uint64_t seed) {
  Cloud<2> cloud;
  if (kind == 0) {
    testing::add_loop(cloud, testing::rectangle(1.0, 0.6), spacing);
  } else if (kind == 1) {
    testing::add_loop(cloud, {{0, 0}, {1, 0}, {1, 0.4}, {0.4, 0.4}, {0.4, 1}, {0, 1}}, spacing);
  } else if (kind == 2) {
    testing::add_loop(cloud, testing::rectangle(1.0, 1.0), spacing);
    testing::add_loop(cloud, testing::ring({0.55, 0.45}, 0.2, 0.2, 16, true), spacing);
  } else {
    testing::add_loop(cloud, testing::ring({0, 0}, 0.8, 0.45, 12), spacing);
  }
  testing::fill(cloud, testing::Lattice::hexagonal, spacing, 0.2, 0.5 * spacing, seed);
  return cloud;
}

/// A smooth random motion of area-preserving shears.
struct Motion {
  explicit Motion(Random& random) {
    for (double& a : amplitude) a = random.uniform(-0.12, 0.12);
    for (double& w : wave) w = random.uniform(1.0, 5.0);
  }
  Vec2 operator()(const Vec2& x) const {
    const Vec2 sheared(x.x() + amplitude[0] * std::sin(wave[0] * x.y()) + amplitude[1] * x.y(), x.y());
    return {sheared.x(),
            sheared.y() + amplitude[2] * std::sin(wave[1] * sheared.x()) + amplitude[3] * sheared.x()};
  }
  double amplitude[4], wave[2];
};

struct Carried {
  Field mass, momentum, heat, jacobian, size;
  IndexedVector<NodeIndex, char> held;
};

void one_sequence(int kind, std::uint64_t seed, Placement placement, PassReport& total) {
  Random random(seed);
  const double spacing = random.uniform(0.08, 0.14);
  Cloud<2> cloud = domain(kind, spacing, seed);
  Structure structure = build_structure(cloud);
  Carried c;
  const auto n = cloud.position.size();
  c.size.assign(n, spacing);
  c.held.assign(n, 0);
  for (std::size_t i = 0; i < n; ++i) {
    c.jacobian.push_back(random.uniform(0.99, 1.01));
    c.mass.push_back(structure.cells.volume[i] / c.jacobian.back());
    c.momentum.push_back(c.mass.back() * random.uniform(-1, 1));
    c.heat.push_back(c.mass.back() * random.uniform(300, 900));
  }
  for (int pass = 0; pass < 4; ++pass) {
    const Motion motion(random);
    std::vector<char> boundary(cloud.position.size(), 0);
    for (const Facet<2>& facet : cloud.facets) boundary[index_of(facet.node[0])] = 1;
    for (std::size_t i = 0; i < cloud.position.size(); ++i) {
      Vec2& x = cloud.position[i];
      x = motion(x);
      if (!boundary[i] && random.uniform(0, 1) < 0.05) // some nodes pass others, or the boundary
        x += spacing * Vec2(random.uniform(-1, 1), random.uniform(-1, 1));
    }
    for (double& h : c.size)
      if (random.uniform(0, 1) < 0.02) h *= random.uniform(0, 1) < 0.5 ? 0.5 : 2.0;
    const auto total_of = [](const Field& f) {
      double sum = 0.0;
      for (const double v : f) sum += v;
      return sum;
    };
    const double mass = total_of(c.mass), momentum = total_of(c.momentum), heat = total_of(c.heat);
    const double scale = mass;
    PassReport report;
    Resampling<2> change;
    try {
      change = resample(cloud, structure_if_valid(cloud),
                        {c.mass, c.jacobian, Field(c.mass.size(), 1.0), c.size, c.held, {}},
                        {.placement = placement}, report);
    } catch (const GeometryError&) { FAIL() << "kind " << kind << " seed " << seed << " pass " << pass; }
    Field of_old(c.mass.size(), 0.0);
    for (std::size_t e = 0; e < change.parcels.from.size(); ++e) {
      ASSERT_GT(change.parcels.weight[e], 0.0);
      of_old[index_of(change.parcels.from[e])] += change.parcels.weight[e];
    }
    for (const double sum : of_old) ASSERT_NEAR(sum, 1.0, 1e-12);
    for (std::size_t p = 0; p < change.labels.size(); ++p) {
      double sum = 0.0;
      for (auto e = index_of(change.labels.begin[p]); e < index_of(change.labels.begin[p + 1]); ++e)
        sum += change.labels.weight[e];
      ASSERT_NEAR(sum, 1.0, 1e-12);
    }
    carry_mean(change.parcels, c.mass, c.jacobian);
    carry_sum(change.parcels, c.mass);
    carry_sum(change.parcels, c.momentum);
    carry_sum(change.parcels, c.heat);
    carry_label(change.labels, c.size);
    c.held.assign(c.size.size(), 0);
    EXPECT_NEAR(total_of(c.mass), mass, 1e-12 * scale);
    EXPECT_NEAR(total_of(c.momentum), momentum, 1e-12 * scale);
    EXPECT_NEAR(total_of(c.heat), heat, 1e-12 * heat);
    for (const double m : c.mass) ASSERT_GT(m, 0.0);
    EXPECT_NEAR(testing::area(change.cloud) - testing::area(cloud), report.volume_change, 1e-14);
    cloud = std::move(change.cloud);
    expect_exact_patch(cloud);
    if (::testing::Test::HasFatalFailure()) return;
    total += report;
  }
}

class Sequences : public ::testing::TestWithParam<int> {};

TEST_P(Sequences, keep_sums_and_the_patch_test) {
  PassReport total;
  for (std::uint64_t seed = 0; seed < 125; ++seed)
    for (const Placement placement : {Placement::between_nodes, Placement::voronoi_vertices}) {
      one_sequence(GetParam(), seed, placement, total);
      if (HasFatalFailure()) return;
    }
  // the sequences did what they are for
  EXPECT_GT(total.inserted, 100);
  EXPECT_GT(total.inserted_boundary, 100);
  EXPECT_GT(total.removed, 100);
  EXPECT_GT(total.removed_boundary, 10);
  EXPECT_GT(total.outside, 5);
  EXPECT_GT(total.promoted, 0);
  EXPECT_GT(total.balanced, 100);
}
INSTANTIATE_TEST_SUITE_P(Of, Sequences, ::testing::Range(0, 4));

TEST(Resample, a_good_cloud_is_left_alone_to_the_bit) {
  const Blank b = blank(0.1);
  PassReport report;
  const Resampling<2> change = resample(b.cloud, structure_if_valid(b.cloud), b.node, {}, report);
  EXPECT_FALSE(report.changed());
  ASSERT_EQ(change.cloud.position.size(), b.cloud.position.size());
  for (std::size_t i = 0; i < b.cloud.position.size(); ++i) {
    EXPECT_EQ(change.cloud.position[i], b.cloud.position[i]);
    EXPECT_FALSE(change.mixed(i));
    EXPECT_EQ(change.old_of[i], as<NodeIndex>(i));
  }
}

TEST(Resample, halving_the_spacing_makes_about_four_times_the_nodes_with_their_share_of_mass) {
  Blank b = blank(0.1);
  const auto n = static_cast<double>(b.cloud.nodes());
  for (double& h : b.node.size) h *= 0.5;
  PassReport report;
  const Resampling<2> change = resample(b.cloud, structure_if_valid(b.cloud), b.node, {}, report);
  EXPECT_GT(static_cast<double>(change.cloud.nodes()), 3.0 * n);
  EXPECT_LT(static_cast<double>(change.cloud.nodes()), 4.2 * n);
  Field mass = b.node.mass;
  carry_sum(change.parcels, mass);
  const Structure structure = build_structure(change.cloud);
  for (std::size_t i = 0; i < mass.size(); ++i) {
    EXPECT_GT(structure.cells.volume[i] / mass[i], 0.8 - 1e-9);
    EXPECT_LT(structure.cells.volume[i] / mass[i], 1.25 + 1e-9);
  }
}

TEST(Resample, doubling_the_spacing_removes_most_nodes_and_keeps_the_boundary) {
  Blank b = blank(0.05);
  const auto n = static_cast<double>(b.cloud.nodes());
  for (double& h : b.node.size) h *= 2.0;
  for (const std::int32_t corner : {0, 20, 32, 52}) b.node.held[index_of(corner)] = 1;
  for (int pass = 0; pass < 3; ++pass) {
    PassReport report;
    const Resampling<2> change = resample(b.cloud, structure_if_valid(b.cloud), b.node, {}, report);
    b.cloud = change.cloud;
    carry_mean(change.parcels, b.node.mass, b.node.jacobian);
    for (Field* field : {&b.node.mass}) carry_sum(change.parcels, *field);
    for (Field* field : {&b.node.size, &b.node.density}) carry_label(change.labels, *field);
    IndexedVector<NodeIndex, char> held;
    for (const NodeIndex old : change.old_of) held.push_back(exists(old) ? b.node.held[old] : 0);
    b.node.held = held;
  }
  EXPECT_LT(static_cast<double>(b.cloud.nodes()),
            0.6 * n); // spacings from 0.62 to 1.6 of the wanted are left
  EXPECT_GT(static_cast<double>(b.cloud.nodes()), 0.2 * n);
  EXPECT_NEAR(testing::area(b.cloud), 0.6, 1e-12);
}

TEST(Resample, a_node_that_left_the_domain_gives_its_mass_to_the_nearest_edge) {
  Blank b = blank(0.1);
  NodeIndex inner = NodeIndex::none;
  for (const NodeIndex i : b.cloud.position.indices()) {
    const Vec2& x = b.cloud.position[i];
    if (x.y() > 0.05 && x.y() < 0.15 && x.x() > 0.45 && x.x() < 0.55) inner = i;
  }
  ASSERT_TRUE(exists(inner));
  b.cloud.position[inner].y() = -0.01;
  PassReport report;
  const Resampling<2> change = resample(b.cloud, structure_if_valid(b.cloud), b.node, {}, report);
  EXPECT_EQ(report.outside, 1);
  EXPECT_EQ(change.new_of[inner], NodeIndex::none);
  Field mass = b.node.mass;
  carry_sum(change.parcels, mass);
  double sum = 0.0;
  for (const double m : mass) sum += m;
  EXPECT_NEAR(sum, 0.6, 1e-12);
}

TEST(Resample, an_inner_node_at_a_long_edge_becomes_part_of_it) {
  Blank b = blank(0.1);
  // the boundary node at (0.5, 0) gone and an inner one near its place
  NodeIndex inner = NodeIndex::none;
  for (const NodeIndex i : b.cloud.position.indices()) {
    const Vec2& x = b.cloud.position[i];
    if (x.y() > 0.05 && x.y() < 0.15 && std::abs(x.x() - 0.55) < 0.051 && !exists(inner)) inner = i;
  }
  ASSERT_TRUE(exists(inner));
  b.cloud.position[inner] = {0.55, 0.02};
  for (double& h : b.node.size) h = 0.08;
  PassReport report;
  const Resampling<2> change = resample(b.cloud, structure_if_valid(b.cloud), b.node, {}, report);
  EXPECT_EQ(report.promoted, 1);
  const NodeIndex now = change.new_of[inner];
  ASSERT_TRUE(exists(now));
  EXPECT_NEAR(change.cloud.position[now].y(), 0.0, 1e-15);
  EXPECT_NEAR(testing::area(change.cloud), 0.6, 1e-14);
}

// On the side of a punch nodes slide along one line, and one may be carried past the next.
TEST(Resample, a_boundary_that_turns_back_on_itself_is_mended) {
  Blank b = blank(0.1);
  NodeIndex first = NodeIndex::none;
  for (const Facet<2>& facet : b.cloud.facets)
    if (std::abs(b.cloud.position[facet.node[0]].x() - 0.4) < 1e-9 &&
        b.cloud.position[facet.node[0]].y() == 0.0)
      first = facet.node[0];
  ASSERT_TRUE(exists(first));
  b.cloud.position[first].x() = 0.53; // beyond the one at 0.5
  EXPECT_THROW(build_structure(b.cloud), GeometryError);
  PassReport report;
  const Resampling<2> change = resample(b.cloud, structure_if_valid(b.cloud), b.node, {}, report);
  EXPECT_EQ(report.folded, 1);
  Field mass = b.node.mass;
  carry_sum(change.parcels, mass);
  double sum = 0.0;
  for (const double m : mass) sum += m;
  EXPECT_NEAR(sum, 0.6, 1e-12);
  EXPECT_NEAR(testing::area(change.cloud), 0.6, 1e-12);
}

TEST(Resample, a_small_loop_of_the_boundary_is_cut_off) {
  Blank b = blank(0.1);
  NodeIndex left = NodeIndex::none;
  for (const Facet<2>& facet : b.cloud.facets) {
    const Vec2& x = b.cloud.position[facet.node[0]];
    if (std::abs(x.x() - 0.4) < 1e-9 && x.y() == 0.0) left = facet.node[0];
  }
  ASSERT_TRUE(exists(left));
  b.cloud.position[left] = {0.55, 0.01};
  b.cloud.position[index_of(left) + 1] = {0.45, 0.02};
  EXPECT_THROW(build_structure(b.cloud), GeometryError);
  PassReport report;
  const Resampling<2> change = resample(b.cloud, structure_if_valid(b.cloud), b.node, {}, report);
  EXPECT_GE(report.folded, 1);
}

} // namespace
} // namespace cnem::adapt
