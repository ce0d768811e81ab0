// The surface keeps its resolution: of short edges no more nodes go than have to, and edges run out of thin
// metal.
#include "adapt/space/refine_surface.hpp"
#include "adapt/space/sharp_creases.hpp"
#include "tests/space_clouds.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace cnem::adapt {
namespace {

using testing::SpaceShape;

WorkingSurface loose_surface_of(const Cloud<3>& cloud) {
  return WorkingSurface(cloud, IndexedVector<NodeIndex, char>(cloud.position.size(), 0));
}

// Edges of 0.42 h become edges of 0.83 h, a few of three lengths, not all of as many as go below the limit
// for splits: that would be 4 on each edge of the cube.
TEST(RefineSurface, of_a_row_of_short_edges_every_second_node_goes) {
  const Cloud<3> cloud = testing::unrecovered({.shape = SpaceShape::cube, .cells = 12});
  WorkingSurface surface = loose_surface_of(cloud);
  Field size(cloud.position.size(), 0.2);
  PassReport report;
  refine_surface(surface, size, {}, report, PeriodImages(cloud, {}));
  int edges = 0;
  double longest = 0.0;
  for (WorkingSurface::Edge e = 0; e < surface.edges(); ++e) {
    if (!surface.alive(e) || !surface.crease(e) || surface.across(e) < e) continue;
    ++edges;
    longest = std::max(longest, surface.length(e));
  }
  EXPECT_GT(edges, 12 * 5.5);
  EXPECT_LT(longest, 1.3 * 0.2);
}

// A cube that is sheared by 4 has two edges of 14 degrees, 1/sin α = √17.
TEST(RefineSurface, spacing_is_wider_where_metal_runs_out) {
  constexpr double h = 0.1, widest = 4.0;
  Cloud<3> cloud = testing::unrecovered({.shape = SpaceShape::cube, .cells = 10});
  const Field wanted(cloud.position.size(), h);
  EXPECT_EQ(spacing_at_sharp_creases(loose_surface_of(cloud), wanted), wanted);
  Cloud<3> leaning = cloud; // by γ = 1: 45 degrees
  for (Vec3& x : cloud.position) x.x() += 4.0 * x.y();
  for (Vec3& x : leaning.position) x.x() += x.y();
  const Field spacing = spacing_at_sharp_creases(loose_surface_of(cloud), wanted);
  const Field wider = spacing_at_sharp_creases(loose_surface_of(leaning), wanted);
  for (const NodeIndex i : cloud.position.indices()) {
    const Vec3& x = cloud.position[i];
    const double sharp = std::min(std::hypot(x.x(), x.y()), std::hypot(x.x() - 5.0, x.y() - 1.0));
    const double now = spacing[index_of(i)];
    EXPECT_GE(now, h);
    if (sharp < 1e-9) {
      EXPECT_DOUBLE_EQ(now, widest * h);
      EXPECT_NEAR(wider[index_of(i)], std::sqrt(2.0) * h, 1e-12);
    }
    EXPECT_LE(now, std::max(h, widest * h - 0.5 * sharp) + 1e-12);
  }
}

} // namespace
} // namespace cnem::adapt
