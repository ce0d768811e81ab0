// Bodies on bodies in space: nodes on facets, edges across edges, momentum, and what only looks near.
#include "contact/swept_shape.hpp"
#include "core/fields/memory_archive.hpp"
#include "space_masses.hpp"
#include "space_shapes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <numeric>
#include <random>

using namespace cnem;
using namespace cnem::contact;
using namespace cnem::contact::testing;

namespace {

/// Adds the masses of another scene, turned and shifted.
void append(SpaceMasses& scene, const SpaceMasses& other, const Mat<3>& turn, const Vec3& shift,
            const Vec3& velocity) {
  const int offset = scene.nodes();
  for (int i = 0; i < other.nodes(); ++i)
    scene.add(turn * other.position(i) + shift, other.mass[std::size_t(i)], velocity);
  for (SpaceMasses::Spring s : other.springs) {
    s.a += offset, s.b += offset;
    scene.springs.push_back(s);
  }
  for (const Facet<3>& f : other.facets)
    scene.facet(as<int>(f.node[0]) + offset, as<int>(f.node[1]) + offset, as<int>(f.node[2]) + offset);
}

Vec3 angular_momentum(const SpaceMasses& scene) {
  Vec3 sum = Vec3::Zero();
  for (int i = 0; i < scene.nodes(); ++i)
    sum += scene.mass[std::size_t(i)] * scene.position(i).cross(scene.velocity(i));
  return sum;
}

/// Whether a point is inside facets from `first` on.
bool encloses(const SpaceMasses& scene, std::size_t first, std::size_t last, const Vec3& x) {
  double angle = 0.0;
  for (std::size_t f = first; f < last; ++f) {
    const auto& n = scene.facets[f].node;
    const Vec3 a = scene.position(as<int>(n[0])) - x, b = scene.position(as<int>(n[1])) - x,
               c = scene.position(as<int>(n[2])) - x;
    angle += std::atan2(a.dot(b.cross(c)), a.norm() * b.norm() * c.norm() + a.dot(b) * c.norm() +
                                               b.dot(c) * a.norm() + c.dot(a) * b.norm());
  }
  return angle > std::numbers::pi;
}

/// The same masses in another order.
SpaceMasses renumbered(const SpaceMasses& scene, unsigned seed) {
  std::vector<int> order(std::size_t(scene.nodes())), now(order.size());
  std::iota(order.begin(), order.end(), 0);
  std::shuffle(order.begin(), order.end(), std::mt19937(seed));
  SpaceMasses made;
  for (std::size_t n = 0; n < order.size(); ++n) {
    made.add(scene.position(order[n]), scene.mass[std::size_t(order[n])], scene.velocity(order[n]));
    now[std::size_t(order[n])] = static_cast<int>(n);
  }
  const auto at = [&](NodeIndex i) { return now[index_of(i)]; };
  for (const Facet<3>& f : scene.facets) made.facet(at(f.node[0]), at(f.node[1]), at(f.node[2]));
  return made;
}

/// Two blocks, the upper one turned about the vertical, whose faces meet; the lower one has the first nodes
/// and facets.
SpaceMasses stack() {
  SpaceMasses scene = space_block({5, 5, 3}, 0.25, {-0.5, -0.5, -0.5}, 400.0, 1.0);
  append(scene, space_block({4, 4, 3}, 0.25, {-0.375, -0.375, 0.0}, 400.0, 1.0),
         rotation_about({0, 0, 1}, 0.3), {0.0, 0.0, 1e-5}, {0.05, 0.0, -0.2});
  scene.start({}, BodyContactLaw{true, Coulomb{0.2}});
  return scene;
}

/// What contact takes from one step to the next, for loading.
void take_state(SpaceMasses& scene, MemoryArchive& state) {
  state.clear();
  scene.contact->archive(state);
  state.recall();
}

/// N, of the contacts that begin with them in the next step: normal forces and frictions, four numbers each.
std::vector<double> kept_forces(SpaceMasses& scene) {
  MemoryArchive state;
  take_state(scene, state);
  std::vector<double> force;
  state.list("solver/body_contact/kept/force", "N/m", force);
  return force;
}

} // namespace

// Heat passes where faces are closed, whichever of the redundant pairs bear.
TEST(SpaceBodies, all_of_a_face_that_is_closed_touches) {
  SpaceMasses scene = space_block({5, 5, 3}, 0.25, {-0.5, -0.5, -0.5}, 400.0, 2.0);
  append(scene, space_block({4, 4, 3}, 0.25, {-0.375, -0.375, 0.0}, 400.0, 2.0),
         rotation_about({0, 0, 1}, 0.3), {0.0, 0.0, 1e-5}, {0.0, 0.0, -1e-3});
  for (int i = 0; i < scene.nodes(); ++i) // the outer faces are led
    if (const double z = scene.position(i).z(); z < -0.49 || z > 0.49)
      scene.constraints.push_back({as<NodeIndex>(i), Mat<3>::Zero()});
  BodyContactLaw law{true, Coulomb{0.2}};
  law.conductance = 1.0;
  scene.start({}, law);
  for (int i = 0; i < 400; ++i) {
    scene.step(5e-4);
    if (i < 200) continue;
    EXPECT_GT(scene.contact->body_result().pressing, 0.0);
    double area = 0.0;
    for (const auto& touch : scene.contact->touches()) area += touch.area;
    // 9 nodes of the lower face lie beneath the upper one: half of their shares and of all of that
    EXPECT_NEAR(area, 0.5 * (0.75 * 0.75 + 9 * 0.0625), 1e-3) << i;
  }
}

TEST(SpaceBodies, oblique_impact_keeps_momenta_and_balances_energy) {
  SpaceMasses scene = space_block({4, 4, 4}, 0.25, {0, 0, 0}, 100.0, 0.0);
  const std::size_t own = scene.facets.size();
  const int nodes = scene.nodes();
  append(scene, space_block({4, 4, 3}, 0.22, {0, 0, 0}, 80.0, 0.0), rotation_about({1, 2, 3}, 0.3),
         {0.1, 0.15, 0.95}, {0.3, 0.1, -1.0});
  scene.start({}, BodyContactLaw{true, Coulomb{0.2}});
  const Vec3 momentum = scene.momentum(), angular = angular_momentum(scene);
  bool touched = false;
  for (int i = 0; i < 600; ++i) {
    scene.step(5e-4);
    touched = touched || scene.contact->body_result().pressing > 0.0;
    if (i % 50 != 0) continue;
    for (int n = 0; n < nodes; ++n)
      ASSERT_FALSE(encloses(scene, own, scene.facets.size(), scene.position(n))) << n << " at step " << i;
    for (int n = nodes; n < scene.nodes(); ++n)
      ASSERT_FALSE(encloses(scene, 0, own, scene.position(n))) << n << " at step " << i;
  }
  EXPECT_TRUE(touched);
  EXPECT_LT((scene.momentum() - momentum).norm(), 1e-12);
  EXPECT_LT((angular_momentum(scene) - angular).norm(), 1e-3) << "but for slip along facets within a step";
  const ContactWork work = scene.contact->body_result().total;
  EXPECT_NEAR(work.workpiece, work.recovery - work.friction - work.impact, 1e-12);
  EXPECT_GT(work.impact, 0.0);
  EXPECT_GT(work.friction, 0.0);
}

TEST(SpaceBodies, results_do_not_depend_on_when_pairs_were_listed) {
  const auto pressed = [] { // by each other and a round punch with a rounded edge
    SpaceMasses scene = space_block({4, 4, 4}, 0.25, {0, 0, -1.8}, 100.0, 2.0);
    append(scene, space_block({4, 4, 3}, 0.22, {0, 0, 0}, 80.0, 2.0), rotation_about({1, 2, 3}, 0.3),
           {0.1, 0.15, -0.85}, {0.3, 0.1, -1.0});
    const auto punch = std::make_shared<SweptShape>(SweptShape::revolved(punch_section(0.6, 1.0, 0.1)));
    scene.start({tool(punch, {0.0, 0.1, -0.5}, 0.2)}, BodyContactLaw{true, Coulomb{0.2}});
    return scene;
  };
  SpaceMasses seldom = pressed(), always = pressed();
  for (int i = 0; i < 1500; ++i) {
    seldom.step(5e-4);
    always.contact->set_boundary(always.facets, always.mass.size(), {});
    always.step(5e-4);
    for (std::size_t k = 0; k < 3; ++k) {
      ASSERT_EQ(seldom.x[k], always.x[k]) << "step " << i;
      ASSERT_EQ(seldom.v[k], always.v[k]) << "step " << i;
    }
  }
  EXPECT_GT(seldom.contact->body_result().total.friction, 0.0);
  EXPECT_LT(seldom.contact->near().listings(), 500);
}

class Roofs : public ::testing::TestWithParam<double> {};

TEST_P(Roofs, edges_that_cross_stop_each_other) {
  // two roofs, the ridge of one across that of the other, whose nodes never meet a facet
  const auto roof = [](SpaceMasses& scene, const Mat<3>& turn, double up, double mass) {
    const int first = scene.nodes();
    for (const Vec3& x : {Vec3(-1, 0, 0), Vec3(1, 0, 0), Vec3(-1, -0.2, -1), Vec3(1, -0.2, -1),
                          Vec3(-1, 0.2, -1), Vec3(1, 0.2, -1)})
      scene.add(turn * x + Vec3(0, 0, up), mass);
    const auto facet = [&](int a, int b, int c) { scene.facet(first + a, first + b, first + c); };
    facet(0, 2, 3), facet(0, 3, 1), facet(0, 1, 5), facet(0, 5, 4);
    facet(2, 4, 5), facet(2, 5, 3), facet(0, 4, 2), facet(1, 3, 5);
  };
  SpaceMasses scene;
  roof(scene, Mat<3>::Identity(), 0.0, 1.0);
  roof(scene, rotation_about({0, 0, 1}, GetParam()) * rotation_about({1, 0, 0}, std::numbers::pi), 0.01, 2.0);
  for (int i = 6; i < 12; ++i) scene.v[2][std::size_t(i)] = -1.0;
  scene.start({}, BodyContactLaw{true, Coulomb{0.0}});
  const Vec3 momentum = scene.momentum();
  for (int i = 0; i < 12; ++i) scene.step(1e-3);
  EXPECT_GT(scene.velocity(0).z(), -1.0);
  const double low = 0.5 * (scene.position(6).z() + scene.position(7).z()),
               high = 0.5 * (scene.position(0).z() + scene.position(1).z());
  EXPECT_GT(low - high, 0.0);
  EXPECT_LT(low - high, 1e-5);
  EXPECT_LT((scene.momentum() - momentum).norm(), 1e-13);
  EXPECT_LT(scene.velocity(0).z(), -0.1) << "the ridge below has taken its share";
}

INSTANTIATE_TEST_SUITE_P(SpaceBodies, Roofs, ::testing::Values(0.5 * std::numbers::pi, 0.5, 0.02)); // rad

// Nodes of a lattice stand above each other, where a ray upwards meets nodes and edges.
TEST(SpaceBodies, sides_of_a_thin_lattice_pass_each_other_however_it_is_numbered) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    SpaceMasses sheet = space_block({6, 6, 2}, 0.1, {0, 0, 0}, 1.0, 0.0);
    for (double& z : sheet.x[2]) z *= 0.2;
    for (std::size_t i = 0; i < sheet.x[2].size(); ++i) sheet.v[2][i] = -2.0 * sheet.x[2][i]; // thinner
    SpaceMasses scene = renumbered(sheet, seed);
    scene.start({}, BodyContactLaw{true, Coulomb{0.0}});
    for (int i = 0; i < 20; ++i) scene.step(1e-2);
    EXPECT_EQ(scene.contact->body_result().total.workpiece, 0.0) << seed;
  }
}

TEST(SpaceBodies, lattices_that_overlap_come_no_nearer_however_they_are_numbered) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    SpaceMasses blocks = space_block({4, 4, 4}, 0.25, {0, 0, 0}, 1.0, 0.0);
    append(blocks, space_block({4, 4, 4}, 0.25, {0, 0, 0}, 1.0, 0.0), Mat<3>::Identity(), {0, 0, 0.72},
           {0, 0, -1.0});
    SpaceMasses scene = renumbered(blocks, seed);
    scene.start({}, BodyContactLaw{true, Coulomb{0.0}});
    for (int i = 0; i < 5; ++i) scene.step(1e-4);
    int slowed = 0; // of 16 nodes above and as many below, that meet at nodes
    for (int n = 0; n < scene.nodes(); ++n) slowed += std::abs(scene.velocity(n).z() + 0.5) < 0.4;
    EXPECT_EQ(slowed, 32) << seed;
  }
}

TEST(SpaceBodies, a_thin_body_does_not_touch_its_own_far_side) {
  SpaceMasses scene = space_block({6, 6, 2}, 0.1, {0, 0, 0}, 1.0, 0.0);
  for (double& z : scene.x[2]) z *= 0.2; // the far side is within the skin
  scene.set_velocity({1.0, 0.3, -0.2});
  for (auto& spring : scene.springs) spring.stiffness = 0.0;
  scene.start({}, BodyContactLaw{true, Coulomb{0.0}});
  for (int i = 0; i < 20; ++i) scene.step(1e-3);
  EXPECT_EQ(scene.contact->body_result().total.workpiece, 0.0);
  for (int i = 0; i < scene.nodes(); ++i) EXPECT_LT((scene.velocity(i) - Vec3(1.0, 0.3, -0.2)).norm(), 1e-14);
}

TEST(SpaceBodies, sides_of_a_thin_body_slide_along_each_other_untouched) {
  SpaceMasses scene = space_block({6, 6, 2}, 0.1, {0, 0, 0}, 1.0, 0.0);
  for (double& z : scene.x[2]) z *= 0.2;
  for (auto& spring : scene.springs) spring.stiffness = 0.0;
  for (std::size_t i = 0; i < scene.x[2].size(); ++i) {
    scene.v[0][i] = 100.0 * scene.x[2][i]; // edges of the two sides come to cross, within the skin
    scene.v[1][i] = 60.0 * scene.x[2][i];
  }
  scene.start({}, BodyContactLaw{true, Coulomb{0.0}});
  for (int i = 0; i < 40; ++i) scene.step(1e-3);
  EXPECT_EQ(scene.contact->body_result().total.workpiece, 0.0);
}

TEST(SpaceBodies, faces_on_each_other_bear_by_few_of_their_pairs_and_do_not_sink_in) {
  SpaceMasses scene = stack();
  const std::size_t own = space_block({5, 5, 3}, 0.25, {0, 0, 0}, 0.0, 0.0).facets.size();
  const int nodes = 5 * 5 * 3;
  const Vec3 momentum = scene.momentum();
  for (int i = 0; i < 30; ++i) { // later they part
    scene.step(5e-4);
    const std::vector<double> force = kept_forces(scene);
    ASSERT_GE(force.size() / 4, 15u) << "at step " << i;
    ASSERT_LE(force.size() / 4, 30u) << "of some 100 pairs, at step " << i;
    double sum = 0.0;
    for (std::size_t c = 0; c < force.size(); c += 4) {
      ASSERT_GT(force[c], 0.0);
      ASSERT_LE(Vec3(force[c + 1], force[c + 2], force[c + 3]).norm(), 0.2 * force[c] * (1.0 + 1e-9));
      sum += force[c];
    }
    const double pressing = scene.contact->body_result().pressing;
    ASSERT_GE(sum, 0.95 * pressing) << "but for what is alone at the rim, at step " << i;
    ASSERT_LE(sum, (1.0 + 1e-9) * pressing);
    for (int n = 0; n < nodes; ++n)
      ASSERT_FALSE(encloses(scene, own, scene.facets.size(), scene.position(n))) << n << " at step " << i;
    for (int n = nodes; n < scene.nodes(); ++n)
      ASSERT_FALSE(encloses(scene, 0, own, scene.position(n))) << n << " at step " << i;
  }
  EXPECT_LT((scene.momentum() - momentum).norm(), 1e-12);
  const ContactWork work = scene.contact->body_result().total;
  EXPECT_NEAR(work.workpiece, work.recovery - work.friction - work.impact, 1e-12);
  EXPECT_LT(work.recovery, 0.01 * work.impact);
}

TEST(SpaceBodies, faces_on_each_other_go_on_to_the_bit_from_what_was_kept) {
  SpaceMasses scene = stack();
  for (int i = 0; i < 10; ++i) scene.step(5e-4);
  ASSERT_FALSE(kept_forces(scene).empty());
  SpaceMasses again = scene, anew = scene;
  MemoryArchive state;
  take_state(scene, state);
  again.start({}, BodyContactLaw{true, Coulomb{0.2}});
  again.contact->archive(state);
  anew.start({}, BodyContactLaw{true, Coulomb{0.2}});
  bool differs = false;
  for (int i = 0; i < 20; ++i) {
    scene.step(5e-4);
    again.step(5e-4);
    anew.step(5e-4);
    for (std::size_t k = 0; k < 3; ++k) {
      ASSERT_EQ(scene.x[k], again.x[k]) << i;
      ASSERT_EQ(scene.v[k], again.v[k]) << i;
      differs = differs || scene.v[k] != anew.v[k];
    }
  }
  EXPECT_TRUE(differs) << "what is kept matters";
}
