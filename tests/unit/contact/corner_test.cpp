// Corners of tools, sharp and rounded, against edges between nodes.
#include "masses.hpp"

#include <gtest/gtest.h>
#include <random>

using namespace cnem;
using namespace cnem::contact;
using namespace cnem::contact::testing;

namespace {

/// A block that stands on a die, pressed by a punch whose right corner is at x = `corner`, for a stroke of a
/// third of its height.
Masses press(double corner, double radius, double friction = 0.0) {
  Masses scene = block(9, 5, 0.1, {0.0, 0.0}, 60.0, 2.0);
  const Vec2 low(-2.0, 0.4), high(corner, 2.0);
  const Curve punch = radius > 0.0 ? rounded_box(low, high, radius) : box(low, high);
  scene.start({tool(box({-1, -1}, {3, 0}), {0, 0}, friction), tool(punch, {0, -0.1}, friction)});
  return scene;
}

/// How far the punch's corner region is inside the block: the depth of the boundary's upper side below the
/// lowest point of the punch at x.
double depth_of_punch(const Masses& scene, double x, double bottom) {
  double depth = -1e300;
  for (const Facet<2>& facet : scene.facets) {
    const Vec2 a = scene.position(facet.node[0]), b = scene.position(facet.node[1]);
    if (a.x() <= b.x() || x < b.x() || x > a.x()) continue; // the upper side runs towards −x
    const double s = (x - a.x()) / (b.x() - a.x());
    depth = std::max(depth, (1.0 - s) * a.y() + s * b.y() - bottom);
  }
  return depth;
}

} // namespace

TEST(Corner, SharpDoesNotPassBetweenNodes) {
  for (const double friction : {0.0, 0.4})
    for (const double corner : {0.42, 0.45, 0.48, 0.4999}) {
      Masses scene = press(corner, 0.0, friction);
      for (int i = 0; i < 2600; ++i) {
        scene.step(5e-4);
        const double bottom = 0.4 - 0.1 * scene.time;
        ASSERT_LT(depth_of_punch(scene, corner - 1e-12, bottom), 1e-9) << corner << " at step " << i;
      }
      EXPECT_TRUE(scene.contact->overlaps(scene.x, scene.time).empty()) << corner;
      EXPECT_LT(scene.contact->results()[1].force.y(), -0.5);
    }
}

TEST(Corner, OnANodePushesItToo) {
  for (const double corner : {0.4, 0.4 + 1e-17, 0.4 - 1e-16, 0.4 + 1e-10, 0.4 - 1e-10, 0.5}) {
    Masses scene = press(corner, 0.0);
    for (int i = 0; i < 2600; ++i) {
      scene.step(5e-4);
      ASSERT_LT(depth_of_punch(scene, corner - 1e-12, 0.4 - 0.1 * scene.time), 1e-9)
          << corner << " at step " << i;
    }
    EXPECT_TRUE(scene.contact->overlaps(scene.x, scene.time).empty()) << corner;
  }
}

TEST(Corner, SmallRadiusDoesNotPassBetweenNodes) {
  for (const double radius : {0.001, 0.02, 0.08}) {
    Masses scene = press(0.45 + 0.3 * radius, radius);
    const CurveShape& shape = dynamic_cast<const CurveShape&>(*scene.contact->tools()[1].shape);
    double deepest = 0.0;
    for (int i = 0; i < 2600; ++i) {
      scene.step(5e-4);
      for (const Overlap<2>& overlap : scene.contact->overlaps(scene.x, scene.time))
        deepest = std::max(deepest, overlap.depth);
      // the arc may cut a chord by no more than its own height over its chord
      const double bottom = 0.4 - 0.1 * scene.time;
      for (double angle = 0.0; angle <= 1.57; angle += 0.1) {
        const Vec2 p(0.45 - 0.7 * radius + radius * std::sin(angle),
                     bottom + radius * (1.0 - std::cos(angle)));
        ASSERT_LT(depth_of_punch(scene, p.x(), p.y()), 0.5 * radius + 1e-9) << radius << " at step " << i;
      }
    }
    EXPECT_LT(deepest, 1e-9) << radius;
    EXPECT_LT(shape.ridges().front().radius, 0.1);
  }
}

TEST(Corner, LargeRadiusLeavesTheSagittaOfAChord) {
  // all upper nodes on a disc: the chords between them cut into it, and must not be pushed off
  const double r = 0.5, h = 0.1;
  // all travel together, so that nothing acts, not even the slow push that frees penetrating nodes
  const Vec2 velocity(0.3, -1.0);
  Masses scene;
  scene.under_disc(r, h, velocity);
  Curve disc;
  disc.pieces = {arc({r, 0}, {r, 0}, {0, 0})};
  scene.start({tool(disc, velocity)});
  EXPECT_TRUE(scene.contact->overlaps(scene.x, 0.0).empty());
  for (int i = 0; i < 20; ++i) scene.step(1e-3);
  EXPECT_LT(scene.contact->results()[0].impulse.norm(), 1e-9);
  for (int i = 0; i <= 8; ++i) EXPECT_LT((scene.velocity(i) - velocity).norm(), 1e-9);
}

TEST(Corner, ImpulseIsSpreadByTheShapeFunctionsOfTheEdge) {
  // one free edge of unequal masses, struck at a quarter of its length
  Masses scene;
  scene.add({0.0, -1.0}, 1.0);
  scene.add({1.0, -1.0}, 1.0);
  scene.add({1.0, 0.0}, 2.0);
  scene.add({0.0, 0.0}, 3.0);
  scene.loop({0, 1, 2, 3});
  scene.start({tool(polygon({{0.25, 0.0}, {0.5, 1.0}, {0.0, 1.0}}), {0, -1})});
  const double dt = 1e-3;
  scene.step(dt);
  const double mobility = 0.75 * 0.75 / 3.0 + 0.25 * 0.25 / 2.0, impulse = 1.0 / mobility;
  EXPECT_NEAR(scene.contact->results()[0].impulse.y(), -impulse, 1e-9);
  EXPECT_NEAR(scene.contact->results()[0].force.y(), -impulse / (0.5 * dt), 1e-6);
  EXPECT_NEAR(scene.velocity(3).y(), -0.75 * impulse / 3.0, 1e-9);
  EXPECT_NEAR(scene.velocity(2).y(), -0.25 * impulse / 2.0, 1e-9);
  ASSERT_EQ(scene.contact->points().size(), 2U);
  EXPECT_EQ(scene.contact->points()[0].node, 2_node);
}

/// A punch over two nodes and half of the edge to a third; the first node may hang below its face.
Masses half_covered_edge(double hanging, bool equal_areas) {
  Masses scene;
  scene.add({-1.0, -1.0}, 1.0);
  scene.add({1.0, -1.0}, 1.0);
  scene.add({1.0, 0.0}, 2.0);
  scene.add({0.0, 0.0}, 3.0);
  scene.add({-1.0, -hanging}, 1.0);
  scene.loop({0, 1, 2, 3, 4});
  Tool<2> punch = tool(box({-3.0, 0.0}, {0.5, 1.0}), {0, -1});
  punch.equal_areas = equal_areas;
  scene.start({punch});
  scene.step(1e-3);
  return scene;
}

TEST(Corner, OfAFacePressesOnTheMiddleOfWhatItCovers) {
  const Masses scene = half_covered_edge(0.0, true);
  const double mobility = 0.75 * 0.75 / 3.0 + 0.25 * 0.25 / 2.0, impulse = 1.0 / mobility;
  EXPECT_NEAR(scene.velocity(3).y(), -0.75 * impulse / 3.0, 1e-9);
  EXPECT_NEAR(scene.velocity(2).y(), -0.25 * impulse / 2.0, 1e-9);
  EXPECT_NEAR(scene.velocity(4).y(), -1.0, 1e-9);
  EXPECT_NEAR(scene.contact->results()[0].impulse.y(), -impulse - 1.0, 1e-9);
}

TEST(Corner, BearsAloneUnlessTheFaceLiesOnTheBlock) {
  for (const bool equal_areas : {false, true}) {
    const Masses scene = half_covered_edge(equal_areas ? 0.2 : 0.0, equal_areas);
    for (const int node : {2, 3}) EXPECT_NEAR(scene.velocity(node).y(), -1.0, 1e-9) << node;
    EXPECT_NEAR(scene.velocity(4).y(), equal_areas ? 0.0 : -1.0, 1e-9);
  }
}

TEST(Corner, OfAFaceThatLiesOnTheBlockCutsAnEdgeByLessThanAQuarterOfIt) {
  for (const double corner : {0.42, 0.45, 0.48}) {
    Masses scene = block(9, 5, 0.1, {0.0, 0.0}, 60.0, 2.0);
    Tool<2> punch = tool(box({-2.0, 0.4}, {corner, 2.0}), {0, -0.1});
    punch.equal_areas = true;
    scene.start({tool(box({-1, -1}, {3, 0})), punch});
    double deepest = 0.0;
    for (int i = 0; i < 2600; ++i) {
      scene.step(5e-4);
      deepest = std::max(deepest, depth_of_punch(scene, corner - 1e-12, 0.4 - 0.1 * scene.time));
    }
    EXPECT_LT(deepest, 0.025) << corner;
    EXPECT_GT(deepest, 1e-4) << corner << ": the node beyond stays behind";
    EXPECT_LT(scene.contact->results()[1].force.y(), -0.5);
  }
}

TEST(Corner, TwoEdgesOfANotchAreSolvedTogether) {
  // a corner at the bottom of a V pushes the node there, whichever way it moves
  for (const double direction : {-0.4, 0.0, 0.3}) {
    Masses scene;
    scene.add({-1.0, -2.0}, 1.0);
    scene.add({1.0, -2.0}, 1.0);
    scene.add({1.0, 1.0}, 2.0);
    scene.add({0.0, 0.0}, 3.0);
    scene.add({-1.0, 1.0}, 1.0);
    scene.loop({0, 1, 2, 3, 4});
    const Vec2 velocity(direction, -1.0);
    scene.start({tool(polygon({{0.0, 0.0}, {0.2, 1.0}, {-0.2, 1.0}}), velocity)});
    for (int i = 0; i < 50; ++i) scene.step(1e-3);
    EXPECT_LT((scene.position(3) - 0.05 * velocity).norm(), 1e-9) << direction;
    EXPECT_TRUE(scene.contact->overlaps(scene.x, scene.time).empty());
  }
}

TEST(Corner, OfTheWorkpieceIsPushedByTheFaceItMeets) {
  // a convex corner of the block against a face: the node alone takes it, nothing acts on the far side
  Masses scene = block(4, 4, 0.1, {0.0, 0.0}, 100.0, 0.0, 0.6);
  double lowest = 0.0;
  for (int i = 0; i < 16; ++i) lowest = std::min(lowest, scene.position(i).y());
  scene.start({tool(box({-1, -1}, {1, lowest}), {0, 0.5})});
  scene.step(1e-3);
  ASSERT_EQ(scene.contact->points().size(), 1U);
  EXPECT_EQ(scene.contact->points()[0].node, 0_node);
  EXPECT_NEAR(scene.velocity(0).y(), 0.5, 1e-12);
}

TEST(Corner, ActsOnTheSideItComesFromOnly) {
  // a thin tongue under a corner: the far edge faces away and is left alone, even by a corner that starts
  // inside
  for (const double depth : {0.0, 0.002}) {
    Masses scene;
    scene.add({0.0, -0.01}, 1.0);
    scene.add({1.0, -0.01}, 1.0);
    scene.add({1.0, 0.0}, 1.0);
    scene.add({0.0, 0.0}, 1.0);
    scene.loop({0, 1, 2, 3});
    const Curve punch = polygon({{0.5, -depth}, {1.0, 1.0}, {0.0, 1.0}});
    Masses withdrawn = scene;
    scene.start({tool(punch, {0, -1})});
    scene.step(1e-3);
    EXPECT_EQ(scene.velocity(0).norm(), 0.0);
    EXPECT_EQ(scene.velocity(1).norm(), 0.0);
    const double speed = depth > 0.0 ? -1.5 : -1.0;
    EXPECT_NEAR(scene.velocity(2).y(), speed, 1e-9);
    EXPECT_NEAR(scene.velocity(3).y(), speed, 1e-9);
    EXPECT_EQ(scene.contact->overlaps(scene.x, scene.time).size(), depth > 0.0 ? 1U : 0U);
    withdrawn.start({tool(punch, {0, 1})});
    withdrawn.step(1e-3);
    EXPECT_EQ(withdrawn.momentum().norm(), 0.0); // the far edge is not dragged along
  }
}

TEST(Corner, AtAConvexNodeOnlyTheEdgeItCameThroughIsPushed) {
  // a corner over the right end of a block, a little inside its upper side, is far behind its right side
  Masses scene;
  scene.square({0, 0}, 1.0);
  scene.start({tool(box({0.9, 1.0 - 1e-6}, {3.0, 2.0}), {0, -1})});
  for (int i = 0; i < 5; ++i) scene.step(1e-3);
  EXPECT_LT(scene.velocity(2).y(), -0.9);
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(scene.velocity(i).x(), 0.0, 0.01) << i; // the edge turns a little
}

TEST(Corner, InASlotDoesNotFeelTheOuterSide) {
  // a tool moves left in a wide slot; the far wall's outer side faces its corner, but through material
  Masses scene;
  for (const Vec2& at : {Vec2(0, 0), Vec2(2, 0), Vec2(2, 1), Vec2(1.9, 1), Vec2(1.9, 0.2), Vec2(0.5, 0.2),
                         Vec2(0.5, 1), Vec2(0, 1)})
    scene.add(at, 1.0);
  scene.loop({0, 1, 2, 3, 4, 5, 6, 7});
  scene.start({tool(box({1.7, 0.5}, {1.8, 2.0}), {-1, 0})});
  EXPECT_TRUE(scene.contact->overlaps(scene.x, 0.0).empty());
  for (int i = 0; i < 100; ++i) scene.step(1e-3);
  EXPECT_EQ(scene.momentum().norm(), 0.0);
}

TEST(Corner, ShearStrengthCountsEachAreaOnce) {
  // pure shear friction on a face over one node and on the corner in the middle of the edge beside it
  Masses scene;
  scene.square({0, 0}, 1.0);
  Tool<2> belt = tool(box({-1, 1}, {0.5, 2}), {1.0, -0.1});
  belt.friction = TrescaLimited{infinite, 0.7};
  scene.start({belt});
  scene.flow_stress.assign(4, 10.0);
  const double dt = 1e-3;
  scene.step(dt);
  const double shear = 0.7 * 10.0 / std::numbers::sqrt3;
  EXPECT_NEAR(scene.contact->results()[0].force.x(), shear * (0.5 + 0.5 * 0.5), 1e-3 * shear);
}

TEST(Corner, NodeOnTheSideWallSlidesFreely) {
  // nodes exactly on the plane of the punch's side, moving along it
  Masses scene = block(3, 3, 0.1, {0.5, 0.0}, 100.0, 0.0, 0.0, {0.0, 0.3});
  scene.start({tool(box({0.0, -1.0}, {0.5, 2.0}), {0, -1}, 0.4)});
  for (int i = 0; i < 100; ++i) scene.step(1e-3);
  EXPECT_LT(scene.contact->results()[0].impulse.norm(), 1e-12);
  EXPECT_NEAR(scene.momentum().y(), 0.3, 1e-12);
}

TEST(Corner, OfTheDieUnderANodeCarriesIt) {
  // the die begins exactly under a node; the block is pressed down beside it
  for (const double shift : {0.0, 1e-16, -1e-16}) {
    Masses scene = block(9, 5, 0.1, {0.0, 0.0}, 60.0, 2.0);
    scene.start({tool(box({0.4 + shift, -1}, {3, 0})), tool(box({-2.0, 0.4}, {0.3, 2.0}), {0, -0.1})});
    for (int i = 0; i < 1500; ++i) scene.step(5e-4);
    EXPECT_TRUE(scene.contact->overlaps(scene.x, scene.time).empty());
    EXPECT_GT(scene.contact->results()[0].force.y(), 0.3);
    EXPECT_LT(scene.position(0).y(), -0.03); // the free end bends down
  }
}

TEST(Face, ConcaveCornerOfAToolHoldsANodeOnBothFaces) {
  // a node pushed into the inner corner of an L
  Masses scene;
  scene.add({0.1, 0.1}, 1.0, {-1.0, -2.0});
  scene.add({1.0, 0.2}, 1.0, {-1.0, -2.0});
  scene.add({1.0, 1.0}, 1.0, {-1.0, -2.0});
  scene.loop({0, 1, 2});
  const Curve angle = polygon({{-1, -1}, {3, -1}, {3, 0}, {0, 0}, {0, 3}, {-1, 3}});
  scene.start({tool(angle)});
  for (int i = 0; i < 150; ++i) scene.step(1e-3);
  EXPECT_LT(scene.position(0).norm(), 1e-12);
  EXPECT_LT(scene.velocity(0).norm(), 1e-12);
}

TEST(Corner, RandomPressesLeaveNothingInside) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (int trial = 0; trial < 24; ++trial) {
    const double angle = 6.2 * uniform(random), friction = trial % 2 == 0 ? 0.0 : uniform(random);
    const double radius = trial % 3 == 0 ? 0.0 : 0.12 * uniform(random), side = 0.2 + 0.6 * uniform(random);
    const Vec2 low(-1.0, 0.4), high(side, 2.0);
    Masses scene = block(9, 5, 0.1, {0.0, 0.0}, 60.0, 2.0, angle);
    const Curve punch = radius > 0.0 ? rounded_box(low, high, radius) : box(low, high);
    const Curve die = box({side + 0.02 * uniform(random), -1.0}, {3.0, 0.0});
    const Vec2 velocity(0.02 * (uniform(random) - 0.5), -0.1);
    scene.start({tool(rotated(punch, angle), rotation(angle) * velocity, friction),
                 tool(rotated(die, angle), {0, 0}, friction)});
    for (int i = 0; i < 1600; ++i) {
      scene.step(5e-4);
      if (i % 20 == 0) {
        ASSERT_TRUE(scene.contact->overlaps(scene.x, scene.time).empty()) << trial << " at step " << i;
      }
    }
    EXPECT_GT(scene.contact->results()[0].impulse.norm(), 1e-2) << trial;
  }
}
