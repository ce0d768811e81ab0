// Plane cuts through closed surfaces: loops close, turn round the solid, and enclose what the plane cuts.
#include "core/geometry/plane_section.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace cnem {
namespace {

/// A box from one corner to the other, its normals outwards.
TriangleSurface box(const Vec3& low, const Vec3& high) {
  TriangleSurface surface;
  for (int k = 0; k < 8; ++k)
    surface.points.emplace_back(k & 1 ? high.x() : low.x(), k & 2 ? high.y() : low.y(),
                                k & 4 ? high.z() : low.z());
  const std::array<std::array<std::int32_t, 4>, 6> faces{
      {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
  for (const auto& f : faces) {
    surface.triangles.push_back({f[0], f[1], f[2]});
    surface.triangles.push_back({f[0], f[2], f[3]});
  }
  return surface;
}

double area_of(const std::vector<SectionLoop>& loops) {
  double sum = 0.0;
  for (const SectionLoop& loop : loops) sum += loop.area();
  return sum;
}

TEST(PlaneSection, of_a_box_has_the_area_that_the_plane_cuts) {
  const TriangleSurface surface = box({0, 0, 0}, {1, 2, 3});
  check_closed(surface);
  EXPECT_NEAR(area_of(cut(surface, {{0, 0, 1.3}, {1, 0, 0}, {0, 1, 0}})), 2.0, 1e-14);
  EXPECT_NEAR(area_of(cut(surface, {{0, 0.5, 0}, {0, 0, 1}, {1, 0, 0}})), 3.0, 1e-14);
  const Vec3 right(1, 0, 0), up = Vec3(0, 1, 1).normalized(); // cuts from y = 0, z = 0.5 to y = 2, z = 2.5
  EXPECT_NEAR(area_of(cut(surface, {{0, 0, 0.5}, right, up})), 2.0 * std::sqrt(2.0), 1e-14);
  EXPECT_TRUE(cut(surface, {{0, 0, 4}, {1, 0, 0}, {0, 1, 0}}).empty());
}

// A plane through nodes, edges or along whole faces cuts each edge or not: loops close all the same.
TEST(PlaneSection, through_corners_and_along_faces_closes) {
  const TriangleSurface surface = box({0, 0, 0}, {1, 1, 1});
  const Vec3 up(0, 0, 1), right = Vec3(1, 1, 0).normalized();
  EXPECT_NEAR(area_of(cut(surface, {{0, 0, 0}, right, up})), std::sqrt(2.0), 1e-14);
  const double low = area_of(cut(surface, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}})),
               high = area_of(cut(surface, {{0, 0, 1}, {1, 0, 0}, {0, 1, 0}}));
  EXPECT_NEAR(low + high, 1.0, 1e-14); // of two opposite faces in the plane one counts
}

TEST(PlaneSection, cavities_count_against_what_is_round_them) {
  TriangleSurface surface = box({0, 0, 0}, {4, 4, 4}), hole = box({1, 1, 1}, {3, 2, 3});
  for (auto& t : hole.triangles) {
    std::swap(t[1], t[2]);
    for (auto& i : t) i += 8;
    surface.triangles.push_back(t);
  }
  surface.points.insert(surface.points.end(), hole.points.begin(), hole.points.end());
  const auto loops = cut(surface, {{0, 0, 2}, {1, 0, 0}, {0, 1, 0}});
  ASSERT_EQ(loops.size(), 2U);
  EXPECT_NEAR(area_of(loops), 14.0, 1e-13);
  EXPECT_TRUE(inside(loops[0].point, {2, 1.5}));
  EXPECT_TRUE(inside(loops[1].point, {2, 1.5}));
  EXPECT_FALSE(inside(loops[1].point, {2, 2.5}));
  for (const SectionLoop& loop : loops)
    for (std::size_t k = 0; k < loop.point.size(); ++k) {
      const Vec3 &a = surface.points[static_cast<std::size_t>(loop.edge[k][0])],
                 &b = surface.points[static_cast<std::size_t>(loop.edge[k][1])];
      const Vec3 x = a + loop.share[k] * (b - a);
      EXPECT_NEAR((x.head<2>() - loop.point[k]).norm(), 0.0, 1e-14);
    }
}

TEST(PlaneSection, ears_fill_polygons_with_notches) {
  const std::vector<Vec2> el{{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 3}, {0, 3}};
  double area = 0.0;
  for (const auto& [a, b, c] : ear_triangles(el)) {
    const double twice = cross(el[b] - el[a], el[c] - el[a]);
    EXPECT_GT(twice, 0.0);
    area += 0.5 * twice;
  }
  EXPECT_NEAR(area, 5.0, 1e-14);
}

} // namespace
} // namespace cnem
