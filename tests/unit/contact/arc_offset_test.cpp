// Nodes off rounded edges of tools, so that chords and arcs enclose equal areas.
#include "contact/arc_offset.hpp"
#include "masses.hpp"

#include <gtest/gtest.h>
#include <random>

using namespace cnem;
using namespace cnem::contact;
using namespace cnem::contact::testing;

namespace {

/// The boundary of matter through these places, in their order, and back to the first.
struct Loop {
  IndexedVector<BoundaryNodeIndex, Vec2> position;
  Surface<2> surface;

  explicit Loop(const std::vector<Vec2>& places) {
    std::vector<Facet<2>> facets;
    for (std::size_t i = 0; i < places.size(); ++i) {
      position.push_back(places[i]);
      facets.push_back({{as<NodeIndex>(i), as<NodeIndex>((i + 1) % places.size())}, {}});
    }
    surface = Surface<2>(facets, places.size());
  }
  Vec2 offset(const ToolShape<2>& shape, int node) const {
    return arc_offset<2>(surface, shape, as<BoundaryNodeIndex>(node), position, Vec2(0, 0));
  }
};

CurveShape disc(double r) {
  Curve curve;
  curve.pieces = {arc({r, 0}, {r, 0}, {0, 0})};
  return CurveShape(curve);
}

/// Matter around a disc: its boundary runs clockwise.
std::vector<Vec2> around(double r, const std::vector<double>& angles) {
  std::vector<Vec2> places;
  for (const double angle : angles) places.push_back({r * std::cos(-angle), r * std::sin(-angle)});
  return places;
}

/// At s along the lower side of a box from −1 to 0 with an arc of radius r at its right end.
Vec2 on_box(double s, double r) {
  return s < 0.0 ? Vec2(s, 0.0) : Vec2(r * std::sin(s / r), r * (1.0 - std::cos(s / r)));
}

} // namespace

TEST(ArcOffset, GivesAPolygonTheAreaOfTheDisc) {
  constexpr double r = 0.3;
  for (const int n : {16, 32, 64}) {
    std::vector<double> angles;
    const double step = 2.0 * std::numbers::pi / n;
    for (int i = 0; i < n; ++i) angles.push_back(0.1 + i * step);
    const Loop loop(around(r, angles));
    const double exact = r * (std::sqrt(step / std::sin(step)) - 1.0);
    for (int i = 0; i < n; ++i) {
      const Vec2 offset = loop.offset(disc(r), i), place = loop.position[as<BoundaryNodeIndex>(i)];
      EXPECT_NEAR(offset.norm(), exact, step * step * exact) << n;
      EXPECT_NEAR(offset.normalized().dot(place / r), -1.0, 1e-12) << "towards the tool";
    }
  }
}

TEST(ArcOffset, OfUnequalChordsTakesAllThatTheyCut) {
  constexpr double r = 0.3;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(0.8, 1.2);
  std::vector<double> angles{0.0};
  while (angles.back() < 6.0) angles.push_back(angles.back() + 0.2 * uniform(random));
  const Loop loop(around(r, angles));
  double given = 0.0, cut = 0.0;
  for (const auto& facet : loop.surface.facets) {
    const double l = (loop.position[facet[1]] - loop.position[facet[0]]).norm();
    cut += l * l * l / (12.0 * r);
    for (const BoundaryNodeIndex end : facet)
      given += 0.5 * l * arc_offset<2>(loop.surface, disc(r), end, loop.position, Vec2(0, 0)).norm();
  }
  EXPECT_NEAR(given, cut, 1e-3 * cut);
}

TEST(ArcOffset, ChangesSmoothlyAsEdgesSlideOnToTheArc) {
  constexpr double r = 0.1, l = 0.02, full = l * l / (12.0 * r), step = 1e-3 * l;
  const CurveShape shape(rounded_box({-1.0 - r, 0.0}, {r, 1.0}, r));
  double before = 0.0, slope_before = 0.0;
  for (double s = -1.5 * l; s < 1.5 * l; s += step) {
    std::vector<Vec2> places;
    for (int k = 2; k >= -2; --k) places.push_back(on_box(s + k * l, r)); // matter below runs towards −x
    places.push_back({-0.5, -1.0});
    places.push_back({0.5, -1.0});
    const double offset = Loop(places).offset(shape, 2).norm(), slope = (offset - before) / step;
    if (s < -l - step) {
      EXPECT_EQ(offset, 0.0);
    } else {
      EXPECT_GE(slope, -1e-3 * full / l) << s;
      EXPECT_NEAR(slope, slope_before, 20.0 * step / l * full / l) << s;
      slope_before = slope;
    }
    before = offset;
  }
  EXPECT_NEAR(before, full, 1e-2 * full);
}

TEST(ArcOffset, IsNothingWhereAnEdgeLeavesTheToolOrIsLongerThanTheArc) {
  constexpr double r = 0.1, l = 0.02;
  const CurveShape shape(rounded_box({-1.0 - r, 0.0}, {r, 1.0}, r));
  const auto offset = [&](double length, double off) {
    const double s = 0.5 * r;
    return Loop({on_box(s + length, r) + Vec2(off, -off),
                 on_box(s, r),
                 on_box(s - length, r) - Vec2(0, off),
                 {-0.5, -1.0},
                 {0.5, -1.0}})
        .offset(shape, 1)
        .norm();
  };
  EXPECT_NEAR(offset(l, 0.0), l * l / (12.0 * r), 1e-2 * l * l / (12.0 * r));
  EXPECT_EQ(offset(l, l * l / r), 0.0);
  EXPECT_EQ(offset(4.0 * r, 0.0), 0.0);
}

TEST(ArcOffset, KeepsNodesOffATool) {
  constexpr double r = 0.5, h = 0.1;
  const Vec2 velocity(0.0, -1.0);
  Masses scene;
  scene.under_disc(r, h, velocity);
  Curve circle;
  circle.pieces = {arc({r, 0}, {r, 0}, {0, 0})};
  Tool<2> rounded = tool(circle, velocity);
  rounded.equal_areas = true;
  scene.start({rounded});
  const double pushed = h * h / (12.0 * r);
  scene.step(1e-3);
  EXPECT_NEAR(scene.position(4).norm(), r + 5e-4 + 1e-3, 1e-4) << "not at once";
  for (int i = 0; i < 20; ++i) scene.step(1e-3);
  const Vec2 centre = 21e-3 * velocity;
  EXPECT_GT((scene.position(4) - centre).norm(), r + 0.95 * pushed);
  EXPECT_GT(scene.contact->results()[0].total.recovery, 0.0);
}
