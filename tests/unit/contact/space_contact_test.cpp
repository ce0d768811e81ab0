// Contact in space: edges and corners of tools between nodes, momentum, friction in the tangent plane, and
// nodes held on planes.
#include "space_masses.hpp"

#include <gtest/gtest.h>
#include <limits>
#include <numbers>
#include <random>

using namespace cnem;
using namespace cnem::contact;
using namespace cnem::contact::testing;

namespace {

std::shared_ptr<SweptShape> space_box(const Vec3& low, const Vec3& high) {
  return std::make_shared<SweptShape>(
      SweptShape::extruded(cnem::testing::box(low.head<2>(), high.head<2>()), low.z(), high.z()));
}

/// A tool whose edges pass between nodes.
struct WithoutRidges : ToolShape<3> {
  std::shared_ptr<const ToolShape<3>> shape;
  std::vector<Ridge<3>> none;
  explicit WithoutRidges(std::shared_ptr<const ToolShape<3>> of) : shape(std::move(of)) {}
  SurfacePoint<3> closest(const Vec3& x) const override { return shape->closest(x); }
  void entries(std::span<const Vec3> from, std::span<const Vec3> to,
               std::vector<Entry<3>>& found) const override {
    shape->entries(from, to, found);
  }
  const std::vector<Ridge<3>>& ridges() const override { return none; }
  Box<3> bounds() const override { return shape->bounds(); }
  double least_thickness() const override { return shape->least_thickness(); }
  double thickness_along(const Vec3& direction) const override { return shape->thickness_along(direction); }
  double passed(const Vec3& from, const Vec3& to) const override { return shape->passed(from, to); }
};

/// How deep the surface of a body reaches into a tool, from samples of all facets, m.
double deepest(const SpaceMasses& scene, const ToolShape<3>& shape, const Vec3& shift, int parts = 12) {
  double depth = 0.0;
  for (const Facet<3>& facet : scene.facets) {
    const Vec3 a = scene.position(as<int>(facet.node[0])), b = scene.position(as<int>(facet.node[1])),
               c = scene.position(as<int>(facet.node[2]));
    for (int i = 0; i <= parts; ++i)
      for (int j = 0; i + j <= parts; ++j) {
        const Vec3 x = a + double(i) / parts * (b - a) + double(j) / parts * (c - a);
        depth = std::max(depth, -shape.closest(x - shift).distance);
      }
  }
  return depth;
}

/// One facet in the plane z = 0, its outside up, closed by a fourth node below.
SpaceMasses one_facet() {
  SpaceMasses scene;
  scene.add({0, 0, 0}, 1.0), scene.add({1, 0, 0}, 2.0), scene.add({0, 1, 0}, 3.0),
      scene.add({0.2, 0.2, -1}, 5.0);
  scene.facet(0, 1, 2), scene.facet(0, 3, 1), scene.facet(1, 3, 2), scene.facet(2, 3, 0);
  return scene;
}

} // namespace

TEST(SpaceContact, turning_z_to_any_direction_changes_no_length) {
  for (const double angle : {0.0, 1.0, 3.0, 1e-3, 1e-5, 1e-6, 1e-7, 1e-9})
    for (const bool nearly_opposite : {false, true}) {
      const double to = nearly_opposite ? std::numbers::pi - angle : angle;
      const Vec3 end(std::sin(to) * 0.6, std::sin(to) * 0.8, std::cos(to));
      const Mat<3> turn = rotation_of_z(end);
      EXPECT_LT((turn.transpose() * turn - Mat<3>::Identity()).norm(), 1e-14) << to;
      EXPECT_LT((turn * Vec3::UnitZ() - end.normalized()).norm(), 1e-9) << to;
    }
}

TEST(SpaceContact, a_corner_presses_on_a_facet_by_its_weights) {
  SpaceMasses scene = one_facet();
  // a box on its corner
  const Mat<3> turn = rotation_of_z(Vec3(1, 1, 1).normalized()).transpose();
  const auto shape =
      std::make_shared<PlacedShape>(space_box({0, 0, 0}, {2, 2, 2}), turn, Vec3(0.3, 0.2, 0.0));
  scene.start({tool(shape, {0, 0, -1})});
  scene.step(1e-3);
  const std::array<double, 3> weight{0.5, 0.3, 0.2};
  double mobility = 0.0;
  for (int a = 0; a < 3; ++a)
    mobility += weight[std::size_t(a)] * weight[std::size_t(a)] / scene.mass[std::size_t(a)];
  EXPECT_NEAR(scene.contact->results()[0].impulse.z(), -1.0 / mobility, 1e-9);
  EXPECT_LT(scene.contact->results()[0].impulse.head<2>().norm(), 1e-12);
  for (int a = 0; a < 3; ++a)
    EXPECT_NEAR(scene.velocity(a).z(), -weight[std::size_t(a)] / mobility / scene.mass[std::size_t(a)], 1e-9);
  EXPECT_LT((scene.momentum() - scene.contact->results()[0].impulse).norm(), 1e-14);
}

TEST(SpaceContact, an_edge_presses_on_an_edge_between_nodes) {
  SpaceMasses scene = one_facet();
  // a roof along y over the edge from node 0 to 1, at a quarter
  const auto roof = std::make_shared<PlacedShape>(
      std::make_shared<SweptShape>(SweptShape::extruded(polygon({{0, 0}, {1, 1}, {-1, 1}}), -0.1, 0.1)),
      (Mat<3>() << 1, 0, 0, 0, 0, -1, 0, 1, 0).finished(), Vec3(0.25, 0, 0));
  scene.start({tool(roof, {0, 0, -1})});
  scene.step(1e-3);
  // it meets the edge at (0.25, 0), and with its end at y = 0.1 the facet
  EXPECT_LT(deepest(scene, *roof, {0, 0, -1e-3}), 1e-12);
  EXPECT_LT((scene.momentum() - scene.contact->results()[0].impulse).norm(), 1e-14);
  EXPECT_LT(scene.contact->results()[0].impulse.z(), -1.0);
}

TEST(SpaceContact, a_sharp_box_does_not_sink_between_the_nodes_of_a_coarse_surface) {
  for (const auto& [friction, turn] : {std::pair{0.0, 0.0}, std::pair{0.3, 0.4}}) {
    SpaceMasses scene = space_block({7, 7, 4}, 0.1, {0, 0, 0}, 12.0, 0.4);
    const Mat<3> rotation = rotation_about({0, 0, 1}, turn);
    const auto punch = std::make_shared<PlacedShape>(space_box({-0.13, -0.11, 0.0}, {0.12, 0.14, 1.0}),
                                                     rotation, Vec3(0.3, 0.3, 0.3));
    const auto die = space_box({-1, -1, -1}, {2, 2, 0});
    scene.start({tool(die, {0, 0, 0}, friction), tool(punch, {0, 0, -0.1}, friction)});
    double worst = 0.0;
    for (int i = 0; i < 600; ++i) {
      scene.step(1e-3);
      if (i % 20 == 0) worst = std::max(worst, deepest(scene, *punch, {0, 0, -0.1 * scene.time}));
      const Vec3 balance =
          scene.momentum() - scene.contact->results()[0].impulse - scene.contact->results()[1].impulse;
      ASSERT_LT(balance.norm(), 1e-12) << i;
    }
    EXPECT_LT(worst, 1e-6) << friction << ' ' << turn;
    EXPECT_LT(scene.contact->results()[1].force.z(), -0.1);
  }
}

TEST(SpaceContact, a_tilted_prism_goes_in_corner_first) {
  SpaceMasses scene = space_block({7, 7, 4}, 0.1, {0, 0, 0}, 12.0, 0.4);
  const auto prism = std::make_shared<PlacedShape>(
      std::make_shared<SweptShape>(SweptShape::extruded(
          polygon({{-0.13, -0.12}, {0.14, -0.13}, {0.13, 0.14}, {-0.12, 0.11}}), 0.0, 1.0)),
      rotation_about({1, 0.5, 0}, 0.3) * rotation_about({0, 0, 1}, 0.4), Vec3(0.31, 0.29, 0.36));
  scene.start({tool(space_box({-1, -1, -1}, {2, 2, 0})), tool(prism, {0, 0, -0.2}, 0.1)});
  double worst = 0.0;
  for (int i = 0; i < 700; ++i) { // its corner reaches a side of the groove it has made
    scene.step(1e-3);
    if (i % 20 == 0) worst = std::max(worst, deepest(scene, *prism, {0, 0, -0.2 * scene.time}));
  }
  EXPECT_LT(worst, 1e-3);
}

TEST(SpaceContact, without_ridges_it_would_sink_in) {
  SpaceMasses scene = space_block({7, 7, 4}, 0.1, {0, 0, 0}, 12.0, 0.4);
  const auto punch = std::make_shared<WithoutRidges>(space_box({0.17, 0.19, 0.3}, {0.42, 0.44, 1.0}));
  scene.start({tool(space_box({-1, -1, -1}, {2, 2, 0})), tool(punch, {0, 0, -0.1})});
  for (int i = 0; i < 600; ++i) scene.step(1e-3);
  EXPECT_GT(deepest(scene, *punch, {0, 0, -0.1 * scene.time}), 0.01);
}

TEST(SpaceContact, a_small_rounded_corner_does_not_pass_through_a_facet) {
  // radii far below the facets: of the corner in plan, and of the cutting edge
  SpaceMasses scene = space_block({7, 7, 4}, 0.1, {0, 0, 0}, 12.0, 0.4);
  const double edge = 0.01;
  const auto punch =
      std::make_shared<PlacedShape>(std::make_shared<SweptShape>(SweptShape::extruded(
                                        rounded_box({-0.13, -0.11}, {0.12, 0.14}, 0.03), 0.0, 1.0, edge)),
                                    rotation_about({0, 0, 1}, 0.4), Vec3(0.31, 0.29, 0.3));
  scene.start({tool(space_box({-1, -1, -1}, {2, 2, 0})), tool(punch, {0, 0, -0.1}, 0.1)});
  double worst = 0.0;
  for (int i = 0; i < 600; ++i) {
    scene.step(1e-3);
    if (i % 20 == 0) worst = std::max(worst, deepest(scene, *punch, {0, 0, -0.1 * scene.time}));
  }
  EXPECT_LT(worst, 1.05 * edge * (1.0 - std::sqrt(0.5))) << "the height of the edge's arc over its chord";
}

TEST(SpaceContact, a_round_punch_with_a_sharp_edge_goes_down_between_nodes) {
  SpaceMasses scene = space_block({7, 7, 4}, 0.1, {0, 0, 0}, 12.0, 0.4);
  const auto punch = std::make_shared<PlacedShape>(
      std::make_shared<SweptShape>(SweptShape::revolved(cnem::testing::box({0, 0}, {0.17, 1}))),
      Mat<3>::Identity(), Vec3(0.31, 0.29, 0.3));
  scene.start({tool(space_box({-1, -1, -1}, {2, 2, 0})), tool(punch, {0, 0, -0.1})});
  double worst = 0.0;
  for (int i = 0; i < 600; ++i) {
    scene.step(1e-3);
    if (i % 20 == 0) worst = std::max(worst, deepest(scene, *punch, {0, 0, -0.1 * scene.time}));
  }
  // an edge beside the circle is cut by its sagitta at most, l²/8R
  EXPECT_LT(worst, 0.02 / (8.0 * 0.17));
  EXPECT_LT(scene.contact->results()[1].force.z(), -0.1);
}

TEST(SpaceContact, chords_on_a_ball_are_left_where_they_are) {
  const double r = 1.0;
  SpaceMasses scene;
  const TriangleSurface ball = triangle_sphere(r, 3);
  const Vec3 velocity(0.3, -1.0, 0.2);
  for (const Vec3& x : ball.points) scene.add(x, 1.0, velocity);
  for (const auto& t : ball.triangles) scene.facet(t[0], t[2], t[1]); // a cavity round it
  const auto shape = std::make_shared<SweptShape>(SweptShape::revolved(half_disc(r)));
  scene.start({tool(shape, velocity)});
  EXPECT_TRUE(scene.contact->overlaps(scene.x, 0.0).empty());
  for (int i = 0; i < 5; ++i) scene.step(1e-3);
  EXPECT_LT(scene.contact->results()[0].impulse.norm(), 1e-9);
  for (int i = 0; i < scene.nodes(); ++i) EXPECT_LT((scene.velocity(i) - velocity).norm(), 1e-9);
}

TEST(SpaceContact, friction_is_in_the_tangent_plane_and_in_its_cone) {
  const Vec3 n = Vec3(1, 2, 4).normalized();
  for (const double mu : {0.1, 0.6})
    for (const double angle : {0.2, 1.9, 4.0}) {
      // masses that fall on a turned box obliquely
      SpaceMasses scene;
      const Mat<3> turn = rotation_of_z(n);
      const Vec3 along = turn * Vec3(std::cos(angle), std::sin(angle), 0.0);
      for (const Vec3& at : {Vec3(0, 0, 0), Vec3(0.1, 0, 0), Vec3(0, 0.1, 0), Vec3(0, 0, 1)})
        scene.add(turn * at, 2.0, 0.4 * along - 1.0 * n);
      scene.facet(0, 2, 1), scene.facet(0, 1, 3), scene.facet(1, 2, 3), scene.facet(2, 0, 3);
      scene.start(
          {tool(std::make_shared<PlacedShape>(space_box({-2, -2, -1}, {2, 2, 0}), turn, Vec3(0, 0, 0)),
                {0, 0, 0}, mu)});
      scene.step(1e-3);
      for (int i = 0; i < 3; ++i) {
        const Vec3 v = scene.velocity(i);
        EXPECT_NEAR(v.dot(n), 0.0, 1e-12);
        const double left = std::max(0.0, 0.4 - mu);
        EXPECT_LT((v - left * along).norm(), 1e-12) << "it brakes against the slip, by mu at most";
      }
      EXPECT_LT((scene.velocity(3) - 0.4 * along + n).norm(), 1e-15);
      const ToolResult<3>& result = scene.contact->results()[0];
      const double normal = result.impulse.dot(n), tangential = (result.impulse - normal * n).norm();
      EXPECT_NEAR(normal, 6.0, 1e-12);
      EXPECT_NEAR(tangential, std::min(mu, 0.4) * normal, 1e-12);
      EXPECT_NEAR(result.step.workpiece,
                  result.step.tool + result.step.recovery - result.step.friction - result.step.impact, 1e-12);
    }
}

TEST(SpaceContact, a_node_on_two_planes_slides_along_their_line) {
  // x and y held: what a slanted tool pushes goes along z
  SpaceMasses scene = one_facet();
  const Mat<3> along_z = Vec3(0, 0, 1).asDiagonal();
  for (int i = 0; i < 3; ++i) scene.constraints.push_back({as<NodeIndex>(i), along_z});
  const Vec3 n = Vec3(0.3, 0.1, -1.0).normalized();
  const auto plane =
      std::make_shared<PlacedShape>(space_box({-9, -9, -9}, {9, 9, 0}), rotation_of_z(n), Vec3(0, 0, 0.1));
  scene.start({tool(plane, {0, 0, -1}, 0.2)});
  for (int i = 0; i < 300; ++i) scene.step(1e-3);
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(scene.velocity(i).head<2>().norm(), 0.0);
    EXPECT_LT(-plane->closest(scene.position(i) - Vec3(0, 0, -0.3)).distance, 1e-12);
  }
  EXPECT_LT(scene.velocity(0).z(), -0.9);
}

TEST(SpaceContact, a_free_tool_shares_momentum_with_what_it_meets) {
  SpaceMasses scene = space_block({4, 4, 3}, 0.1, {0, 0, 0}, 12.0, 0.4);
  Tool<3> hammer = tool(space_box({0.04, 0.05, 0.2}, {0.26, 0.24, 1.0}), {0, 0, 0}, 0.2);
  hammer.drive.emplace();
  hammer.drive->mass = 0.7;
  hammer.drive->initial_velocity = {0.2, 0.1, -1.0};
  scene.start({hammer});
  const Vec3 whole = 0.7 * hammer.drive->initial_velocity;
  for (int i = 0; i < 200; ++i) {
    scene.step(5e-4);
    ASSERT_LT((scene.momentum() + 0.7 * scene.contact->velocity(0, scene.time) - whole).norm(), 1e-12);
  }
  EXPECT_GT(scene.momentum().norm(), 0.1);
}

TEST(SpaceContact, results_do_not_depend_on_when_near_parts_are_listed) {
  const auto make = [] {
    SpaceMasses scene = space_block({7, 7, 3}, 0.1, {0, 0, 0}, 12.0, 0.4);
    const auto punch =
        std::make_shared<PlacedShape>(std::make_shared<SweptShape>(SweptShape::extruded(
                                          rounded_box({-0.15, -0.1}, {0.15, 0.1}, 0.04), 0.0, 1.0, 0.02)),
                                      rotation_about({0, 0, 1}, 0.3), Vec3(0.3, 0.3, 0.2));
    scene.start(
        {tool(space_box({-1, -1, -1}, {2, 2, 0}), {0, 0, 0}, 0.1), tool(punch, {0.05, 0, -0.1}, 0.2)});
    return scene;
  };
  SpaceMasses seldom = make(), always = make();
  for (int i = 0; i < 150; ++i) {
    seldom.step(1e-3);
    always.contact->set_boundary(always.facets, always.mass.size(), {});
    always.step(1e-3);
    for (std::size_t k = 0; k < 3; ++k) {
      ASSERT_EQ(seldom.x[k], always.x[k]) << i;
      ASSERT_EQ(seldom.v[k], always.v[k]) << i;
    }
  }
  EXPECT_LT(seldom.contact->near().listings(), 30);
}

TEST(SpaceContact, triangles_of_a_box_press_as_the_box_does) {
  SpaceMasses one = space_block({6, 6, 3}, 0.1, {0, 0, 0}, 12.0, 0.4), other = one;
  const Vec3 low(0.13, 0.11, 0.2), high(0.42, 0.37, 1.0);
  const auto die = space_box({-1, -1, -1}, {2, 2, 0});
  one.start({tool(die), tool(space_box(low, high), {0, 0, -0.1})});
  other.start({tool(die), tool(std::make_shared<TriangleShape>(triangle_box(low, high)), {0, 0, -0.1})});
  for (int i = 0; i < 300; ++i) one.step(1e-3), other.step(1e-3);
  const Vec3 a = one.contact->results()[1].impulse, b = other.contact->results()[1].impulse;
  EXPECT_LT((a - b).norm(), 1e-6 * a.norm());
  for (int i = 0; i < one.nodes(); ++i) EXPECT_LT((one.position(i) - other.position(i)).norm(), 1e-7);
}
