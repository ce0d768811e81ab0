// New references of triangles: what goes over from the points that were to those that are, what is booked,
// and that a uniform state is none the wiser.
#include "core/index.hpp"
#include "mechanics/kinematics.hpp"
#include "tests/unit/mechanics/models.hpp"

#include <algorithm>
#include <functional>
#include <gtest/gtest.h>

namespace cnem::testing {
namespace {

/// Nodes on the sides of a rectangle that move as given.
Supports<2> led(const Cloud<2>& cloud, const std::function<Vec2(const Vec2&)>& velocity) {
  Vec2 low = cloud.position[0], high = low;
  for (const Vec2& x : cloud.position) {
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
  }
  std::vector<Support<2>> supports;
  for (const NodeIndex i : cloud.position.indices()) {
    const Vec2& x = cloud.position[i];
    if ((x.array() > low.array()).all() && (x.array() < high.array()).all()) continue;
    const Vec2 v = velocity(x);
    supports.push_back({"x", Support<2>::Kind::velocity, Vec2(1, 0), TimeTable(v.x()), {i}});
    supports.push_back({"y", Support<2>::Kind::velocity, Vec2(0, 1), TimeTable(v.y()), {i}});
  }
  return {std::move(supports), index_of(cloud.nodes())};
}

class Points : public ::testing::TestWithParam<Space> {
protected:
  /// A block whose sides are sheared, with waves inside: its triangles turn into others within some hundred
  /// steps. Of revolution it is a tube, sheared along its axis.
  static ExplicitSolver<2> block(const plasticity::Material& material) {
    Cloud<2> cloud = rectangle(1e-3, 1e-3, 1e-4, Lattice::hexagonal, 0.2);
    for (Vec2& x : cloud.position) x.x() += GetParam() == Space::revolution ? 1e-3 : 0.0;
    Problem<2> model = model_of(std::move(cloud), Method::triangles, material);
    model.method = make(Method::triangles, GetParam());
    model.thermal = true;
    const auto shear = [](const Vec2& x) -> Vec2 { return {0.0, 6e5 * x.x()}; };
    model.supports = led(model.cloud, shear);
    return start(std::move(model),
                 [&](const Vec2& x) -> Vec2 { return shear(x) + Vec2(40.0 * std::sin(x.y() / 2e-4), 0.0); });
  }
};

void advance(ExplicitSolver<2>& solver, int steps) {
  for (int n = 0; n < steps; ++n) solver.advance(solver.stable_step().dt);
}

/// ρ0 times the stress-free volume of each triangle.
Field masses(const ExplicitSolver<2>& solver) {
  const PointState<2>& point = solver.state().point;
  Field mass = solver.approximation().mechanics.volume;
  for (std::size_t p = 0; p < mass.size(); ++p)
    mass[p] *= solver.model().materials[index_of(point.material[p])].density * point.stress_free[p];
  return mass;
}

/// Renews the reference and says what its triangles are made of.
PointRows renew(ExplicitSolver<2>& solver) {
  const DiscreteOperators<2> old = solver.approximation().mechanics;
  solver.prepare();
  return solver.model()
      .method->point_parcels(old, solver.approximation().mechanics, solver.conditions().cloud)
      .value();
}

/// How many triangles of `a` are not in `b`.
std::size_t other_triangles(const DiscreteOperators<2>& a, const DiscreteOperators<2>& b) {
  std::vector<std::array<NodeIndex, 3>> known;
  const auto corners = [](const DiscreteOperators<2>& op, std::size_t p) {
    const auto e = index_of(op.row_begin[p]);
    return std::array{op.node[e], op.node[e + 1], op.node[e + 2]};
  };
  for (std::size_t p = 0; p < index_of(b.points); ++p) known.push_back(corners(b, p));
  std::sort(known.begin(), known.end());
  std::size_t others = 0;
  for (std::size_t p = 0; p < index_of(a.points); ++p)
    others += !std::binary_search(known.begin(), known.end(), corners(a, p));
  return others;
}

TEST_P(Points, mass_momenta_heat_and_work_are_kept_and_energy_is_booked) {
  ExplicitSolver<2> solver = block(steel_304L());
  const Field initial = masses(solver);
  double total = 0.0;
  for (const double m : initial) total += m;
  std::size_t renewed = 0;
  for (int pass = 0; pass < 5; ++pass) {
    advance(solver, 80);
    const State<2> before = solver.state();
    const DiscreteOperators<2> old = solver.approximation().mechanics;
    const Momenta momentum = momenta(solver);
    const Field old_mass = masses(solver);
    const EnergyLedger ledger = solver.ledger();
    solver.prepare();
    renewed += other_triangles(solver.approximation().mechanics, old);
    const State<2>& now = solver.state();
    const Field mass = masses(solver), one(mass.size(), 1.0);
    EXPECT_NEAR(sum_of_products(mass, one), total, 1e-13 * total) << "pass " << pass;
    // nodes stay what they are, to the bit
    EXPECT_EQ(now.node.mass, before.node.mass);
    EXPECT_EQ(now.node.temperature, before.node.temperature);
    EXPECT_EQ(now.node.velocity[0], before.node.velocity[0]);
    EXPECT_EQ((momenta(solver).linear - momentum.linear).norm(), 0.0);
    EXPECT_EQ(momenta(solver).angular, momentum.angular);
    for (const auto field : {&PointState<2>::plastic_strain, &PointState<2>::plastic_work}) {
      const double carried = sum_of_products(old_mass, before.point.*field);
      EXPECT_NEAR(sum_of_products(mass, now.point.*field), carried, 1e-13 * std::abs(carried));
      EXPECT_GT(carried, 0.0);
    }
    const EnergyLedger after = solver.ledger();
    EXPECT_NEAR(after.residual(), ledger.residual(), 1e-11 * after.total());
    EXPECT_NEAR(after["plastic"], ledger["plastic"], 1e-13 * after["plastic"]);
    EXPECT_NEAR(after.heat_residual(), ledger.heat_residual(), 1e-13 * after["heat_content"]);
    // what averaging takes of the stored energy is booked; it is little
    EXPECT_NEAR(after["elastic"] + after["rereference"], ledger["elastic"] + ledger["rereference"],
                1e-12 * ledger["elastic"]);
    EXPECT_GT(after["rereference"], ledger["rereference"]);
    EXPECT_LT(after["rereference"] - ledger["rereference"], 0.2 * ledger["elastic"]);
  }
  EXPECT_GT(renewed, initial.size()) << "the triangles are all others";
  EXPECT_LT(std::abs(solver.ledger().residual()), 2e-3 * solver.ledger().external());
}

// A triangle has the mass of its parcels, and the pressure that this mass has in its volume.
TEST_P(Points, have_the_mass_of_their_parcels_and_its_pressure) {
  ExplicitSolver<2> solver = block(steel_304L());
  const double kappa = steel_304L().elasticity.kappa(), density = steel_304L().density;
  std::size_t mixed = 0;
  for (int pass = 0; pass < 3; ++pass) {
    advance(solver, 100);
    Field expected = masses(solver);
    const PointRows parcels = renew(solver);
    carry_sum(parcels, expected);
    const Field mass = masses(solver), &volume = solver.approximation().mechanics.volume;
    for (std::size_t p = 0; p < mass.size(); ++p) {
      mixed += parcels.mixed(p);
      EXPECT_NEAR(mass[p], expected[p], 1e-12 * expected[p]);
      EXPECT_NEAR(solver.state().point.pressure[p], -kappa * std::log(density * volume[p] / expected[p]),
                  1e-9 * kappa);
    }
  }
  EXPECT_GT(mixed, 100U);
}

TEST_P(Points, stresses_of_mixed_points_do_not_exceed_the_yield_stress) {
  ExplicitSolver<2> solver = block(steel_304L());
  const plasticity::Hardening& law = *solver.model().materials[0].hardening;
  std::size_t mixed = 0, at_yield = 0;
  for (int pass = 0; pass < 3; ++pass) {
    advance(solver, 100);
    const PointRows parcels = renew(solver);
    const PointState<2>& point = solver.state().point;
    for (std::size_t p = 0; p < point.size(); ++p) {
      if (!parcels.mixed(p)) continue;
      ++mixed;
      const double yield =
          law.flow_stress(point.plastic_strain[p], point.plastic_rate[p], point.temperature[p]);
      EXPECT_LE(point.equivalent_stress[p], yield * (1 + 1e-9));
      at_yield += point.equivalent_stress[p] > 0.99 * yield;
    }
  }
  EXPECT_GT(mixed, 100U);
  EXPECT_GT(at_yield, 20U);
}

TEST_P(Points, damage_goes_with_the_mass) {
  plasticity::Material material = steel_304L();
  plasticity::Damage& damage = material.damage.emplace();
  damage.law = plasticity::JohnsonCookDamage{.D1 = 0.02};
  damage.fracture_energy = 1e3;
  ExplicitSolver<2> solver = block(material);
  for (int pass = 0; pass < 4; ++pass) {
    advance(solver, 60);
    const PointState<2> before = solver.state().point;
    const Field old_mass = masses(solver);
    const EnergyLedger ledger = solver.ledger();
    solver.prepare();
    const PointState<2>& now = solver.state().point;
    const Field mass = masses(solver);
    for (const auto field : {&PointState<2>::damage, &PointState<2>::softening}) {
      const double carried = sum_of_products(old_mass, before.*field);
      EXPECT_GT(carried, 0.0);
      EXPECT_NEAR(sum_of_products(mass, now.*field), carried, 1e-13 * carried);
    }
    EXPECT_LE(*std::max_element(now.softening.begin(), now.softening.end()), 1.0);
    EXPECT_NEAR(solver.ledger().residual(), ledger.residual(), 1e-11 * ledger.total());
  }
}

/// All nodes follow X → X + t H X.
ExplicitSolver<2> uniform(const Mat2& H, double end, plasticity::Material material) {
  Cloud<2> cloud = rectangle(1e-2, 0.8e-2, 1e-3, Lattice::hexagonal, 0.2);
  std::vector<Support<2>> supports;
  for (const NodeIndex i : cloud.position.indices())
    for (int k = 0; k < 2; ++k)
      supports.push_back({"all",
                          Support<2>::Kind::velocity,
                          k == 0 ? Vec2(1, 0) : Vec2(0, 1),
                          TimeTable(H.row(k).dot(cloud.position[i]) / end),
                          {i}});
  Problem<2> model = model_of(std::move(cloud), Method::triangles, std::move(material));
  model.supports = Supports<2>(std::move(supports), index_of(model.cloud.nodes()));
  return start(std::move(model), [&](const Vec2& x) -> Vec2 { return H * x / end; });
}

// The patch test of a renewal: a body in uniform stress is in the same stress afterwards, without inner
// force.
TEST(UniformPoints, do_not_feel_that_triangles_are_others) {
  const Mat2 H = (Mat2() << 0.1, 0.9, 0.05, -0.1).finished();
  for (const bool plastic : {false, true}) {
    const double end = 2e-5;
    ExplicitSolver<2> solver = uniform(H, end, plastic ? steel_304L() : steel());
    std::size_t renewed = 0;
    for (int n = 1; n <= 200; ++n) {
      solver.advance(end / 200);
      if (n % 40 != 0) continue;
      const PointState<2> before = solver.state().point;
      const DiscreteOperators<2> old = solver.approximation().mechanics;
      solver.prepare();
      renewed += other_triangles(solver.approximation().mechanics, old);
      const PointState<2>& now = solver.state().point;
      const double stress = before.equivalent_stress[0],
                   scale = std::max(stress, std::abs(before.pressure[0]));
      for (std::size_t p = 0; p < now.size(); ++p) {
        EXPECT_NEAR(now.equivalent_stress[p], stress, 1e-9 * scale);
        EXPECT_NEAR(now.pressure[p], before.pressure[0], 1e-9 * scale);
        EXPECT_NEAR(now.plastic_strain[p], before.plastic_strain[0], 1e-12);
      }
      std::vector<char> boundary(solver.state().node.size(), 0);
      for (const Facet<2>& facet : solver.conditions().cloud.facets)
        for (const NodeIndex i : facet.node) boundary[index_of(i)] = 1;
      const Fields<2>& force = solver.state().node.force;
      for (std::size_t i = 0; i < boundary.size(); ++i)
        if (!boundary[i]) { EXPECT_LT(std::hypot(force[0][i], force[1][i]), 1e-9 * scale * 1e-3); }
    }
    EXPECT_GT(renewed, 100U) << "nothing was renewed";
    if (plastic) { EXPECT_GT(solver.state().point.plastic_strain[0], 0.3); }
  }
}

// Two materials side by side, sheared: a triangle is made of one of them.
TEST(PartedPoints, keep_their_material) {
  Cloud<2> cloud;
  add_loop(cloud, {{0, 0}, {1e-3, 0}, {1e-3, 5e-4}, {0, 5e-4}}, 1e-4);
  add_loop(cloud, {{0, 5e-4}, {1e-3, 5e-4}, {1e-3, 1e-3}, {0, 1e-3}}, 1e-4);
  declare_twins(cloud);
  fill(cloud, Lattice::hexagonal, 1e-4, 0.2, 5e-5, 1);
  Problem<2> model = model_of(cloud, Method::triangles, steel_304L());
  plasticity::Material light = steel_304L();
  light.density = 2700.0;
  model.materials.push_back(light);
  for (const NodeIndex i : cloud.position.indices()) {
    const bool lower = i < 30_node || (i >= 60_node && cloud.position[i].y() < 5e-4);
    model.node_material.push_back(lower ? 0 : 1);
  }
  ASSERT_EQ(cloud.facets.size(), 60U);
  std::vector<std::array<NodeIndex, 2>> pairs(cloud.twins.begin(), cloud.twins.end());
  model.ties = Ties<2>(pairs, cloud.position);
  const auto shear = [](const Vec2& x) -> Vec2 { return {6e5 * x.y(), 0.0}; };
  model.supports = led(cloud, shear);
  ExplicitSolver<2> solver = start(std::move(model), shear);
  const auto of_material = [&](std::int32_t material) {
    const Field mass = masses(solver);
    double total = 0.0;
    for (std::size_t p = 0; p < mass.size(); ++p)
      if (solver.state().point.material[p] == material) total += mass[p];
    return total;
  };
  const double heavy = of_material(0), lightest = of_material(1);
  EXPECT_NEAR(heavy, 7850.0 * 5e-7, 1e-12);
  for (int pass = 0; pass < 4; ++pass) {
    advance(solver, 100);
    const DiscreteOperators<2> old = solver.approximation().mechanics;
    solver.prepare();
    EXPECT_GT(other_triangles(solver.approximation().mechanics, old), 0U);
    EXPECT_NEAR(of_material(0), heavy, 1e-13 * heavy);
    EXPECT_NEAR(of_material(1), lightest, 1e-13 * lightest);
    const PointState<2>& point = solver.state().point;
    for (std::size_t p = 0; p < point.size(); ++p)
      for (auto e = index_of(solver.approximation().mechanics.row_begin[p]);
           e < index_of(solver.approximation().mechanics.row_begin[p + 1]); ++e)
        EXPECT_EQ(solver.state().node.material[index_of(solver.approximation().mechanics.node[e])],
                  point.material[p]);
  }
}

INSTANTIATE_TEST_SUITE_P(of, Points, ::testing::Values(Space::plane, Space::revolution),
                         [](const auto& test) {
                           return test.param == Space::plane ? "plane_bodies" : "bodies_of_revolution";
                         });

} // namespace
} // namespace cnem::testing
