// Contact of nodes that are tied to each other, as of a period or an interface: an impulse on one moves all.
#include "contact/impulse_solver.hpp"
#include "contact/sweeper.hpp"
#include "masses.hpp"

#include <gtest/gtest.h>
#include <limits>
#include <random>
#include <utility>

using namespace cnem;
using namespace cnem::contact;
using namespace cnem::contact::testing;

namespace {

constexpr double tied_step = 1e-3; ///< s

/// Two squares, the second of nodes of this mass, a distance apart, that have a side in common: nodes 1 and
/// 4, 2 and 7.
Masses two_squares(double apart, double mass, const Vec2& velocity) {
  Masses scene;
  scene.square({-1, 0}, 1.0);
  scene.square({apart, 0}, 1.0);
  for (std::size_t i = 0; i < 8; ++i) {
    if (i >= 4) scene.mass[i] = mass;
    for (std::size_t k = 0; k < 2; ++k) scene.v[k][i] = velocity[int(k)];
  }
  return scene;
}

void start_tied(Masses& scene, std::vector<Tool<2>> tools, bool tied) {
  scene.start(std::move(tools));
  const IndexedVector<NodeIndex, std::int32_t> group{-1, 0, 1, -1, 0, -1, -1, 1};
  if (tied) scene.contact->set_boundary(scene.facets, scene.mass.size(), {}, group);
  scene.dt_before = tied_step;
  scene.flow_stress.assign(8, 1e3);
}

} // namespace

// What pushes all of them as they would go alone changes nothing, and each keeps its share of force and heat.
TEST(TiedNodes, bear_by_their_masses_where_all_touch) {
  const Friction shear = TrescaLimited{5.0, 0.5};
  for (const Response& response : {Response(), Response(Penalty{1.0}), Response(Kinematic{})})
    for (const Friction& friction : {Friction(Coulomb{0.3}), shear}) {
      if (response.is<Kinematic>() && friction.needs_flow_stress()) continue;
      // sides of one area bear one shear force: what slips goes alike where masses are alike
      Masses tied = two_squares(0.0, friction.needs_flow_stress() ? 1.0 : 3.0, {0.5, -1.0}), apart = tied;
      for (Masses* scene : {&tied, &apart}) {
        Tool<2> floor = tool(box({-5, -2}, {5, 5e-4}), {0.0, 0.2});
        floor.friction = friction;
        floor.response = response;
        start_tied(*scene, {floor}, scene == &tied);
        scene->step(tied_step);
      }
      EXPECT_GT(apart.contact->results()[0].force.y(), 0.0);
      EXPECT_LT((tied.contact->results()[0].force - apart.contact->results()[0].force).norm(),
                1e-12 * apart.contact->results()[0].force.norm());
      for (int i = 0; i < 8; ++i) {
        const auto b = as<BoundaryNodeIndex>(i);
        EXPECT_LT((tied.velocity(i) - apart.velocity(i)).norm(), 1e-12) << i;
        EXPECT_LT((tied.contact->nodal_impulse()[b] - apart.contact->nodal_impulse()[b]).norm(), 1e-12) << i;
        EXPECT_NEAR(tied.contact->friction_heat()[b], apart.contact->friction_heat()[b], 1e-12) << i;
      }
      EXPECT_EQ(tied.contact->points().size(), apart.contact->points().size());
    }
}

// A tool under one side alone stops the other side too, with the mass of both.
TEST(TiedNodes, go_with_the_one_that_is_pushed) {
  for (const Response& response : {Response(), Response(Penalty{1.0}), Response(Kinematic{})}) {
    Masses scene = two_squares(4.0, 3.0, {0.0, -1.0});
    Tool<2> floor = tool(box({-5, -2}, {2, 5e-4}), {0.0, 0.2});
    floor.response = response;
    floor.friction = Coulomb{0.0};
    start_tied(scene, {floor}, true);
    const double mass = scene.mass[1] + scene.mass[4];
    const Vec2 before = scene.momentum();
    scene.step(tied_step);
    EXPECT_GT(scene.velocity(1).y(), -0.9);
    EXPECT_EQ(scene.velocity(4), scene.velocity(1));
    EXPECT_EQ(scene.velocity(7), Vec2(0.0, -1.0));
    const Vec2 gained = scene.momentum() - before;
    EXPECT_LT((scene.contact->results()[0].impulse - gained).norm(), 1e-12 * gained.norm());
    EXPECT_NEAR(scene.contact->nodal_impulse()[1_boundary].y(), mass * (scene.velocity(1).y() + 1.0), 1e-12);
    if (response.exact()) { EXPECT_NEAR(scene.position(1).y(), 5e-4 + 0.2 * tied_step, 1e-15); }
  }
}

// Of two materials each presses by its mass, and friction bears what both bear.
TEST(TiedNodes, of_two_materials_rub_by_the_laws_of_both) {
  for (const Response& response : {Response(), Response(Penalty{1.0})}) {
    const auto slide = [&](const Friction& light, const Friction& heavy, bool tied) {
      Masses scene = two_squares(0.0, 3.0, {0.5, -1.0});
      Tool<2> floor = tool(box({-5, -2}, {5, 5e-4}), {0.0, 0.2});
      floor.response = response;
      floor.friction_by_material = {light, heavy};
      for (int i = 0; i < 8; ++i) scene.material.push_back(i < 4 ? 0 : 1);
      start_tied(scene, {floor}, tied);
      scene.step(tied_step);
      return scene;
    };
    for (const auto& [light, heavy] : {std::pair(0.1, 0.3), std::pair(0.3, 0.1)}) {
      const Masses scene = slide(Coulomb{light}, Coulomb{heavy}, true);
      const Vec2 gained = scene.velocity(1) - Vec2(0.5, -1.0);
      EXPECT_GT(gained.y(), 0.4);
      EXPECT_GT(scene.velocity(1).x(), 0.01) << "it slips";
      EXPECT_NEAR(gained.x(), -(1.0 * light + 3.0 * heavy) / 4.0 * gained.y(), 1e-12);
    }
    // one slips freely, as where it melts: the other's bound in shear is all there is
    const auto borne = [&](const Friction& light, const Friction& heavy, bool tied) {
      const Masses scene = slide(light, heavy, tied);
      const auto& impulse = scene.contact->nodal_impulse();
      return impulse[1_boundary].x() + impulse[4_boundary].x();
    };
    const Friction none = Frictionless{}, shear = TrescaLimited{5.0, 0.5};
    EXPECT_LT(borne(none, shear, false), -0.05);
    EXPECT_NEAR(borne(none, shear, true), borne(none, shear, false), 1e-12);
    EXPECT_NEAR(borne(shear, none, true), borne(shear, none, false), 1e-12);
  }
}

// Whichever is looked at first, a spring answers the deeper one.
TEST(TiedNodes, go_as_far_as_the_deepest_is_pushed) {
  const auto pushed = [](double one, double other) {
    Masses scene = two_squares(0.0, 3.0, {0.0, -1.0});
    scene.x[1][1] = one, scene.x[1][4] = other;
    Tool<2> floor = tool(box({-5, -2}, {5, 5e-4}), {0.0, 0.2});
    floor.response = Penalty{1.0};
    start_tied(scene, {floor}, true);
    scene.step(tied_step);
    return scene.velocity(1).y() + 1.0;
  };
  EXPECT_NEAR(pushed(-2e-4, 0.0), pushed(0.0, -2e-4), 1e-12);
  EXPECT_NEAR(pushed(0.0, -2e-4), 7.0 / 5.0 * pushed(0.0, 0.0), 1e-12);
}

// Where both ends of an edge, or corners of a facet, move as one, an impulse moves them by both weights.
TEST(TiedNodes, that_one_contact_joins_answer_to_both_weights) {
  const double infinite = std::numeric_limits<double>::infinity();
  Reaction<3> free;
  free.inverse = Mat<3>::Identity() / 2.0;
  free.velocity = Vec3(0.3, -0.2, -1.0);
  ReactionsOfNodes<3> nodes;
  for (int i = 0; i < 4; ++i) nodes.push_back(free);
  for (const BoundaryNodeIndex b : {1_boundary, 2_boundary}) nodes[b].moves_with = 1_boundary;
  nodes[3_boundary].velocity = Vec3(0.1, 0.1, 0.5);
  Contact<3> contact;
  contact.normal = Vec3(0, 0, 1);
  contact.level = 1e-3;
  contact.node = {0_boundary, 1_boundary, 2_boundary, 3_boundary};
  contact.weight = {1.0, -0.3, -0.5, -0.2};
  contact.coulomb = contact.limit = infinite;
  Reaction<3> none;
  Sweeper<3> sweeper(contact, nodes, none, tied_step);
  EXPECT_NEAR(sweeper.node_mobility(contact.normal), (1.0 + 0.8 * 0.8 + 0.2 * 0.2) / 2.0, 1e-15);
  ASSERT_LT(sweeper.gap(), -1e-4);
  ASSERT_GT(sweeper.slip().norm(), 1e-2);
  sweeper.press();
  sweeper.rub();
  EXPECT_NEAR(sweeper.gap(), 0.0, 1e-18);
  EXPECT_LT(sweeper.slip().norm(), 1e-15);
  // what is tied to itself cannot part: it is not thrown
  contact.weight = {0.0, 1.0, -0.7 - 0.3 + 1e-16, 0.0};
  EXPECT_EQ(sweeper.node_mobility(contact.normal), 0.0);
}

// A chain of contacts in which two nodes move as one is the chain with one node of both masses.
TEST(TiedNodes, are_solved_for_as_one_node) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> any(0.0, 1.0);
  for (int trial = 0; trial < 20; ++trial) {
    ReactionsOfNodes<2> nodes, merged;
    ReactionsOfTools<2> tools(1);
    std::vector<Contact<2>> contacts;
    constexpr int count = 9, first = 3, second = 7; // tied
    for (int i = 0; i < count; ++i) {
      Reaction<2> node;
      node.inverse = Mat2::Identity() / (0.5 + any(random));
      node.velocity = Vec2(any(random) - 0.3, -any(random));
      if (i == second) node = nodes[as<BoundaryNodeIndex>(first)];
      nodes.push_back(node);
    }
    merged = nodes;
    for (const int i : {first, second})
      nodes[as<BoundaryNodeIndex>(i)].moves_with = as<BoundaryNodeIndex>(first);
    for (int i = 0; i + 1 < count; ++i) {
      const double s = any(random), tilt = 0.1 * any(random);
      Contact<2> contact;
      contact.tool = 0_tool;
      contact.normal = Vec2(std::sin(tilt), std::cos(tilt));
      contact.level = 1e-3 * any(random);
      contact.node = {as<BoundaryNodeIndex>(i), as<BoundaryNodeIndex>(i + 1)};
      contact.weight = {1.0 - s, s};
      contact.coulomb = 0.3;
      contact.limit = std::numeric_limits<double>::infinity();
      contacts.push_back(contact);
    }
    contacts.front().node = {as<BoundaryNodeIndex>(first), as<BoundaryNodeIndex>(second)};
    std::vector<Contact<2>> of_merged = contacts;
    of_merged.front().weight = {1.0, 0.0};
    for (Contact<2>& contact : of_merged)
      for (BoundaryNodeIndex& b : contact.node)
        if (b == as<BoundaryNodeIndex>(second)) b = as<BoundaryNodeIndex>(first);
    ImpulseSolver<2>().solve(contacts, nodes, tools, tied_step, 1e-18, 100);
    ImpulseSolver<2>().solve(of_merged, merged, tools, tied_step, 1e-18, 100);
    double impulse = 0.0;
    for (std::size_t c = 0; c < contacts.size(); ++c) {
      EXPECT_LT((contacts[c].impulse() - of_merged[c].impulse()).norm(), 1e-7) << trial << ' ' << c;
      impulse += contacts[c].pressing;
    }
    EXPECT_GT(impulse, 0.1);
    for (const BoundaryNodeIndex b : nodes.indices())
      EXPECT_LT((nodes[mover(nodes, b)].change - merged[mover(nodes, b)].change).norm(), 1e-7);
  }
}
