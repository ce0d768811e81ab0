// Newton's method for groups of contacts in space: closed forms, and what it leaves to sweeps.
#include "contact/contact_system.hpp"
#include "tests/unit/contact/impulse_scenes.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <gtest/gtest.h>
#include <numeric>
#include <random>

using namespace cnem;
using namespace cnem::contact;
using namespace cnem::contact::testing;

namespace {

constexpr double depth = 1e-3; // m
constexpr double bounce = depth / dt;

void rub(Scene<3>& scene, double coefficient) {
  for (Contact<3>& contact : scene.contacts) {
    contact.coulomb = coefficient;
    contact.limit = std::numeric_limits<double>::infinity();
  }
}

/// Nodes of 1 kg and one `velocity` (m/s), all as deep in a plane that rests, with friction. Each touches it,
/// and so do the middles between neighbours: contacts of which any may bear the load.
Scene<3> row_on_plane(int length, const Vec3& velocity, double coefficient) {
  Scene<3> scene;
  scene.tools.resize(1);
  for (int i = 0; i < length; ++i) {
    Reaction<3> node;
    node.inverse = Mat<3>::Identity();
    node.velocity = velocity;
    scene.nodes.push_back(node);
    const auto b = as<BoundaryNodeIndex>(i);
    scene.contacts.push_back(on_tool<3>(Vec3::UnitZ(), depth, {{b, 1.0}}));
    if (i > 0)
      scene.contacts.push_back(
          on_tool<3>(Vec3::UnitZ(), depth, {{as<BoundaryNodeIndex>(i - 1), 0.5}, {b, 0.5}}));
  }
  rub(scene, coefficient);
  return scene;
}

using Outcome = ContactSystem<3>::Outcome;

Outcome outcome(Scene<3>& scene) {
  std::vector<std::int32_t> group(scene.contacts.size());
  std::iota(group.begin(), group.end(), 0);
  return ContactSystem<3>().settle(scene.contacts, group, scene.nodes, scene.tools, dt, depth, depth);
}

bool settle(Scene<3>& scene) { return outcome(scene) == Outcome::settled; }

void expect_untouched(const Scene<3>& scene) {
  for (const Contact<3>& contact : scene.contacts) {
    EXPECT_EQ(contact.pressing, 0.0);
    EXPECT_EQ(contact.sliding, Vec3::Zero());
  }
  for (const Reaction<3>& node : scene.nodes) EXPECT_EQ(node.change, Vec3::Zero());
}

} // namespace

TEST(ContactSystemInSpace, slides_as_coulomb_says) {
  const Vec3 slip(0.6, -0.8, 0.0);
  Scene<3> scene = row_on_plane(5, slip, 0.3);
  ASSERT_TRUE(settle(scene));
  for (const Reaction<3>& node : scene.nodes)
    EXPECT_LT((node.change - bounce * (Vec3::UnitZ() - 0.3 * slip)).norm(), 1e-8 * bounce);
}

TEST(ContactSystemInSpace, sticks_where_friction_can_stop_it) {
  const Vec3 slip = 0.29 * bounce * Vec3(0.6, -0.8, 0.0);
  Scene<3> scene = row_on_plane(5, slip, 0.3);
  ASSERT_TRUE(settle(scene));
  for (const Reaction<3>& node : scene.nodes)
    EXPECT_LT((node.change - (bounce * Vec3::UnitZ() - slip)).norm(), 1e-8 * bounce);
}

// The direction of slip is not known where it all but stops.
TEST(ContactSystemInSpace, settles_where_friction_just_stops_it_or_not) {
  for (const double beyond : {-1e-6, -1e-10, 0.0, 1e-10, 1e-6}) {
    const Vec3 slip = 0.3 * (1.0 + beyond) * bounce * Vec3(0.6, -0.8, 0.0);
    Scene<3> scene = row_on_plane(2, slip, 0.3);
    scene.contacts = {on_tool<3>(Vec3::UnitZ(), depth, {{0_boundary, 0.8}, {1_boundary, 0.2}}),
                      on_tool<3>(Vec3::UnitZ(), depth, {{0_boundary, 0.2}, {1_boundary, 0.8}})};
    rub(scene, 0.3);
    ASSERT_TRUE(settle(scene)) << beyond;
    const Vec3 left = std::max(0.0, beyond) / (1.0 + beyond) * slip;
    for (const Reaction<3>& node : scene.nodes)
      EXPECT_LT((node.change - (bounce * Vec3::UnitZ() - slip + left)).norm(), 1e-8 * bounce) << beyond;
  }
}

// What moves more easily one way than the other turns as it slows down: vₖ = v⁰ₖ/(1 + aₖ S/|v|).
TEST(ContactSystemInSpace, slip_turns_where_mobility_is_not_one) {
  const Vec3 slip(1.0, 1.0, 0.0), mobility(1.0, 8.0, 1.0);
  const double strength = 0.15 * bounce;
  const auto end = [&](double speed) {
    return Vec3(slip.x() / (1.0 + mobility.x() * strength / speed),
                slip.y() / (1.0 + mobility.y() * strength / speed), 0.0);
  };
  double low = 1e-6, high = slip.norm();
  for (int n = 0; n < 200; ++n) {
    const double middle = 0.5 * (low + high);
    (end(middle).norm() > middle ? low : high) = middle;
  }
  const Vec3 expected = end(low);
  ASSERT_GT(expected.x(), 1.5 * expected.y()) << "turned by more than ten degrees";
  for (const double turn : {0.0, 0.7}) { // of all about the normal
    const Mat<3> turned = Eigen::AngleAxisd(turn, Vec3::UnitZ()).toRotationMatrix();
    Scene<3> scene = row_on_plane(1, turned * slip, 0.15);
    scene.nodes[0_boundary].inverse = turned * mobility.asDiagonal() * turned.transpose();
    ASSERT_TRUE(settle(scene));
    const Vec3 left = turned * slip + scene.nodes[0_boundary].change - bounce * Vec3::UnitZ();
    EXPECT_LT((left - turned * expected).norm(), 1e-8 * slip.norm());
  }
}

TEST(ContactSystemInSpace, contacts_that_contradict_each_other_are_left_to_sweeps) {
  for (const double coefficient : {0.0, 0.3})
    for (const double wedge : {0.0, 1e-9, 1e-3, 0.02}) { // the tools' faces, all but parallel
      Scene<3> scene = resting_node<3>();
      scene.contacts = {on_tool<3>({0, 0, 1}, depth, {{0_boundary, 1.0}}),
                        on_tool<3>({0, std::sin(wedge), -std::cos(wedge)}, depth, {{0_boundary, 1.0}})};
      for (Contact<3>& contact : scene.contacts) {
        contact.coulomb = coefficient;
        contact.limit = 1.0;
      }
      EXPECT_EQ(outcome(scene), Outcome::unsettled) << coefficient << ", " << wedge;
      expect_untouched(scene);
      ImpulseSolver<3>().solve(scene.contacts, scene.nodes, scene.tools, dt, 1e-18, 100);
      EXPECT_LT(scene.nodes[0_boundary].change.norm() * dt, 5.0 * depth) << coefficient << ", " << wedge;
    }
}

// Friction that lifts a node by as much as the contact presses it down never lets it close while it slips: it
// jams (Painlevé). The rows of slip are singular then.
TEST(ContactSystemInSpace, jams_where_slip_would_never_close) {
  for (const double speed : {1.0, 10.0}) {
    Scene<3> scene = row_on_plane(1, {speed * bounce, 0.0, 0.0}, 0.5);
    scene.nodes[0_boundary].inverse << 5, 0, 2, 0, 5, 0, 2, 0, 1;
    ASSERT_TRUE(settle(scene)) << speed;
    const Vec3 left = scene.nodes[0_boundary].velocity + scene.nodes[0_boundary].change;
    EXPECT_LT((left - bounce * Vec3::UnitZ()).norm(), 1e-8 * bounce) << speed;
  }
}

// No impulse stops slip along what is held.
TEST(ContactSystemInSpace, what_slips_along_its_hold_is_left_to_sweeps) {
  for (const bool along : {false, true}) {
    Scene<3> scene = row_on_plane(3, {0.6, 0.0, 0.0}, 0.3);
    for (Reaction<3>& node : scene.nodes) node.inverse(1, 1) = 0.0;
    for (Contact<3>& contact : scene.contacts) contact.surface = {0.0, along ? 0.8 : 0.0, 0.0};
    EXPECT_NE(settle(scene), along);
    if (along) expect_untouched(scene);
  }
}

// A long row has a narrow band; a node that all contacts share makes it as wide as the group.
TEST(ContactSystemInSpace, what_costs_more_than_sweeps_is_left_to_them) {
  Scene<3> row = row_on_plane(200, {0.6, -0.8, 0.0}, 0.3);
  EXPECT_TRUE(settle(row));
  // n contacts that share a node are n − 1 places apart at least: 3 (3 n − 1)² ≤ 3000 up to 10
  for (const auto& [length, settles] : {std::pair(11, true), std::pair(12, false), std::pair(30, false)}) {
    Scene<3> star = row_on_plane(length, {0.6, -0.8, 0.0}, 0.3);
    star.contacts.clear();
    for (int i = 1; i < length; ++i)
      star.contacts.push_back(
          on_tool<3>(Vec3::UnitZ(), depth, {{0_boundary, 0.1}, {as<BoundaryNodeIndex>(i), 0.9}}));
    rub(star, 0.3);
    EXPECT_EQ(outcome(star), settles ? Outcome::settled : Outcome::costly) << length;
    if (!settles) expect_untouched(star);
  }
}

// Here each feels few others, and the band is as wide as the sheet.
TEST(ContactSystemInSpace, wide_sheets_are_left_to_sweeps) {
  for (const auto& [side, settles] : {std::pair(3, true), std::pair(12, false)}) {
    Scene<3> scene = row_on_plane(side * side, {0.6, -0.8, 0.0}, 0.0);
    scene.contacts.clear();
    for (int i = 0; i < side * side; ++i)
      for (const int beside : {(i + 1) % side != 0 ? i + 1 : -1, i + side < side * side ? i + side : -1})
        if (beside >= 0)
          scene.contacts.push_back(on_tool<3>(
              Vec3::UnitZ(), depth, {{as<BoundaryNodeIndex>(i), 0.5}, {as<BoundaryNodeIndex>(beside), 0.5}}));
    rub(scene, 0.3);
    EXPECT_EQ(outcome(scene), settles ? Outcome::settled : Outcome::costly) << side;
    if (!settles) expect_untouched(scene);
  }
}

TEST(ContactSystemInSpace, free_tools_with_many_contacts_are_left_to_sweeps) {
  for (const auto& [length, settles] : {std::pair(16, true), std::pair(17, false)}) {
    Scene<3> scene = row_on_plane(2, {0.6, -0.8, 0.0}, 0.0);
    scene.contacts.clear();
    for (int i = 0; i < 2 * length; ++i)
      scene.contacts.push_back(on_tool<3>(Vec3::UnitZ(), depth, {{as<BoundaryNodeIndex>(i % 2), 1.0}}));
    scene.tools[0_tool].inverse = Mat<3>::Identity();
    EXPECT_EQ(outcome(scene), settles ? Outcome::settled : Outcome::costly) << length;
    if (!settles) expect_untouched(scene);
  }
}
