// Broken matter that flies apart is not filled up with nodes.
#include "tests/conservation/blank.hpp"

#include <array>
#include <gtest/gtest.h>
#include <numbers>
#include <numeric>

namespace cnem::adapt {
namespace {

/// A blank that has grown in passes to `times` its width and height; where it began left of `border` all of
/// its stress is lost.
Cloud<2> grown(const Vec2& times, double border, Placement placement) {
  constexpr double spacing = 0.1;
  constexpr int passes = 8;
  Blank b = blank(spacing);
  ResampleRules rules;
  rules.placement = placement;
  rules.split.least_loop = 1000; // nothing is to be cut
  for (int pass = 1; pass <= passes; ++pass) {
    const Vec2 each(std::pow(times.x(), 1.0 / passes), std::pow(times.y(), 1.0 / passes));
    for (Vec2& x : b.cloud.position) x = x.cwiseProduct(each);
    b.weigh(spacing);
    const double jacobian = std::pow(each.prod(), pass), now = border * std::pow(each.x(), pass);
    b.node.jacobian.assign(b.node.mass.size(), jacobian);
    for (double& mass : b.node.mass) mass /= jacobian;
    b.node.broken.clear();
    for (const Vec2& x : b.cloud.position) b.node.broken.push_back(x.x() < now ? 1.0 : 0.5);
    PassReport report;
    b.cloud = resample(b.cloud, structure_if_valid(b.cloud), b.node, rules, report).cloud;
  }
  return b.cloud;
}

/// A blank of which three nodes of the left side have flown off, `way` m, so far apart that no angle is
/// sharp; they have opened to `times` their volume. Those that are left of it after a pass.
std::ptrdiff_t flown_nodes(double way, double times) {
  Blank b = blank(0.1);
  const std::array to{Vec2(-0.5 * way, 0.3 - way), Vec2(-way, 0.3), Vec2(-0.5 * way, 0.3 + way)};
  std::vector<NodeIndex> gone;
  for (std::size_t k = 0; k < to.size(); ++k)
    for (const NodeIndex i : b.cloud.position.indices())
      if ((b.cloud.position[i] - Vec2(0.0, 0.2 + 0.1 * static_cast<double>(k))).norm() < 1e-6) {
        gone.push_back(i);
        b.cloud.position[i] = to[k];
      }
  EXPECT_EQ(gone.size(), to.size());
  b.weigh(0.1);
  b.node.broken.assign(b.node.mass.size(), 0.5);
  for (const NodeIndex i : gone) {
    b.node.broken[index_of(i)] = 1.0;
    b.node.jacobian[index_of(i)] = times;
  }
  ResampleRules rules;
  rules.split.least_loop = 1000;
  PassReport report;
  const Resampling<2> change = resample(b.cloud, structure_if_valid(b.cloud), b.node, rules, report);
  double mass = 0.0;
  for (std::size_t p = 0; p < index_of(change.cloud.nodes()); ++p)
    for (auto e = index_of(change.parcels.begin[p]); e < index_of(change.parcels.begin[p + 1]); ++e)
      mass += change.parcels.weight[e] * b.node.mass[index_of(change.parcels.from[e])];
  EXPECT_NEAR(mass, std::accumulate(b.node.mass.begin(), b.node.mass.end(), 0.0), 1e-12);
  return std::count_if(gone.begin(), gone.end(), [&](NodeIndex i) { return exists(change.new_of[i]); });
}

// In the cutting of flax a shred of three such nodes turned inside out, and no reference followed.
TEST(FlownDebris, joins_what_it_hangs_on) {
  EXPECT_LE(flown_nodes(1.0, 5.0), 1);
  EXPECT_EQ(flown_nodes(1.0, 1.0), 3) << "no debris";
  EXPECT_EQ(flown_nodes(0.3, 5.0), 3) << "near";
}

/// How many bodies a pass joins with a blank of which there is one, with these corners and no other nodes,
/// opened to `times` its volume, one of whose nodes is broken by `last`.
int joined_bodies(const std::vector<Vec2>& corners, double times, double last, int inside = 0) {
  Blank b = blank(0.1);
  const std::size_t first = b.cloud.position.size(),
                    nodes = corners.size() + static_cast<std::size_t>(inside);
  testing::add_loop(b.cloud, corners, 1.0);
  const Vec2 middle = 0.5 * (corners[0] + corners[corners.size() / 2]);
  for (int k = 0; k < inside; ++k) b.cloud.position.push_back(middle + Vec2(0.1 * k, 0.0));
  EXPECT_EQ(b.cloud.position.size(), first + nodes);
  b.weigh(0.1);
  b.node.broken.assign(b.node.mass.size(), 0.5);
  for (std::size_t i = first; i < first + nodes; ++i) {
    b.node.broken[i] = i + 1 < first + nodes ? 1.0 : last;
    b.node.jacobian[i] = times;
  }
  WorkingCloud work(b.cloud, b.node);
  Structure structure = build_structure(b.cloud);
  PassReport report;
  join_crumbs(work, structure, {}, report);
  EXPECT_EQ(index_of(work.finish().cloud.nodes()), first + (report.crumbs == 1 ? 0 : nodes));
  return report.crumbs;
}

/// A bar above the blank, 0.1 m high.
std::vector<Vec2> bar(double length) {
  return {{0.2, 0.8}, {0.2 + length, 0.8}, {0.2 + length, 0.9}, {0.2, 0.9}};
}
/// So many corners above the blank, half a metre apart.
std::vector<Vec2> ring(int corners) {
  std::vector<Vec2> list;
  const double radius = 0.25 / std::sin(std::numbers::pi / corners);
  for (int k = 0; k < corners; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / corners;
    list.push_back(Vec2(0.5, 0.7 + radius) + radius * Vec2(std::cos(angle), std::sin(angle)));
  }
  return list;
}

// In the cutting of flax bodies of five and of eight or more such nodes, 58 and 40 to 70 µm long where they
// stood 3 and 6 µm apart, turned inside out.
TEST(FlownDebris, of_its_own_joins_what_is_nearest) {
  EXPECT_EQ(joined_bodies(bar(0.5), 5.0, 1.0), 1);
  EXPECT_EQ(joined_bodies(bar(0.5), 1.0, 1.0), 0) << "no debris";
  EXPECT_EQ(joined_bodies(bar(0.5), 5.0, 0.9), 0) << "one of its nodes bears";
  EXPECT_EQ(joined_bodies(bar(0.3), 5.0, 1.0), 0) << "near";
  EXPECT_EQ(joined_bodies(ring(16), 5.0, 1.0), 1);
  EXPECT_EQ(joined_bodies(ring(17), 5.0, 1.0), 0) << "many";
  EXPECT_EQ(joined_bodies(ring(10), 5.0, 1.0, 3), 1) << "with nodes inside";
  EXPECT_EQ(joined_bodies(ring(10), 5.0, 0.9, 3), 0) << "one inside bears";
  EXPECT_EQ(joined_bodies(ring(14), 5.0, 1.0, 3), 0) << "many";
}

class Debris : public ::testing::TestWithParam<Placement> {};

TEST_P(Debris, keeps_its_nodes_when_it_flies_apart) {
  const auto before = static_cast<double>(blank(0.1).cloud.position.size());
  for (const Vec2& times : {Vec2(5, 5), Vec2(12, 1)}) {
    const auto debris = static_cast<double>(grown(times, 2.0, GetParam()).position.size());
    EXPECT_LT(debris, 4.5 * before) << "what it had at four times its volume, and some";
    EXPECT_GT(debris, before) << times.transpose();
    EXPECT_GT(static_cast<double>(grown(times, -1.0, GetParam()).position.size()), 5.0 * before)
        << "what holds together is filled up";
  }
}

TEST_P(Debris, leaves_what_holds_together_beside_it_alone) {
  const auto right_of = [&](const Cloud<2>& cloud) {
    return std::count_if(cloud.position.begin(), cloud.position.end(),
                         [](const Vec2& x) { return x.x() > 3.0; });
  };
  const auto half = static_cast<double>(right_of(grown({5, 5}, 0.5, GetParam()))),
             whole = static_cast<double>(right_of(grown({5, 5}, -1.0, GetParam())));
  EXPECT_NEAR(half, whole, 0.1 * whole);
}

INSTANTIATE_TEST_SUITE_P(Placed, Debris,
                         ::testing::Values(Placement::between_nodes, Placement::voronoi_vertices));

} // namespace
} // namespace cnem::adapt
