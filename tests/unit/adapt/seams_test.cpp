// Sides of a slice between periodic planes that the skin has dragged until they lie flat below it.
#include "adapt/space/seams.hpp"
#include "core/geometry/facets.hpp"
#include "core/geometry/mates.hpp"
#include "tests/space_clouds.hpp"
#include "voronoi/space/crossings.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace cnem::adapt {
namespace {

/// A cube, periodic along x, whose skin has gone by `lean` h along x, the layer `thick` h below it not.
struct Dragged {
  static constexpr int cells = 6;
  static constexpr double h = 1.0 / cells;
  Cloud<3> cloud = testing::recovered({.shape = testing::SpaceShape::cube, .cells = cells}).cloud;
  std::vector<Period> periods{{testing::piece_of(cloud, "x-"), testing::piece_of(cloud, "x+")}};
  IndexedVector<NodeIndex, char> held = IndexedVector<NodeIndex, char>(cloud.position.size(), 0);
  IndexedVector<NodeIndex, Vec3> before;
  int straightened = 0;

  double top;

  explicit Dragged(double lean, double thick = 1.0) : top(1.0 - h + thick * h) {
    repeat_facets(cloud, periods);
    for (Vec3& x : cloud.position)
      if (x.z() > 1.0 - 1e-9) x = {x.x() + lean * h, x.y(), top};
    before = cloud.position;
  }
  void straighten() {
    SurfaceRules rules;
    for (const Period& period : periods) rules.still.insert(rules.still.end(), period.begin(), period.end());
    straightened +=
        straighten_seams(cloud, PeriodImages(cloud, periods), held, Field(cloud.position.size(), h), rules);
  }
  bool is_border(NodeIndex i) const { return before[i].z() > top - 1e-9; }

  /// Least angle between the top and a facet of a side with two nodes in the top, not at its ends, degrees.
  double least_angle() const {
    double least = 180.0;
    for (const auto& facet : cloud.facets) {
      if (facet.piece != periods[0][0] && facet.piece != periods[0][1]) continue;
      const auto inside = [&](NodeIndex i) { return std::abs(before[i].y() - 0.5) < 0.5 - 1e-9; };
      if (std::count_if(facet.node.begin(), facet.node.end(), [&](NodeIndex i) { return is_border(i); }) !=
              2 ||
          !std::all_of(facet.node.begin(), facet.node.end(), inside))
        continue;
      const Vec3 n = area_normal<3>(corners_of<3>(facet, cloud.position)).normalized();
      least = std::min(least, (180.0 - std::acos(n.z()) * 180.0 / std::numbers::pi));
    }
    return least;
  }
};

TEST(Seams, rise_from_below_the_skin) {
  constexpr double h = Dragged::h;
  Dragged body(1.2, 0.2);
  const double angle = body.least_angle();
  ASSERT_LT(angle, 10.0);
  const double volume = enclosed_measure(body.cloud);
  for (int pass = 0; pass < 4; ++pass) body.straighten();
  EXPECT_GT(body.least_angle(), 20.0); // after one of them
  EXPECT_NEAR(enclosed_measure(body.cloud), volume, 1e-14);
  EXPECT_TRUE(voronoi::crossings(body.cloud).empty());
  IndexedVector<NodeIndex, char> on_seam(body.cloud.position.size(), 0);
  int borders = 0;
  for (const auto& [a, b] : shifted_nodes(body.cloud, body.periods[0])) {
    on_seam[a] = on_seam[b] = 1;
    const Vec3 way = body.cloud.position[a] - body.before[a];
    EXPECT_LT((way - (body.cloud.position[b] - body.before[b])).norm(), 1e-15);
    if (body.is_border(a)) {
      EXPECT_NEAR(way.z(), 0.0, 1e-15); // it stays in the skin
      borders += way.x() < -0.2 * h;    // back over what is thin, along an edge or a diagonal
    } else {
      EXPECT_LE(way.z(), 0.0);
    }
  }
  EXPECT_GE(borders, Dragged::cells - 1); // but for the ends, where the top meets other faces
  for (const NodeIndex i : body.cloud.position.indices())
    if (!on_seam[i]) { EXPECT_EQ(body.cloud.position[i], body.before[i]); }
  EXPECT_GT(body.straightened, 0);
}

TEST(Seams, that_stand_at_more_than_twelve_degrees_stay) {
  Dragged body(4.0); // 14 degrees, as sides of what is sheared to 4
  body.straighten();
  EXPECT_EQ(body.straightened, 0);
  EXPECT_EQ(body.cloud.position, body.before);
}

TEST(Seams, that_are_held_stay) {
  Dragged body(6.0);
  std::fill(body.held.begin(), body.held.end(), 1);
  body.straighten();
  EXPECT_EQ(body.straightened, 0);
}

// The bottom has a spike that ends just below the side: what would go into it stays, with its image.
TEST(Seams, do_not_cross_anything) {
  constexpr double h = Dragged::h;
  Dragged body(1.2, 0.2);
  const Vec3 foot(h, 0.5, 0.0), tip(0.3 * h, 0.5, 1.0 - 0.97 * h), above(0.0, 0.5, 1.0 - h);
  for (Vec3& x : body.cloud.position)
    if ((x - foot).norm() < 1e-9) x = tip;
  body.before = body.cloud.position;
  ASSERT_TRUE(voronoi::crossings(body.cloud).empty());
  body.straighten();
  EXPECT_TRUE(voronoi::crossings(body.cloud).empty());
  EXPECT_GT(body.straightened, 0);
  for (const auto& [a, b] : shifted_nodes(body.cloud, body.periods[0]))
    for (const auto& [i, k] : {std::pair{a, b}, {b, a}})
      if ((body.before[i] - above).norm() < 1e-9) {
        EXPECT_EQ(body.cloud.position[i], body.before[i]);
        EXPECT_EQ(body.cloud.position[k], body.before[k]);
      }
}

} // namespace
} // namespace cnem::adapt
