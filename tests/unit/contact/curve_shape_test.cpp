// Signed distances and normals of segment-arc tools against brute-force sampling, and entry through faces.
#include "core/error.hpp"
#include "masses.hpp"

#include <gtest/gtest.h>
#include <random>

using namespace cnem;
using namespace cnem::contact;
using namespace cnem::contact::testing;

namespace {

/// Concave and convex, with concave and convex arcs and an oblique side.
Curve odd_tool() {
  Curve c;
  c.pieces = {segment({0, 0}, {3, 0}),
              arc({3, 0}, {4, 1}, {3, 1}),
              segment({4, 1}, {3.5, 3}),
              segment({3.5, 3}, {2.5, 3}),
              arc({2.5, 3}, {1.5, 3}, {2, 3}, true), // a notch
              segment({1.5, 3}, {1, 3}),
              segment({1, 3}, {1, 2}),
              segment({1, 2}, {0, 2}),
              segment({0, 2}, {0, 0})};
  return c;
}

Curve disc() {
  Curve c;
  c.pieces = {arc({1, 0}, {1, 0}, {0, 0})};
  return c;
}

struct Samples {
  std::vector<Vec2> point;
  explicit Samples(const Curve& curve, int per_piece = 4000) {
    for (const CurvePiece& piece : curve.pieces)
      for (int i = 0; i < per_piece; ++i) point.push_back(piece.point(double(i) / per_piece));
  }
  double distance(const Vec2& x) const {
    double least = 1e300;
    for (const Vec2& p : point) least = std::min(least, (x - p).squaredNorm());
    return std::sqrt(least);
  }
  bool inside(const Vec2& x) const {
    double turn = 0.0;
    for (std::size_t i = 0; i < point.size(); ++i) {
      const Vec2 a = point[i] - x, b = point[(i + 1) % point.size()] - x;
      turn += std::atan2(cross(a, b), a.dot(b));
    }
    return turn > std::numbers::pi;
  }
};

} // namespace

TEST(CurveShape, SignedDistanceMatchesBruteForceSampling) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> coordinate(-2.0, 5.0);
  for (const Curve& curve : {odd_tool(), disc(), rounded_box({-1, -1}, {3, 2}, 0.4), box({0, 0}, {2, 1}),
                             rotated(odd_tool(), 2.1), polygon({{0, 0}, {4, 0}, {0.2, 0.5}})}) {
    const CurveShape shape(curve);
    const Samples samples(curve);
    int inside = 0;
    for (int k = 0; k < 600; ++k) {
      const Vec2 x{coordinate(random), coordinate(random)}; // braces: in this order with every compiler
      const SurfacePoint<2> found = shape.closest(x);
      inside += found.distance < 0.0;
      ASSERT_NEAR(std::abs(found.distance), samples.distance(x), 1e-3) << x.transpose();
      if (std::abs(found.distance) > 1e-3) {
        ASSERT_EQ(found.distance < 0.0, samples.inside(x)) << x.transpose();
      }
      ASSERT_NEAR(found.normal.norm(), 1.0, 1e-12);
      ASSERT_LT((x - found.distance * found.normal - found.point).norm(), 1e-12) << x.transpose();
    }
    EXPECT_GT(inside, 5);
  }
}

TEST(CurveShape, NormalIsTheGradientOfTheDistance) {
  const CurveShape shape(odd_tool());
  std::mt19937 random(3);
  std::uniform_real_distribution<double> coordinate(-1.0, 5.0);
  int tested = 0;
  for (int k = 0; k < 500; ++k) {
    const Vec2 x{coordinate(random), coordinate(random)}; // braces: in this order with every compiler
    const SurfacePoint<2> here = shape.closest(x);
    const double h = 1e-6;
    Vec2 gradient;
    bool same = true;
    for (int i = 0; i < 2; ++i) {
      const SurfacePoint<2> up = shape.closest(x + h * Vec2::Unit(i)),
                            down = shape.closest(x - h * Vec2::Unit(i));
      same = same && up.feature == here.feature && down.feature == here.feature;
      gradient[i] = (up.distance - down.distance) / (2.0 * h);
    }
    if (!same) continue;
    ++tested;
    ASSERT_LT((gradient - here.normal).norm(), 1e-6) << x.transpose();
  }
  EXPECT_GT(tested, 450);
}

TEST(CurveShape, PointsOnTheSurfaceHaveNoDistanceAndAnOutwardNormal) {
  for (const Curve& curve : {odd_tool(), disc(), rounded_box({-1, -1}, {3, 2}, 0.4)}) {
    const CurveShape shape(curve);
    for (const CurvePiece& piece : curve.pieces)
      for (const double s : {0.0, 0.3, 0.5, 1.0}) {
        const SurfacePoint<2> found = shape.closest(piece.point(s));
        EXPECT_LT(std::abs(found.distance), 1e-14);
        EXPECT_GT(found.normal.dot(right_normal(piece.tangent(s))), 0.1)
            << piece.point(s).transpose() << " s " << s << " n " << found.normal.transpose() << " f "
            << found.feature;
        EXPECT_LT(shape.closest(piece.point(s) - 1e-6 * found.normal).distance, 0.0);
        EXPECT_GT(shape.closest(piece.point(s) + 1e-6 * found.normal).distance, 0.0);
      }
  }
}

TEST(CurveShape, BoundsEncloseArcsTightly) {
  const Box<2> bounds = CurveShape(disc()).bounds();
  EXPECT_LT((bounds.low - Vec2(-1, -1)).norm(), 1e-14);
  EXPECT_LT((bounds.high - Vec2(1, 1)).norm(), 1e-14);
}

TEST(CurveShape, EntryIsThroughTheFaceThatThePathCrossed) {
  const CurveShape shape(box({0, 0}, {1, 1}));
  // both end closest to the left side, but came through the bottom
  const std::vector<Vec2> from{{0.01, -0.1}, {0.01, 0.5}, {-0.1, 0.01}, {0.5, 2.0}};
  const std::vector<Vec2> to{{0.01, 0.1}, {0.02, 0.5}, {0.02, 0.01}, {0.5, 1.5}};
  std::vector<Entry<2>> found;
  shape.entries(from, to, found);
  ASSERT_EQ(found.size(), 3U);
  EXPECT_EQ(found[0].index, 0);
  EXPECT_LT((found[0].at.normal - Vec2(0, -1)).norm(), 1e-15);
  EXPECT_NEAR(found[0].at.distance, -0.1, 1e-15);
  EXPECT_NEAR(found[0].start, 0.1, 1e-15);
  EXPECT_LT((found[1].at.normal - Vec2(-1, 0)).norm(), 1e-15); // inside from the start: the closest
  EXPECT_NEAR(found[1].start, -0.01, 1e-15);
  EXPECT_LT((found[2].at.normal - Vec2(-1, 0)).norm(), 1e-15);
}

TEST(CurveShape, EntryThroughConvexAndConcaveArcs) {
  const CurveShape shape(odd_tool());
  const Vec2 d = Vec2(1, -1).normalized();
  const std::vector<Vec2> from{Vec2(3, 1) + 1.1 * d, Vec2(2, 3) - Vec2(0, 0.4)};
  const std::vector<Vec2> to{Vec2(3, 1) + 0.8 * d, Vec2(2, 3) - Vec2(0, 0.7)};
  std::vector<Entry<2>> found;
  shape.entries(from, to, found);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_LT((found[0].at.normal - d).norm(), 1e-12);
  EXPECT_NEAR(found[0].at.distance, -0.2, 1e-12);
  EXPECT_NEAR(found[0].start, 0.1, 1e-12);
  EXPECT_LT((found[1].at.normal - Vec2(0, 1)).norm(), 1e-12);
  EXPECT_NEAR(found[1].at.distance, -0.2, 1e-12);
  EXPECT_NEAR(found[1].start, 0.1, 1e-12);
}

TEST(CurveShape, RidgesAreConvexCornersAndArcs) {
  const CurveShape square(box({0, 0}, {1, 1}));
  ASSERT_EQ(square.ridges().size(), 4U);
  for (const Ridge<2>& ridge : square.ridges()) {
    EXPECT_NEAR(ridge.angle, 0.5 * std::numbers::pi, 1e-12);
    EXPECT_EQ(ridge.radius, 0.0);
    EXPECT_EQ(ridge.sagitta(0.1), 0.0);
  }
  EXPECT_EQ(CurveShape(rounded_box({0, 0}, {1, 1}, 0.1)).ridges().size(), 4U); // smooth joints are none
  EXPECT_EQ(CurveShape(disc()).ridges().size(), 1U);
  // corners: two of the box, two beside the notch, one at its shoulder, two of the oblique side; one arc
  EXPECT_EQ(CurveShape(odd_tool()).ridges().size(), 8U);
}

TEST(CurveShape, SagittaOfAChordVanishesWithTheRadius) {
  const Ridge<2> ridge{{0, 0}, 0.5, {0, -1}, 0.5 * std::numbers::pi};
  EXPECT_NEAR(ridge.sagitta(0.2), 0.5 - std::sqrt(0.25 - 0.01), 1e-15);
  EXPECT_NEAR(ridge.sagitta(0.02), 0.02 * 0.02 / (8.0 * 0.5), 2e-8);
  const Ridge<2> small{{0, 0}, 1e-3, {0, -1}, 0.5 * std::numbers::pi};
  EXPECT_LT(small.sagitta(0.2), 0.3e-3);
}

TEST(CurveShape, WrongCurvesAreRejected) {
  EXPECT_THROW(CurveShape(Curve{}), InputError);
  EXPECT_THROW(CurveShape(box({0, 0}, {1, 1}).reversed()), InputError);
  Curve open = box({0, 0}, {1, 1});
  open.pieces.back().to = {0.1, 0.1};
  EXPECT_THROW(CurveShape{open}, InputError);
  Curve off = rounded_box({0, 0}, {1, 1}, 0.2);
  off.pieces[1].radius = 0.25;
  EXPECT_THROW(CurveShape{off}, InputError);
  EXPECT_THROW(CurveShape(polygon({{0, 0}, {1, 0}, {1, 0}, {0, 1}})), InputError);
}
