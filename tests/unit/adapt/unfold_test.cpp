// A surface that has run into itself comes apart by the way that is shorter, wherever matter or a gap has
// been between, and keeps what it encloses. Where it has run into a seam the seam goes.
#include "adapt/space/unfold.hpp"
#include "core/geometry/mates.hpp"
#include "tests/space_clouds.hpp"
#include "voronoi/space/crossings.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace cnem::adapt {
namespace {

constexpr int cells = 6;
constexpr double h = 1.0 / cells;

/// A body that is unfolded.
struct Folded {
  Cloud<3> cloud;
  std::vector<Period> periods;
  IndexedVector<NodeIndex, Vec3> before;
  double volume = 0.0; ///< before it was folded
  PassReport report;

  explicit Folded(testing::SpaceShape shape)
      : cloud(testing::recovered({.shape = shape, .cells = cells}).cloud), volume(enclosed_measure(cloud)) {}

  void fold(const std::function<Vec3(const Vec3&)>& motion) {
    for (Vec3& x : cloud.position) x = motion(x);
    before = cloud.position;
    ASSERT_FALSE(voronoi::crossings(cloud).empty());
  }
  void unfold() {
    unfold_with(IndexedVector<NodeIndex, char>(cloud.position.size(), 0));
    EXPECT_TRUE(voronoi::crossings(cloud).empty());
  }
  void unfold_with(const IndexedVector<NodeIndex, char>& held) {
    SurfaceRules rules;
    for (const Period& period : periods) rules.still.insert(rules.still.end(), period.begin(), period.end());
    const std::size_t nodes = cloud.position.size();
    adapt::unfold(cloud, held, Field(nodes, h), PeriodImages(cloud, periods), rules, report);
  }
  Vec3 way(NodeIndex i) const { return cloud.position[i] - before[i]; }
};

/// 1 at a place, less around it.
double bump(const Vec3& x, const Vec3& place, double wide) {
  return std::exp(-(x - place).squaredNorm() / (wide * wide));
}

// The skin of a cut drags the border of a seam along until the seam lies flat below it, and what is left
// between them gets as thin as nothing: nodes of the seam come through the skin.
TEST(Unfold, a_seam_goes_back_under_a_face_that_keeps_its_nodes) {
  Folded body(testing::SpaceShape::cube);
  body.periods = {{testing::piece_of(body.cloud, "x-"), testing::piece_of(body.cloud, "x+")}};
  repeat_facets(body.cloud, body.periods);
  int moved = 0;
  body.fold([&](const Vec3& x) {
    const bool in_seam = x.x() < 1e-9 || x.x() > 1.0 - 1e-9;
    if (!in_seam || std::abs(x.z() - (1.0 - h)) > 1e-9 || std::abs(x.y() - 0.5) > 1.1 * h) return x;
    ++moved;
    return Vec3(x + h * Vec3(0.6, 0.0, 1.05));
  });
  ASSERT_EQ(moved, 6); // three and their images
  const double volume = enclosed_measure(body.cloud);
  body.unfold();
  EXPECT_NEAR(enclosed_measure(body.cloud), volume, 1e-14);
  IndexedVector<NodeIndex, char> on_seam(body.cloud.position.size(), 0);
  for (const auto& [a, b] : shifted_nodes(body.cloud, body.periods[0])) {
    EXPECT_LT((body.way(a) - body.way(b)).norm(), 1e-15);
    on_seam[a] = on_seam[b] = 1;
    if (body.way(a).isZero()) continue;
    const Vec3& x = body.cloud.position[body.before[a].x() < body.before[b].x() ? a : b];
    EXPECT_LT(x.z(), 1.0 - 0.19 * h); // matter is left between them
    EXPECT_LT(body.way(a).norm(), 0.3 * h);
  }
  for (const NodeIndex i : body.cloud.position.indices())
    if (!on_seam[i]) { EXPECT_EQ(body.cloud.position[i], body.before[i]); }
  EXPECT_EQ(body.report.folded, 6);
}

// Nodes of the border do not go with the seam: where they have come through the skin it stays crossed until
// faces are unfolded, and elsewhere it goes all the same.
TEST(Unfold, a_seam_goes_though_its_border_is_folded_elsewhere) {
  Folded body(testing::SpaceShape::cube);
  body.periods = {{testing::piece_of(body.cloud, "x-"), testing::piece_of(body.cloud, "x+")}};
  repeat_facets(body.cloud, body.periods);
  std::vector<NodeIndex> within, border;
  for (const NodeIndex i : body.cloud.position.indices()) {
    const Vec3& x = body.cloud.position[i];
    if ((x.x() > 1e-9 && x.x() < 1.0 - 1e-9) || std::abs(x.z() - (1.0 - h)) > 1e-9) continue;
    if (std::abs(x.y() - 4.0 * h) < 1e-9) within.push_back(i);
    if (x.y() < 1e-9) border.push_back(i);
  }
  ASSERT_EQ(within.size(), 2); // one and its image
  ASSERT_EQ(border.size(), 2);
  body.fold([&](const Vec3& x) {
    const NodeIndex i = as<NodeIndex>(&x - &*body.cloud.position.begin());
    if (std::find(within.begin(), within.end(), i) != within.end()) return Vec3(x + h * Vec3(0.6, 0.0, 1.05));
    if (std::find(border.begin(), border.end(), i) != border.end()) return Vec3(x + h * Vec3(0.4, 0.3, 1.05));
    return x;
  });
  body.unfold();
  for (const NodeIndex i : within) {
    EXPECT_LT((body.way(i) - body.way(within.front())).norm(), 1e-15);
    EXPECT_LT(body.cloud.position[i].z(), 1.0 - 0.19 * h); // smoothing alone ends nearer to the skin
  }
  for (const NodeIndex i : border) { EXPECT_LT(body.way(i).norm(), 0.5 * h * (1.0 + 1e-12)); }
}

// One side of a thin wall is dented until it comes out of the other: matter has been between, above both
// sides the surface is inside out. To push each away from the other, as walls of a gap, is the wrong way, and
// what smooths them then takes away most of the body.
TEST(Unfold, sides_of_a_wall_go_back_through_each_other) {
  Folded body(testing::SpaceShape::thin_wall);
  body.fold([](const Vec3& x) {
    const double dent = x.z() > 0.5 * h ? 1.25 * h * bump(x, {0.5, 0.5, x.z()}, std::sqrt(6.0) * h) : 0.0;
    return Vec3(x - dent * Vec3::UnitZ());
  });
  const double volume = enclosed_measure(body.cloud);
  body.unfold();
  // the dent has taken a third; a part of it, and no more, has to come back for the sides to be apart
  EXPECT_GT(enclosed_measure(body.cloud), volume);
  EXPECT_LT(enclosed_measure(body.cloud), 1.1 * volume);
}

// The walls of a notch have bulged into each other: they part, and what that takes, 1.6% of the volume, is
// given back but for a hundredth.
TEST(Unfold, walls_of_a_notch_part) {
  Folded body(testing::SpaceShape::notch);
  body.fold([](const Vec3& x) {
    if (x.x() > 0.5 - 0.1 * h) return x;
    const double bulge = 0.6 * h * bump(x, {0.3, x.y(), 0.24}, 2.0 * h);
    if (std::abs(x.y() - 0.5) < 1e-9) return Vec3(x + bulge * Vec3::UnitY());
    if (std::abs(x.y() - 0.5 - h) < 1e-9) return Vec3(x - bulge * Vec3::UnitY());
    return x;
  });
  const double volume = enclosed_measure(body.cloud);
  body.unfold();
  EXPECT_NEAR(enclosed_measure(body.cloud), volume, 2e-4 * volume);
}

// The same walls, where nothing but them may move: what they lose cannot be given back, and nothing is done.
TEST(Unfold, goes_back_where_the_body_would_lose_volume) {
  Folded body(testing::SpaceShape::notch);
  IndexedVector<NodeIndex, char> held(body.cloud.position.size(), 0);
  body.fold([&](const Vec3& x) {
    const NodeIndex i = as<NodeIndex>(&x - &*body.cloud.position.begin());
    const double bulge = 0.6 * h * bump(x, {0.3, x.y(), 0.24}, 2.0 * h);
    const double side = std::abs(x.y() - 0.5) < 1e-9 ? 1.0 : std::abs(x.y() - 0.5 - h) < 1e-9 ? -1.0 : 0.0;
    held[i] = x.x() > 0.5 - 0.1 * h || side == 0.0;
    return held[i] ? x : Vec3(x + side * bulge * Vec3::UnitY());
  });
  body.unfold_with(held);
  EXPECT_FALSE(voronoi::crossings(body.cloud).empty());
  for (const NodeIndex i : body.cloud.position.indices()) EXPECT_EQ(body.cloud.position[i], body.before[i]);
}

// Contact leaves faces that press on each other within each other by next to nothing.
TEST(Unfold, faces_that_touch_part_by_no_more_than_they_overlap) {
  Folded body(testing::SpaceShape::notch);
  body.cloud = testing::closed_notch(
      -1e-4, {.cells = cells, .jitter = 0.3, .shear_plane = 3, .wave = 0.001, .seed = 4}); // no planes
  body.fold([](const Vec3& x) { return x; });
  body.unfold();
  double farthest = 0.0;
  for (const NodeIndex i : body.cloud.position.indices()) farthest = std::max(farthest, body.way(i).norm());
  EXPECT_LT(farthest, 0.02 * h); // 0.4 h where all around is smoothed
}

} // namespace
} // namespace cnem::adapt
