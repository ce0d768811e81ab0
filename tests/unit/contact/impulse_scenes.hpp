#pragma once
// Contacts that feel each other, without a boundary around them.
#include "contact/impulse_solver.hpp"
#include "contact/sweeper.hpp"
#include "tests/index_literals.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <limits>
#include <random>
#include <utility>
#include <vector>

namespace cnem::contact::testing {

using namespace cnem::testing::literals;

inline constexpr double dt = 1e-3;

/// Contacts with what they press on.
template<int dim> struct Scene {
  std::vector<Contact<dim>> contacts;
  ReactionsOfNodes<dim> nodes;
  ReactionsOfTools<dim> tools;

  double deepest() {
    double depth = 0.0;
    for (Contact<dim>& contact : contacts)
      depth = std::max(depth, -Sweeper<dim>(contact, nodes, tools[0_tool], dt).gap());
    return depth;
  }
};

template<int dim>
Contact<dim> on_tool(const Vec<dim>& normal, double depth,
                     std::vector<std::pair<BoundaryNodeIndex, double>> ends) {
  Contact<dim> contact;
  contact.tool = 0_tool;
  contact.normal = normal;
  contact.level = depth; // nodes are predicted at 0
  for (std::size_t a = 0; a < ends.size(); ++a) {
    contact.node[a] = ends[a].first;
    contact.weight[a] = ends[a].second;
  }
  return contact;
}

/// A node of 1 kg at rest, no contacts.
template<int dim> Scene<dim> resting_node() {
  Scene<dim> scene;
  scene.tools.resize(1);
  scene.nodes.resize(1);
  scene.nodes[0_boundary].inverse = Mat<dim>::Identity();
  return scene;
}

enum class Law { none, coulomb, tresca, smooth };

/// Of all contacts, on tools that move along x.
template<int dim> void set_law(Scene<dim>& scene, Law law, double coefficient, std::mt19937& random) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  std::uniform_real_distribution<double> any(0.0, 1.0);
  for (Contact<dim>& contact : scene.contacts) {
    contact.surface = 0.2 * Vec<dim>::UnitX();
    contact.coulomb = law == Law::tresca ? infinite : law == Law::none ? 0.0 : coefficient;
    contact.limit = law == Law::tresca || law == Law::smooth ? 0.05 * any(random) : infinite;
    contact.smooth = law == Law::smooth;
  }
}

/// One sweep of projected Gauss-Seidel; m, how far it moved anything.
template<int dim> double sweep(Scene<dim>& scene) {
  double moved = 0.0;
  for (Contact<dim>& contact : scene.contacts) {
    Sweeper<dim> sweeper(contact, scene.nodes, scene.tools[0_tool], dt);
    moved = std::max({moved, sweeper.press(), sweeper.rub()});
  }
  return moved;
}

/// Until nothing moves by more than rounding (m); false where sweeps do not come to rest.
template<int dim> bool sweep_until_rest(Scene<dim>& scene, double rounding = 1e-18) {
  for (int n = 0; n < 200000; ++n)
    if (sweep(scene) < rounding) return true;
  return false;
}

template<int dim> void expect_solved(Scene<dim>& scene, double depth) {
  for (Contact<dim>& contact : scene.contacts) {
    const Sweeper<dim> sweeper(contact, scene.nodes, scene.tools[0_tool], dt);
    EXPECT_GE(sweeper.gap(), -1e-8 * depth);
    EXPECT_GE(contact.pressing, 0.0);
    if (contact.pressing > 0.0) { EXPECT_LE(sweeper.gap(), 1e-8 * depth) << "nothing presses at a distance"; }
    EXPECT_LE(contact.sliding.norm(), contact.strength() * (1.0 + 1e-9)) << "within the cone";
    if (contact.sliding.norm() < contact.strength() * (1.0 - 1e-6)) {
      EXPECT_LE(sweeper.slip().norm() * dt, 1e-7 * depth) << "what does not slip sticks";
    } else {
      EXPECT_LE(contact.sliding.dot(sweeper.slip()), 1e-9 * contact.strength()) << "against the slip";
      if (sweeper.slip().norm() * dt > 1e-6 * depth && contact.strength() > 0.0) {
        EXPECT_LE((contact.sliding.normalized() + sweeper.slip().normalized()).norm(), 1e-4);
      }
    }
  }
}

/// Momentum of nodes and tools that impulses have given, less the impulses.
template<int dim> Vec<dim> lost_momentum(const Scene<dim>& scene) {
  Vec<dim> lost = Vec<dim>::Zero();
  for (const Reaction<dim>& node : scene.nodes) lost += node.change / node.inverse(0, 0);
  for (const Contact<dim>& contact : scene.contacts) lost -= contact.impulse();
  return lost;
}

/// Largest difference of velocities, over the largest change of one.
template<int dim> double difference(const Scene<dim>& scene, const Scene<dim>& other) {
  double largest = 0.0, apart = 0.0;
  for (const BoundaryNodeIndex b : scene.nodes.indices()) {
    largest = std::max(largest, other.nodes[b].change.norm());
    apart = std::max(apart, (scene.nodes[b].change - other.nodes[b].change).norm());
  }
  return largest > 0.0 ? apart / largest : apart;
}

} // namespace cnem::contact::testing
