// Contact of deformable bodies with each other and with themselves, with the whole solver.
#include "tests/unit/mechanics/tools.hpp"
#include "tests/verification/bar_impact.hpp"

#include <gtest/gtest.h>

namespace cnem::testing {
namespace {

/// Two rectangles; which nodes are of the second one follows from `is_second`.
Cloud<2> two_blocks(const std::vector<Vec2>& first, const std::vector<Vec2>& second, double h_first,
                    double h_second) {
  Cloud<2> cloud, other;
  add_loop(cloud, first, h_first);
  fill(cloud, Lattice::square, h_first, 0.0, 0.5 * h_first, 1);
  add_loop(other, second, h_second);
  fill(other, Lattice::square, h_second, 0.0, 0.5 * h_second, 1);
  const std::int32_t offset = cloud.nodes();
  for (Facet<2> facet : other.facets) {
    for (NodeIndex& node : facet.node) node = as<NodeIndex>(as<int>(node) + offset);
    cloud.facets.push_back(facet);
  }
  cloud.position.insert(cloud.position.end(), other.position.begin(), other.position.end());
  return cloud;
}

std::vector<Vec2> corners(const Vec2& low, const Vec2& high) {
  return {low, {high.x(), low.y()}, high, {low.x(), high.y()}};
}

contact::RigidContact<2> bodies(double friction, std::vector<contact::Tool<2>> tools = {}) {
  return contact::RigidContact<2>(
      std::move(tools), Space::plane,
      {.active = true, .friction = contact::Coulomb{friction}, .conductance = 0.0});
}

/// Mass and momentum of the nodes that pass the test of their initial position.
struct Share {
  double mass = 0.0, heat = 0.0;
  Vec2 momentum = Vec2::Zero();
};
template<class Test> Share share_of(const ExplicitSolver<2>& solver, Test&& test) {
  Share sum;
  const NodeState<2>& node = solver.state().node;
  for (std::size_t i = 0; i < node.size(); ++i) {
    if (!test(Vec2(solver.state().node.initial_position[0][i], solver.state().node.initial_position[1][i])))
      continue;
    sum.mass += node.mass[i];
    sum.momentum += node.mass[i] * Vec2(node.velocity[0][i], node.velocity[1][i]);
    sum.heat += node.heat_capacity[i] * (node.temperature[i] - 296.0);
  }
  return sum;
}

/// Do two facets without a common node cross?
bool crosses_itself(const ExplicitSolver<2>& solver) {
  const NodeState<2>& node = solver.state().node;
  const auto at = [&](NodeIndex i) {
    return Vec2(node.position[0][static_cast<std::size_t>(i)], node.position[1][static_cast<std::size_t>(i)]);
  };
  const auto& facets = solver.conditions().cloud.facets;
  for (std::size_t f = 0; f < facets.size(); ++f)
    for (std::size_t g = f + 1; g < facets.size(); ++g) {
      const auto &p = facets[f].node, &q = facets[g].node;
      if (p[0] == q[0] || p[0] == q[1] || p[1] == q[0] || p[1] == q[1]) continue;
      const Vec2 a = at(p[0]), b = at(p[1]), c = at(q[0]), d = at(q[1]);
      if (cross(b - a, c - a) * cross(b - a, d - a) < 0.0 && cross(d - c, a - c) * cross(d - c, b - c) < 0.0)
        return true;
    }
  return false;
}

/// Spacing of the second body over that of the first.
struct Pairing {
  double ratio;
  bool local = false;
};

class Blocks : public ::testing::TestWithParam<Pairing> {};

TEST_P(Blocks, that_collide_exchange_velocities_after_2_l_over_c) {
  const double length = 1e-2, width = 1e-3, h = 1.25e-4, speed = 5.0, gap = 1e-6;
  plasticity::Material material = steel();
  material.elasticity.poisson = 0.0; // one-dimensional: c = √(E/ρ) exactly
  Problem<2> model = model_of(two_blocks(corners({-length - gap, 0}, {-gap, width}),
                                         corners({gap, 0}, {length + gap, width}), h, GetParam().ratio * h),
                              Method::cnem, material);
  model.contact = bodies(0.0);
  model.local = {.on = GetParam().local, .least_gain = 0.0};
  ExplicitSolver<2> solver = start(std::move(model), [&](const Vec2& x) -> Vec2 {
    return {x.x() < 0.0 ? speed : -speed, 0};
  });
  const auto left = [](const Vec2& x) { return x.x() < 0.0; };
  const double c = material.elasticity.bar_speed(material.density), duration = 2.0 * length / c;
  const double mass = material.density * length * width;
  const Vec2 total = momenta(solver).linear;
  expect_bar_impact(solver, gap / speed, duration, material.density * c * speed * width,
                    [&] { return solver.conditions().contact.body_result().pressing; });
  EXPECT_EQ(solver.sub_steps(), GetParam().local ? 2 : 1);
  EXPECT_LT((momenta(solver).linear - total).norm(), 1e-13 * mass * speed) << "momentum is exact";
  EXPECT_NEAR(share_of(solver, left).momentum.x(), -mass * speed, 0.03 * mass * speed);
  EXPECT_GT(solver.ledger()["contact_impact"], 0.0);
  EXPECT_LT(solver.ledger()["contact_impact"], 0.03 * solver.ledger().initial());
}
INSTANTIATE_TEST_SUITE_P(spacing_ratio, Blocks,
                         ::testing::Values(Pairing{1.0}, Pairing{0.8}, Pairing{1.7}, Pairing{0.5, true}));

class SlidingBlock : public ::testing::TestWithParam<Pairing> {};

TEST_P(SlidingBlock, decelerates_by_mu_g_and_heats_both_sides_alike) {
  const double h = 2.5e-4, speed = 20.0, g = 1e5, mu = 0.2, time = 2e-4, gap = 1e-9;
  // The lower block hangs below the upper one, so that a point above y = 0 is of the upper one.
  Cloud<2> cloud = two_blocks(corners({0, -1e-3}, {1e-2, 0}), corners({1e-3, gap}, {3e-3, gap + 1e-3}), h,
                              GetParam().ratio * h);
  const auto upper = [=](const Vec2& x) { return x.y() > 0.5 * gap; };
  std::vector<NodeIndex> base;
  for (const NodeIndex i : cloud.position.indices())
    if (cloud.position[i].y() < -1e-3 + 1e-9) base.push_back(i);
  plasticity::Material material = steel();
  material.conductivity = 1e-6; // heat stays where it is made
  Problem<2> model = model_of(cloud, Method::cnem, material);
  model.thermal = true;
  model.supports = Supports<2>({{"base x", Support<2>::Kind::velocity, Vec2(1, 0), TimeTable(0.0), base},
                                {"base y", Support<2>::Kind::velocity, Vec2(0, 1), TimeTable(0.0), base}},
                               static_cast<std::size_t>(cloud.nodes()));
  model.contact = bodies(mu);
  model.local = {.on = GetParam().local, .least_gain = 0.0};
  model.loads = Loads<2>({}, {}, {TimeTable(0.0), TimeTable(-g)}, cloud.position);
  model.viscosity = {1.2, 0.06};
  ExplicitSolver<2> solver = start(std::move(model), [&](const Vec2& x) -> Vec2 {
    return {upper(x) ? speed : 0.0, 0.0};
  });
  const double mass = share_of(solver, upper).mass;
  while (solver.state().time < time) solver.advance(solver.stable_step().dt);
  const Share block = share_of(solver, upper),
              ground = share_of(solver, [&](const Vec2&x) { return !upper(x); });
  const double slowed = mu * g * solver.state().time, after = speed - slowed;
  EXPECT_EQ(solver.sub_steps() > 1, GetParam().local);
  EXPECT_NEAR(block.momentum.x() / mass, after, 0.02 * slowed);
  const double lost = 0.5 * mass * (speed * speed - after * after);
  EXPECT_NEAR(solver.ledger()["friction"], lost, 0.03 * lost);
  EXPECT_NEAR(block.heat, ground.heat, 1e-9 * lost) << "equal effusivities";
  EXPECT_NEAR(block.heat + ground.heat, solver.ledger()["friction"], 1e-9 * lost);
  EXPECT_LT(std::abs(solver.ledger().residual()), 1e-3 * lost);
  EXPECT_FALSE(crosses_itself(solver));
}

INSTANTIATE_TEST_SUITE_P(spacing_ratio, SlidingBlock, ::testing::Values(Pairing{0.8}, Pairing{0.5, true}));

// Two blocks of another spacing each, one resting on the other, so well conducting that each has one
// temperature.
TEST(RestingBlock, passes_its_heat_on_at_the_rate_of_the_conductance) {
  const double h = 2.5e-4, width = 2e-3, height = 1e-3, g = 1e5, conductance = 1e7, gap = 1e-9,
               ledge = 2.5e-4;
  const auto upper = [=](const Vec2& x) { return x.y() > 0.5 * gap; };
  for (const auto& [ratio, local] : {Pairing{1.0}, Pairing{0.7}, Pairing{1.6}, Pairing{0.5, true}}) {
    const Cloud<2> cloud = two_blocks(corners({-ledge, -height}, {width + ledge, 0}),
                                      corners({0, gap}, {width, gap + height}), h, ratio * h);
    std::vector<NodeIndex> base;
    for (const NodeIndex i : cloud.position.indices())
      if (cloud.position[i].y() < -height + 1e-9) base.push_back(i);
    plasticity::Material material = steel();
    material.conductivity = 1e6;
    Problem<2> model = model_of(cloud, Method::cnem, material);
    model.thermal = true;
    model.supports = Supports<2>({{"base", Support<2>::Kind::velocity, Vec2(0, 1), TimeTable(0.0), base}},
                                 static_cast<std::size_t>(cloud.nodes()));
    model.contact = contact::RigidContact<2>({}, Space::plane,
                                             {.active = true, .friction = {}, .conductance = conductance});
    model.local = {.on = local, .least_gain = 0.0};
    model.loads = Loads<2>({}, {}, {TimeTable(0.0), TimeTable(-g)}, cloud.position);
    model.viscosity = {1.2, 0.06};
    Fields<2> velocity;
    resize_all(velocity, cloud.position.size(), 0.0);
    Field temperature;
    for (const Vec2& x : cloud.position) temperature.push_back(upper(x) ? 400.0 : 296.0);
    ExplicitSolver<2> solver(std::move(model), std::move(velocity), std::move(temperature));
    const double heat = material.density * material.specific_heat * height,      // J/(K m²)
        rate = conductance * (1.0 / width + 1.0 / (width + 2.0 * ledge)) / heat, // 1/(m s)
        end = 0.5 / (rate * width);
    const double before = share_of(solver, upper).heat;
    const double weight = material.density * g * width * height;
    double touched = 0.0, pressed = 0.0, while_pressed = 0.0; // m s, s, m s
    while (solver.state().time < end) {                       // it bounces a little
      const double dt = std::min(solver.stable_step().dt, end - solver.state().time);
      solver.advance(dt);
      double area = 0.0;
      for (const auto& touch : solver.conditions().contact.touches()) area += touch.area;
      touched += dt * area;
      if (solver.conditions().contact.body_result().pressing < 0.5 * weight) continue;
      pressed += dt;
      while_pressed += dt * area;
    }
    EXPECT_EQ(solver.sub_steps() > 1, local);
    EXPECT_GT(pressed, 0.5 * end);
    EXPECT_NEAR(while_pressed / pressed, width, 0.07 * width) << ratio; // corners come and go
    const auto lower = [&](const Vec2& x) { return !upper(x); };
    const double one = share_of(solver, upper).heat / width,
                 other = share_of(solver, lower).heat / (width + 2.0 * ledge);
    EXPECT_NEAR((one - other) / (before / width), std::exp(-rate * touched), 0.005) << ratio;
    EXPECT_NEAR(one * width + other * (width + 2.0 * ledge), before, 1e-4 * before)
        << ratio; // and some of the fall
  }
}

/// A C that a tool presses shut: the slot closes on itself, with references renewed on the way.
ExplicitSolver<2> close_slot(int steps, int every) {
  Cloud<2> cloud;
  const double h = 1.5e-4;
  add_loop(cloud,
           {{0, 0},
            {3e-3, 0},
            {3e-3, 0.9e-3},
            {1e-3, 0.9e-3},
            {1e-3, 1.3e-3},
            {3e-3, 1.3e-3},
            {3e-3, 2e-3},
            {0, 2e-3}},
           h);
  fill(cloud, Lattice::hexagonal, h, 0.1, 0.5 * h, 3);
  std::vector<NodeIndex> base;
  for (const NodeIndex i : cloud.position.indices())
    if (cloud.position[i].y() == 0.0) base.push_back(i);
  Problem<2> model = model_of(cloud, Method::cnem, steel_304L());
  model.supports = Supports<2>({{"base", Support<2>::Kind::symmetry, Vec2(0, -1), {}, base}},
                               static_cast<std::size_t>(cloud.nodes()));
  model.contact = bodies(
      0.1, {rigid_tool("punch", box({-1e-3, 2e-3}, {5e-3, 3e-3}), {0.0, -30.0}, contact::Coulomb{0.1})});
  ExplicitSolver<2> solver = start(std::move(model), [](const Vec2&) -> Vec2 { return {0, 0}; });
  for (int n = 0; n < steps; ++n) {
    if (n > 0 && n % every == 0) solver.prepare();
    solver.advance(solver.stable_step().dt);
  }
  return solver;
}

TEST(Slot, closes_without_passing_through_itself) {
  ExplicitSolver<2> solver = close_slot(2600, 100);
  EXPECT_FALSE(crosses_itself(solver));
  EXPECT_GT(solver.conditions().contact.body_result().pressing, 1e4);
  EXPECT_GT(solver.conditions().contact.body_result().total.friction, 0.0);
  EXPECT_LT(solver.conditions().contact.bodies().listings(), 200);
  EXPECT_LT(std::abs(solver.ledger().residual()), 0.003 * solver.ledger().external());
}

} // namespace
} // namespace cnem::testing
