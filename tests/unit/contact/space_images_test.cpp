// Bodies that go on at their own images: what meets an image is what would meet a body that stood there.
#include "contact/images.hpp"
#include "contact/periods.hpp"
#include "space_masses.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <numbers>

using namespace cnem;
using namespace cnem::contact;
using namespace cnem::contact::testing;

namespace {

/// Adds a block of 4 × 4 × 3 nodes and total mass 1, moved after it is made.
void add_block(SpaceMasses& scene, const Vec3& shift, const std::function<Vec3(const Vec3&)>& velocity) {
  const SpaceMasses block = space_block({4, 4, 3}, 0.25, {0, 0, 0}, 0.0, 0.0);
  const int first = scene.nodes();
  for (int i = 0; i < block.nodes(); ++i)
    scene.add(block.position(i) + shift, block.mass[std::size_t(i)], velocity(block.position(i)));
  for (const Facet<3>& f : block.facets)
    scene.facet(first + as<int>(f.node[0]), first + as<int>(f.node[1]), first + as<int>(f.node[2]));
}

void start(SpaceMasses& scene, std::vector<Vec3> period, double friction = 0.0) {
  scene.contact = std::make_shared<RigidContact<3>>(std::vector<Tool<3>>{}, Space::plane,
                                                    BodyContactLaw{true, Coulomb{friction}});
  scene.contact->repeat({std::move(period), {}});
  scene.contact->set_boundary(scene.facets, scene.mass.size(), {});
}

/// Pieces 1 and 2 are the sides at low and high x, whose nodes are pairs.
struct Slab : SpaceMasses {
  static constexpr double width = 1.0;
  std::vector<std::int32_t> group;

  Slab() : SpaceMasses(space_block({5, 5, 3}, 0.25, {0, 0, 0}, 0.0, 0.0)) {
    const auto on = [&](const Facet<3>& f, double at) {
      return std::ranges::all_of(f.node, [&](NodeIndex i) { return x[0][index_of(i)] == at; });
    };
    for (Facet<3>& f : facets) f.piece = as<PieceIndex>(on(f, 0.0) ? 1 : on(f, width) ? 2 : 0);
    std::map<std::array<double, 2>, std::int32_t> number;
    for (int i = 0; i < nodes(); ++i) {
      const Vec3 at = position(i);
      const bool tied = at.x() == 0.0 || at.x() == width;
      group.push_back(tied ? number.try_emplace({at.y(), at.z()}, std::int32_t(number.size())).first->second
                           : -1);
    }
  }
  void start() {
    contact =
        std::make_shared<RigidContact<3>>(std::vector<Tool<3>>{}, Space::plane, BodyContactLaw{true, {}});
    contact->repeat({{Vec3(width, 0, 0)}, {as<PieceIndex>(1), as<PieceIndex>(2)}});
    IndexedVector<NodeIndex, std::int32_t> groups;
    for (const std::int32_t g : group) groups.push_back(g);
    contact->set_boundary(facets, mass.size(), {}, groups);
  }
};

} // namespace

TEST(SpaceImages, are_all_that_come_near_and_each_has_its_opposite) {
  const std::vector<Vec3> period{{1.0, 0.2, 0.0}, {0.1, 0.5, 0.3}};
  const Vec3 extent{2.5, 1.1, 0.7};
  const double margin = 0.1;
  const std::vector<Vec3> found = images(period, extent, margin);
  ASSERT_EQ(found[0], Vec3::Zero());
  std::size_t wanted = 0;
  for (int i = -20; i <= 20; ++i)
    for (int j = -20; j <= 20; ++j) {
      const Vec3 shift = i * period[0] + j * period[1];
      const bool near = (shift.cwiseAbs() - extent).maxCoeff() <= margin;
      wanted += near;
      EXPECT_EQ(std::ranges::count_if(found, [&](const Vec3& k) { return (k - shift).norm() < 1e-12; }), near)
          << i << ' ' << j;
    }
  EXPECT_EQ(found.size(), wanted);
  EXPECT_GT(wanted, 9U);
  for (std::size_t k = 1; k < found.size(); k += 2) EXPECT_EQ(found[k], -found[k + 1]);
  EXPECT_EQ(images({}, extent, margin).size(), 1U);
}

// Sides in pieces and cells of six sides give more periods than the body has.
TEST(SpaceImages, periods_that_follow_from_others_add_none) {
  const Vec3 a{1.0, 0.0, 0.0}, b{0.5, 0.5 * std::numbers::sqrt3, 0.0}, c{0.1, 0.2, 0.7};
  std::vector<Vec3> period;
  for (const Vec3& one : std::vector<Vec3>{a, a, b, -a, b - a, c, a - 2.0 * b + 3.0 * c, (1.0 + 1e-7) * a})
    EXPECT_TRUE(add_period(period, one));
  EXPECT_EQ(period, (std::vector<Vec3>{a, b, c}));
  for (const Vec3& one : std::vector<Vec3>{0.5 * a, 1.5 * a, 0.5 * (a + b), a / 3.0 + b / 3.0 + c})
    EXPECT_FALSE(add_period(period, one)) << one.transpose();
  EXPECT_EQ(period.size(), 3U);
  std::vector<Vec3> tilted{a};
  EXPECT_TRUE(add_period(tilted, a + Vec3(0.0, 0.01, 0.0))) << "it is another direction";
  EXPECT_EQ(tilted.size(), 2U);
}

// A block grows along x until it meets its own image on both sides: as one of an endless row of such blocks,
// of which two between planes twice as far apart are another piece.
TEST(SpaceImages, a_block_meets_its_own_image_as_it_would_meet_another) {
  const auto growing = [](const Vec3& x) {
    return Vec3(0.7 + 2.0 * (x.x() - 0.3), 0.3 * x.z(), 0.2 * x.x());
  };
  SpaceMasses one, two, alone;
  add_block(one, {0, 0, 0}, growing);
  add_block(alone, {0, 0, 0}, growing);
  const Vec3 period{0.8, 0.03, 0.02};
  for (const double n : {0.0, 1.0}) add_block(two, n * period, growing);
  start(one, {period});
  start(two, {2.0 * period});
  start(alone, {});
  const Vec3 momentum = one.momentum();
  double apart = 0.0, slowed = 0.0;
  for (int n = 0; n < 40; ++n) {
    one.step(2e-3), two.step(2e-3), alone.step(2e-3);
    for (int i = 0; i < one.nodes(); ++i) {
      slowed = std::max(slowed, (alone.velocity(i) - one.velocity(i)).norm());
      for (const int copy : {0, one.nodes()})
        apart = std::max(apart, (two.velocity(i + copy) - one.velocity(i)).norm());
    }
  }
  EXPECT_GT(slowed, 0.5);
  EXPECT_LT(apart, 0.05) << "what sweeps over contacts in another order leave";
  EXPECT_LT((one.momentum() - momentum).norm(), 1e-13);
  EXPECT_NEAR(two.contact->body_result().total.impact, 2.0 * one.contact->body_result().total.impact,
              1e-3 * one.contact->body_result().total.impact);
  EXPECT_GT(one.contact->body_result().total.impact, 0.01);
  const auto [low, high] = std::ranges::minmax(one.x[0]);
  EXPECT_LT(high - low, 0.82) << "nodes of the rim beside the other's face go on";
  const auto [free_low, free_high] = std::ranges::minmax(alone.x[0]);
  EXPECT_GT(free_high - free_low, 0.85) << "it would have gone on";
}

// Metal may have come beside the slice by several periods before it lands.
TEST(SpaceImages, a_block_lands_on_an_image_several_periods_away) {
  const auto rests = [](const Vec3&) -> Vec3 { return {0, 0, 0}; };
  const auto falls = [](const Vec3&) -> Vec3 { return {0.2, 0.1, -1.0}; };
  const Vec3 beside{0.11, 0.07, 0.51};
  SpaceMasses here, far;
  add_block(here, {0, 0, 0}, rests);
  add_block(here, beside, falls);
  add_block(far, {0, 0, 0}, rests);
  add_block(far, beside + Vec3(-2.4, 3.6, 0.3), falls);
  start(here, {}, 0.3);
  start(far, {{0.8, 0.0, -0.1}, {0.0, 0.9, 0.0}}, 0.3);
  const Vec3 momentum = far.momentum();
  for (int n = 0; n < 40; ++n) {
    here.step(1e-3), far.step(1e-3);
    for (int i = 0; i < here.nodes(); ++i)
      ASSERT_LT((here.velocity(i) - far.velocity(i)).norm(), 1e-9) << n << ' ' << i;
  }
  EXPECT_GT(here.contact->body_result().total.impact, 0.03);
  EXPECT_LT((far.momentum() - momentum).norm(), 1e-13);
}

TEST(SpaceImages, edges_cross_images_of_edges) {
  const auto roof = [](SpaceMasses& scene, bool upper, const Vec3& shift) {
    const int first = scene.nodes();
    for (const Vec3& x : {Vec3(-1, 0, 0), Vec3(1, 0, 0), Vec3(-1, -0.2, -1), Vec3(1, -0.2, -1),
                          Vec3(-1, 0.2, -1), Vec3(1, 0.2, -1)})
      scene.add((upper ? Vec3(x.y(), x.x(), 0.01 - x.z()) : x) + shift, upper ? 2.0 : 1.0,
                {0, 0, upper ? -1.0 : 0.0});
    const auto facet = [&](int a, int b, int c) { scene.facet(first + a, first + b, first + c); };
    facet(0, 2, 3), facet(0, 3, 1), facet(0, 1, 5), facet(0, 5, 4);
    facet(2, 4, 5), facet(2, 5, 3), facet(0, 4, 2), facet(1, 3, 5);
  };
  for (const double sign : {-1.0, 1.0}) { // whichever of both is the one that is shifted
    SpaceMasses here, far;
    for (const bool upper : {false, true}) roof(here, upper, {0, 0, 0});
    for (const bool upper : {false, true}) roof(far, upper, upper ? Vec3(3.0 * sign, 0, 0) : Vec3(0, 0, 0));
    start(here, {});
    start(far, {{3.0, 0.0, 0.0}});
    const Vec3 momentum = far.momentum();
    for (int n = 0; n < 12; ++n) {
      here.step(1e-3), far.step(1e-3);
      for (int i = 0; i < here.nodes(); ++i)
        ASSERT_LT((here.velocity(i) - far.velocity(i)).norm(), 1e-10) << n << ' ' << i;
    }
    EXPECT_LT(far.velocity(0).z(), -0.1);
    EXPECT_LT((far.momentum() - momentum).norm(), 1e-13);
  }
}

// Faces that go on across a period are one face: whatever flows along it, or through the plane, is not
// stopped.
TEST(SpaceImages, matter_that_goes_on_across_a_period_does_not_touch_itself) {
  Slab slab;
  for (int i = 0; i < slab.nodes(); ++i) { // the sides bend alike; along x what is beside them differs
    const Vec3 at = slab.position(i);
    slab.v[0][std::size_t(i)] = 2.0 * at.z() + 0.1 * std::sin(2.0 * std::numbers::pi * at.x());
    slab.v[1][std::size_t(i)] = -0.4 * at.y() + 0.2 * at.z();
    slab.v[2][std::size_t(i)] =
        0.8 * at.z() + 0.4 * (at.z() - 0.25) * std::cos(2.0 * std::numbers::pi * at.x());
  }
  slab.start();
  for (int n = 0; n < 100; ++n) slab.step(1e-2);
  EXPECT_EQ(slab.contact->body_result().total.workpiece, 0.0);
}

// A node beside a plane comes down on a facet that ends at the plane, seen from beyond it.
TEST(SpaceImages, a_fold_lands_on_the_slice_beside_it) {
  Slab slab;
  const int own = slab.nodes();
  add_block(slab, {0.9, 0.1, 0.52}, [](const Vec3&) -> Vec3 {
    return {0, 0, -1.0};
  }); // 0.15 beyond the plane
  slab.group.resize(std::size_t(slab.nodes()), -1);
  slab.start();
  const Vec3 momentum = slab.momentum();
  for (int n = 0; n < 60; ++n) slab.step(1e-3);
  EXPECT_LT((slab.momentum() - momentum).norm(), 1e-13);
  int moved = 0;
  for (int i = 0; i < own; ++i)
    for (int j = 0; j < i; ++j) {
      if (slab.group[std::size_t(i)] < 0 || slab.group[std::size_t(i)] != slab.group[std::size_t(j)])
        continue;
      EXPECT_EQ(slab.velocity(i), slab.velocity(j)) << "what lands on one of two tied nodes moves both";
      moved += slab.velocity(i).z() < -0.01;
    }
  EXPECT_GE(moved, 3);
  int stopped = 0;
  for (int i = own; i < slab.nodes(); ++i) stopped += slab.velocity(i).z() > -0.95;
  EXPECT_EQ(stopped, 16) << "nodes of its lower side, of which 4 are above the slab itself";
  double highest = 0.0, lowest = 1.0;
  for (int i = 0; i < own; ++i) highest = std::max(highest, slab.position(i).z());
  for (int i = own; i < slab.nodes(); ++i) lowest = std::min(lowest, slab.position(i).z());
  EXPECT_LT(highest, 0.5 + 1e-12);
  EXPECT_GT(lowest, 0.46 + 0.005) << "where it would be, had nothing stopped it";
}
