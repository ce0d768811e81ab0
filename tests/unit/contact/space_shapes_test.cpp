// Tools in space: signed distances against brute-force sampling, gradients, entries along paths, and shapes
// against each other.
#include "core/error.hpp"
#include "space_shapes.hpp"

#include <gtest/gtest.h>
#include <random>

using namespace cnem;
using namespace cnem::contact;
using namespace cnem::contact::testing;

namespace {

/// A solid by its inside alone: distances by rays from a point in many directions would be slow, so the
/// surface is sampled where rays along the axes of a fine grid enter and leave.
struct SampledSurface {
  std::vector<Vec3> points;

  template<class Inside> SampledSurface(const Inside& inside, const Box<3>& box, int n) {
    const Vec3 step = (box.high - box.low) / n;
    for (int axis = 0; axis < 3; ++axis) {
      const int a = (axis + 1) % 3, b = (axis + 2) % 3;
      for (int i = 0; i <= n; ++i)
        for (int j = 0; j <= n; ++j) {
          Vec3 x;
          x[a] = box.low[a] + (i + 1e-6) * step[a];
          x[b] = box.low[b] + (j + 1e-6) * step[b];
          bool was = false;
          for (int k = -1; k <= n + 1; ++k) {
            x[axis] = box.low[axis] + (k + 0.5) * step[axis];
            const bool is = inside(x);
            if (is != was) {
              Vec3 low = x, high = x;
              low[axis] -= step[axis];
              for (int halving = 0; halving < 30; ++halving) {
                Vec3 middle = 0.5 * (low + high);
                (inside(middle) == was ? low : high) = middle;
              }
              points.push_back(0.5 * (low + high));
            }
            was = is;
          }
        }
    }
  }
  double distance(const Vec3& x) const {
    double least = 1e300;
    for (const Vec3& p : points) least = std::min(least, (x - p).squaredNorm());
    return std::sqrt(least);
  }
};

/// Checks distances, signs, normals and feet of a shape against its inside, in the box enlarged by `margin`.
template<class Inside>
void expect_distances(const ToolShape<3>& shape, const Inside& inside, double margin, double tolerance) {
  Box<3> box = shape.bounds();
  const SampledSurface surface(inside, box, 70);
  for (const Vec3& p : surface.points) ASSERT_TRUE(((p - box.low).array() > -1e-6).all());
  std::mt19937 random(5);
  std::uniform_real_distribution<double> coordinate(0.0, 1.0);
  int within = 0;
  for (int k = 0; k < 300; ++k) {
    Vec3 x;
    for (int c = 0; c < 3; ++c)
      x[c] = box.low[c] - margin + coordinate(random) * (box.high[c] - box.low[c] + 2.0 * margin);
    const SurfacePoint<3> at = shape.closest(x);
    within += at.distance < 0.0;
    ASSERT_NEAR(std::abs(at.distance), surface.distance(x), tolerance) << x.transpose();
    if (std::abs(at.distance) > 1e-6) { ASSERT_EQ(at.distance < 0.0, inside(x)) << x.transpose(); }
    ASSERT_NEAR(at.normal.norm(), 1.0, 1e-12);
    ASSERT_LT((x - at.distance * at.normal - at.point).norm(), 1e-12);
    ASSERT_LT(std::abs(shape.closest(at.point).distance), 1e-9) << "the foot is on the surface";
    const double h = 1e-6; // along the normal distances grow at rate 1, also on the other side
    const double ahead = shape.closest(x + h * at.normal).distance;
    if (std::abs(at.distance) > 1e-3) { EXPECT_GT(ahead - at.distance, 0.0); }
    Vec3 gradient;
    for (int c = 0; c < 3; ++c)
      gradient[c] =
          (shape.closest(x + h * Vec3::Unit(c)).distance - shape.closest(x - h * Vec3::Unit(c)).distance) /
          (2.0 * h);
    if (std::abs(gradient.norm() - 1.0) < 1e-4) { // not on the medial axis
      ASSERT_LT((gradient - at.normal).norm(), 1e-3) << x.transpose();
    }
  }
  EXPECT_GT(within, 5);
}

Mat<3> some_rotation() { return rotation_about({1, 2, 3}, 1.1) * rotation_about({0, 0, 1}, 0.3); }

bool in_rounded_box(const Vec2& x, const Vec2& low, const Vec2& high, double r) {
  const Vec2 inner = x.cwiseMax(low + Vec2(r, r)).cwiseMin(high - Vec2(r, r));
  return (x - inner).norm() < r;
}

} // namespace

TEST(SweptShape, box_matches_sampling_when_turned) {
  const auto box =
      std::make_shared<SweptShape>(SweptShape::extruded(cnem::testing::box({-1, -0.5}, {1, 0.5}), -0.2, 0.6));
  const auto inside = [](const Vec3& x) {
    return std::abs(x.x()) < 1.0 && std::abs(x.y()) < 0.5 && x.z() > -0.2 && x.z() < 0.6;
  };
  expect_distances(*box, inside, 0.7, 0.03);
  const Mat<3> turn = some_rotation();
  const Vec3 shift(0.3, -2.0, 5.0);
  const PlacedShape placed(box, turn, shift);
  expect_distances(
      placed, [&](const Vec3& x) { return inside(turn.transpose() * (x - shift)); }, 0.7, 0.04);
}

TEST(SweptShape, punch_with_corner_radius_and_edge_radius_matches_sampling) {
  const double corner = 0.3, edge = 0.2;
  const SweptShape punch =
      SweptShape::extruded(rounded_box({-1, -0.7}, {1, 0.7}, corner), 0.0, 1.0, edge, 0.0);
  const auto inside = [&](const Vec3& x) {
    const Vec2 low(-1, -0.7), high(1, 0.7);
    if (x.z() <= 0.0 || x.z() >= 1.0) return false;
    // a slice below the edge radius is the outline moved inwards
    const double in = x.z() < edge ? edge - std::sqrt(edge * edge - (edge - x.z()) * (edge - x.z())) : 0.0;
    return in_rounded_box(x.head<2>(), low + Vec2(in, in), high - Vec2(in, in), corner - in);
  };
  expect_distances(punch, inside, 0.5, 0.03);
}

TEST(SweptShape, revolved_punch_and_ball_match_sampling) {
  const double r = 1.0, e = 0.25;
  const auto inside = [&](const Vec3& x) {
    const double d = x.head<2>().norm();
    if (x.z() <= 0.0 || x.z() >= 1.2 || d >= r) return false;
    return d < r - e || x.z() > e || std::hypot(d - (r - e), x.z() - e) < e;
  };
  const SweptShape punch = SweptShape::revolved(punch_section(r, 1.2, e));
  expect_distances(punch, inside, 0.5, 0.03);
  const SweptShape ball = SweptShape::revolved(half_disc(0.8));
  for (const Vec3& x :
       {Vec3(0.1, 0.2, 0.3), Vec3(1, 2, -3), Vec3(0, 0, 2), Vec3(0, 0, -0.1), Vec3(-1, 0, 0)}) {
    EXPECT_NEAR(ball.closest(x).distance, x.norm() - 0.8, 1e-14);
    EXPECT_LT((ball.closest(x).normal - x.normalized()).norm(), 1e-12);
  }
}

TEST(SweptShape, die_round_an_opening_matches_sampling) {
  const double e = 0.15, outer = 0.6, depth = 0.8, corner = 0.3;
  const SweptShape die =
      SweptShape::along(rounded_box({-1, -0.6}, {1, 0.6}, corner), die_section(0.0, outer, depth, e));
  const auto inside = [&](const Vec3& x) {
    if (x.z() >= 0.0 || x.z() <= -depth) return false;
    const Vec2 inner = x.head<2>().cwiseMax(Vec2(-0.7, -0.3)).cwiseMin(Vec2(0.7, 0.3));
    const double d = (x.head<2>() - inner).norm() - corner; // of the opening, where it is not deep inside
    const double least = x.z() > -e ? e - std::sqrt(e * e - (x.z() + e) * (x.z() + e)) : 0.0;
    return d > least && d < outer;
  };
  expect_distances(die, inside, 0.3, 0.03);
  // the flank is inside of the opening: from its middle out
  EXPECT_NEAR(die.closest({0, 0, -0.5}).distance, 0.6, 1e-12);
  EXPECT_LT((die.closest({0, 0.1, -0.5}).normal - Vec3(0, -1, 0)).norm(), 1e-12);
}

TEST(SweptShape, an_edge_that_does_not_fit_a_corner_is_refused) {
  EXPECT_THROW(SweptShape::extruded(cnem::testing::box({0, 0}, {1, 1}), 0.0, 1.0, 0.1), InputError);
  EXPECT_THROW(SweptShape::extruded(rounded_box({0, 0}, {1, 1}, 0.05), 0.0, 1.0, 0.1), InputError);
  EXPECT_NO_THROW(SweptShape::extruded(rounded_box({0, 0}, {1, 1}, 0.1), 0.0, 1.0, 0.1));
  EXPECT_THROW(SweptShape::extruded(cnem::testing::box({0, 0}, {1, 1}), 1.0, 1.0), InputError);
  EXPECT_THROW(SweptShape::extruded(rounded_box({0, 0}, {1, 1}, 0.4), 0.0, 0.2, 0.15, 0.15), InputError);
  EXPECT_THROW(SweptShape::revolved(cnem::testing::box({-0.1, 0}, {1, 1})), InputError);
  EXPECT_THROW(SweptShape::revolved(polygon({{0, 0}, {1, 0}, {1, 3}, {0, 3}, {0, 2}, {0.5, 1.5}, {0, 1}})),
               InputError);
}

TEST(SweptShape, entries_are_on_the_face_that_the_path_came_through) {
  const SweptShape box = SweptShape::extruded(cnem::testing::box({0, 0}, {1, 1}), 0.0, 1.0);
  struct Way {
    Vec3 from, to, normal;
    double gap, start;
  };
  const std::vector<Way> ways{
      {{0.5, 0.5, -0.1}, {0.5, 0.5, 0.01}, {0, 0, -1}, -0.01, 0.1},
      {{0.001, 0.5, -0.1}, {0.001, 0.5, 0.01}, {0, 0, -1}, -0.01, 0.1},  // the side is closer
      {{0.001, -0.1, 0.5}, {0.001, 0.01, 0.5}, {0, -1, 0}, -0.01, 0.1},  // so is another one
      {{1.1, 0.999, 0.001}, {0.99, 0.999, 0.001}, {1, 0, 0}, -0.01, 0.1} // in a corner
  };
  const PlacedShape turned(std::make_shared<SweptShape>(box), some_rotation(), {1, 2, 3});
  for (const Way& way : ways) {
    std::vector<Entry<3>> found;
    box.entries({&way.from, 1}, {&way.to, 1}, found);
    const Vec3 from = some_rotation() * way.from + Vec3(1, 2, 3),
               to = some_rotation() * way.to + Vec3(1, 2, 3);
    turned.entries({&from, 1}, {&to, 1}, found);
    ASSERT_EQ(found.size(), 2U);
    EXPECT_LT((found[0].at.normal - way.normal).norm(), 1e-12);
    EXPECT_LT((found[1].at.normal - some_rotation() * way.normal).norm(), 1e-12);
    for (const Entry<3>& entry : found) {
      EXPECT_NEAR(entry.at.distance, way.gap, 1e-12);
      EXPECT_NEAR(entry.start, way.start, 1e-12);
    }
    EXPECT_LT((found[1].at.point - (to - found[1].at.distance * found[1].at.normal)).norm(), 1e-12);
  }
  std::vector<Entry<3>> none;
  const Vec3 a(0.5, 0.5, -0.1), b(0.5, 0.5, -0.01);
  box.entries({&a, 1}, {&b, 1}, none);
  EXPECT_TRUE(none.empty());
}

TEST(SweptShape, thickness_is_that_of_the_way_through) {
  const SweptShape plate = SweptShape::extruded(cnem::testing::box({0, 0}, {4, 3}), 0.0, 0.5);
  EXPECT_NEAR(plate.least_thickness(), 0.5, 1e-12);
  EXPECT_NEAR(plate.passed({1, 1, -1}, {1, 1, 2}), 0.5, 1e-3);
  EXPECT_EQ(plate.passed({1, 1, -1}, {1, 1, 0.2}), 0.0);
  EXPECT_EQ(plate.passed({-1, 1, -1}, {0.3, 1, 0.3}), 0.0) << "round the edge is no way through";
  EXPECT_NEAR(plate.thickness_along({0, 0, 1}), 0.5, 1e-3);
  EXPECT_NEAR(plate.thickness_along({1, 0, 0}), 4.0, 1e-2);
  const SweptShape foil = SweptShape::extruded(cnem::testing::box({0, 0}, {4, 3}), 0.0, 1e-6);
  EXPECT_NEAR(foil.thickness_along({0, 0, 1}), 1e-6, 1e-8) << "steps along a path of its size pass it";
  const SweptShape punch = SweptShape::revolved(punch_section(1.0, 5.0, 0.1));
  EXPECT_NEAR(punch.thickness_along({0, 0, -1}), 4.9, 0.11);
  EXPECT_NEAR(punch.passed({-2, 0, 2}, {2, 0, 2}), 2.0, 1e-2);
}

TEST(SweptShape, ridges_of_a_box_are_twelve_edges_and_eight_corners) {
  for (const bool turned : {false, true}) {
    const auto box =
        std::make_shared<SweptShape>(SweptShape::extruded(cnem::testing::box({0, 0}, {2, 1}), 0.0, 3.0));
    const Mat<3> turn = turned ? some_rotation() : Mat<3>(Mat<3>::Identity());
    const PlacedShape shape(box, turn, {0, 0, 1});
    int edges = 0, corners = 0;
    double length = 0.0;
    for (const Ridge<3>& ridge : shape.ridges()) {
      if (ridge.is_point()) {
        ++corners;
        EXPECT_EQ(ridge.cone.size(), 3U);
        Vec3 middle = Vec3::Zero();
        for (const Vec3& n : ridge.cone) middle += n;
        EXPECT_TRUE(ridge.faces(middle.normalized()));
        EXPECT_FALSE(ridge.faces(-middle.normalized()));
        EXPECT_LT(std::abs(shape.closest(ridge.point()).distance), 1e-12);
        EXPECT_NEAR(shape.closest(ridge.point() + 0.1 * middle.normalized()).distance, 0.1, 1e-12);
        continue;
      }
      ++edges;
      length += ridge.length;
      const auto place = ridge.at(0.5 * ridge.length);
      const Vec2 middle = Eigen::Rotation2Dd(0.5 * ridge.section.angle) * ridge.section.first;
      const Vec3 n = middle.x() * place.u + middle.y() * ridge.v;
      EXPECT_NEAR(ridge.section.angle, 0.5 * std::numbers::pi, 1e-12);
      EXPECT_NEAR(n.dot(place.tangent), 0.0, 1e-12);
      EXPECT_TRUE(ridge.faces(n, place));
      EXPECT_FALSE(ridge.faces(-n, place));
      EXPECT_NEAR(shape.closest(place.centre + 0.1 * n).distance, 0.1, 1e-12) << "the fan looks outwards";
    }
    EXPECT_EQ(edges, 12);
    EXPECT_EQ(corners, 8);
    EXPECT_NEAR(length, 4.0 * (2 + 1 + 3), 1e-9);
  }
}

// Against places on them: extruded, of revolution, with the corners of a box.
TEST(SweptShape, ridges_end_where_points_are_told_their_clearance) {
  const SweptShape box = SweptShape::extruded(cnem::testing::box({0, 0}, {2, 1}), 0.0, 3.0),
                   punch = SweptShape::extruded(rounded_box({-1, -0.7}, {1, 0.7}, 0.3), 0.0, 1.0, 0.2),
                   round = SweptShape::revolved(punch_section(1.0, 2.0, 0.2));
  std::mt19937 random(7);
  std::uniform_real_distribution<double> within(-3.0, 4.0);
  constexpr int lengthwise = 300, across = 30;
  for (const SweptShape* shape : {&box, &punch, &round})
    for (const Ridge<3>& ridge : shape->ridges())
      for (int k = 0; k < 10; ++k) {
        const Vec3 x(within(random), within(random), within(random));
        double nearest = ridge.is_point() ? (x - ridge.point()).norm() : infinite;
        for (int n = 0; n <= lengthwise && !ridge.is_point(); ++n)
          for (int m = 0; m <= across; ++m) {
            const auto place = ridge.at(n * ridge.length / lengthwise);
            const Vec2 normal = Eigen::Rotation2Dd(m * ridge.section.angle / across) * ridge.section.first;
            const Vec3 on =
                place.centre + ridge.section.radius * (normal.x() * place.u + normal.y() * ridge.v);
            nearest = std::min(nearest, (x - on).norm());
          }
        EXPECT_NEAR(ridge.clearance(x), nearest, 2e-4);
      }
}

TEST(SweptShape, rounded_ridges_are_where_the_surface_is) {
  const SweptShape punch = SweptShape::extruded(rounded_box({-1, -0.7}, {1, 0.7}, 0.3), 0.0, 1.0, 0.2);
  const SweptShape round = SweptShape::revolved(punch_section(1.0, 2.0, 0.2));
  const SweptShape die = SweptShape::along(rounded_box({-1, -0.6}, {1, 0.6}, 0.3), die_section(0, 1, 1, 0.1));
  for (const SweptShape* shape : {&punch, &round, &die}) {
    EXPECT_GE(shape->ridges().size(), 2U);
    for (const Ridge<3>& ridge : shape->ridges())
      for (const double share : {0.1, 0.5, 0.9})
        for (const double turned : {0.1, 0.5, 0.9}) {
          const auto place = ridge.at(share * ridge.length);
          const Vec2 n2 = Eigen::Rotation2Dd(turned * ridge.section.angle) * ridge.section.first;
          const Vec3 n = n2.x() * place.u + n2.y() * ridge.v;
          const Vec3 x = place.centre + ridge.section.radius * n;
          ASSERT_LT(std::abs(shape->closest(x).distance), 1e-12);
          ASSERT_NEAR(shape->closest(x + 0.01 * n).distance, 0.01, 1e-12);
          const Box<3> box = ridge.bounds();
          ASSERT_TRUE(((x - box.low).array() > -1e-12).all() && ((box.high - x).array() > -1e-12).all());
        }
  }
}

TEST(TriangleShape, box_equals_the_extruded_one) {
  const Vec3 low(-1, -0.5, -0.2), high(1, 0.5, 0.6);
  const TriangleShape triangles(triangle_box(low, high));
  const SweptShape swept =
      SweptShape::extruded(cnem::testing::box(low.head<2>(), high.head<2>()), low.z(), high.z());
  std::mt19937 random(3);
  std::uniform_real_distribution<double> coordinate(-1.5, 1.5);
  for (int k = 0; k < 2000; ++k) {
    const Vec3 x{coordinate(random), coordinate(random), coordinate(random)};
    const auto a = triangles.closest(x), b = swept.closest(x);
    ASSERT_NEAR(a.distance, b.distance, 1e-12) << x.transpose();
    ASSERT_LT((x - a.distance * a.normal - a.point).norm(), 1e-12);
    if (a.distance > 1e-3) { ASSERT_LT((a.normal - b.normal).norm(), 1e-9); }
    const Vec3 to = x + 0.05 * Vec3{coordinate(random), coordinate(random), coordinate(random)};
    std::vector<Entry<3>> one, other;
    triangles.entries({&x, 1}, {&to, 1}, one);
    swept.entries({&x, 1}, {&to, 1}, other);
    ASSERT_EQ(one.size(), other.size());
    if (!one.empty() && b.distance > 0.0) {
      ASSERT_NEAR(one[0].at.distance, other[0].at.distance, 1e-12);
      ASSERT_LT((one[0].at.normal - other[0].at.normal).norm(), 1e-12);
      ASSERT_NEAR(one[0].start, other[0].start, 1e-12);
    }
  }
  std::size_t corners = 0;
  for (const Ridge<3>& ridge : triangles.ridges()) corners += ridge.is_point();
  EXPECT_EQ(corners, 8U);
  EXPECT_EQ(triangles.ridges().size(), 20U);
  EXPECT_NEAR(triangles.thickness_along({0, 0, 1}), 0.8, 1e-3);
  EXPECT_NEAR(triangles.least_thickness(), 0.4, 1e-9);
}

TEST(TriangleShape, fine_sphere_approaches_the_revolved_one) {
  const SweptShape ball = SweptShape::revolved(half_disc(1.0));
  double before = 0.0;
  for (const int divisions : {3, 4}) {
    const TriangleShape triangles(triangle_sphere(1.0, divisions));
    std::mt19937 random(3);
    std::uniform_real_distribution<double> coordinate(-1.3, 1.3);
    double worst = 0.0;
    for (int k = 0; k < 500; ++k) {
      const Vec3 x{coordinate(random), coordinate(random), coordinate(random)};
      if (x.norm() < 0.3) continue;
      const auto a = triangles.closest(x), b = ball.closest(x);
      worst = std::max(worst, std::abs(a.distance - b.distance));
      ASSERT_EQ(a.distance < 0.0, (x.norm() < 1.0 && a.distance < 0.0));
    }
    if (before > 0.0) { EXPECT_LT(worst, 0.3 * before) << "second order"; }
    before = worst;
  }
  EXPECT_LT(before, 4e-3);
}

TEST(TriangleShape, sign_at_edges_and_corners_is_that_of_the_weighted_normal) {
  // a thin wedge, whose corner sees points at which single triangles of it disagree
  TriangleSurface wedge;
  wedge.points = {{0, 0, 0}, {1, -0.05, 0}, {1, 0.05, 0}, {0.5, 0, 3}};
  wedge.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  const TriangleShape shape(wedge);
  for (const Vec3& x : {Vec3(-0.5, 0.3, -0.2), Vec3(-0.1, 0, 0), Vec3(-0.01, -1e-3, 1e-3), Vec3(0.5, 0, 4)})
    EXPECT_GT(shape.closest(x).distance, 0.0) << x.transpose();
  EXPECT_LT(shape.closest({0.6, 0, 0.5}).distance, 0.0);
}
