// The audit of every change of a cloud: what the solver has before and after.
#include "adapt/plane/resample.hpp"
#include "mechanics/kinematics.hpp"
#include "tests/conservation/nodes_of.hpp"
#include "tests/unit/mechanics/models.hpp"

#include <gtest/gtest.h>

namespace cnem::testing {
namespace {

/// Finer on the left, coarser on the right.
Resampling<2> resampled(const ExplicitSolver<2>& solver, double factor) {
  adapt::NodeProperties node =
      nodes_of(solver, [&](const Vec2& X) { return 1e-4 * (X.x() < 5e-4 ? factor : 1.0 / factor); });
  adapt::PassReport report;
  const Cloud<2> cloud = solver.present_cloud();
  return adapt::resample(cloud, adapt::structure_if_valid(cloud), std::move(node), {}, report);
}

ExplicitSolver<2> deformed_block(int steps, const plasticity::Material& material = steel_304L()) {
  Cloud<2> cloud = rectangle(1e-3, 1e-3, 1e-4, Lattice::hexagonal, 0.2);
  Problem<2> model = model_of(cloud, Method::cnem, material);
  model.thermal = true;
  ExplicitSolver<2> solver = start(std::move(model), [](const Vec2& x) -> Vec2 {
    return {2e5 * (x.y() - 5e-4), 4e4 * std::sin(x.x() / 2e-4) * 1e-3};
  });
  for (int n = 0; n < steps; ++n) solver.advance(solver.stable_step().dt);
  return solver;
}

TEST(Audit, mass_momentum_and_heat_are_kept_and_energy_is_booked) {
  ExplicitSolver<2> solver = deformed_block(150);
  for (const double factor : {0.5, 1.0, 2.0}) {
    const State<2>& state = solver.state();
    const Momenta momentum = momenta(solver);
    const double mass = sum_of_products(state.node.mass, Field(state.node.size(), 1.0)),
                 heat = sum_of_products(state.node.heat_capacity, state.node.temperature);
    const EnergyLedger before = solver.ledger();
    const auto nodes = state.node.size();
    double scale = 0.0;
    for (std::size_t i = 0; i < nodes; ++i)
      scale += state.node.mass[i] * std::hypot(state.node.velocity[0][i], state.node.velocity[1][i]);
    solver.prepare(resampled(solver, factor));
    EXPECT_NE(solver.state().node.size(), nodes);
    EXPECT_NEAR(sum_of_products(state.node.mass, Field(state.node.size(), 1.0)), mass, 1e-12 * mass);
    EXPECT_NEAR((momenta(solver).linear - momentum.linear).norm(), 0.0, 1e-12 * scale);
    EXPECT_NEAR(sum_of_products(state.node.heat_capacity, state.node.temperature), heat, 1e-12 * heat);
    const EnergyLedger after = solver.ledger();
    EXPECT_NEAR(after.residual(), before.residual(), 1e-11 * after.total());
    EXPECT_NEAR(after.heat_residual(), before.heat_residual(), 1e-11 * heat);
    EXPECT_NEAR(after["plastic"], before["plastic"], 1e-12 * after["plastic"]);
    for (int n = 0; n < 20; ++n) solver.advance(solver.stable_step().dt);
  }
}

TEST(Audit, heat_is_kept_where_specific_heat_changes_with_it) {
  plasticity::Material material = steel_304L();
  material.heat_curves.at = {.value = {280.0, 320.0, 500.0}, .size = 3};
  material.heat_curves.specific_heat = {.value = {1.0, 2.0, 1.5}, .size = 3};
  material.heat_curves.complete();
  ExplicitSolver<2> solver = deformed_block(150, material);
  const auto heat = [&] {
    double sum = 0.0;
    const NodeState<2>& node = solver.state().node;
    for (std::size_t i = 0; i < node.size(); ++i)
      sum += node.heat_capacity[i] * material.heat_curves.enthalpy(node.temperature[i]);
    return sum;
  };
  for (const double factor : {0.5, 2.0}) {
    const double before = heat();
    solver.prepare(resampled(solver, factor));
    EXPECT_NEAR(heat(), before, 1e-13 * before);
    const EnergyLedger ledger = solver.ledger();
    EXPECT_GT(ledger["heat_content"], 0.0);
    EXPECT_NEAR(ledger.heat_residual(), 0.0, 1e-12 * before);
    for (int n = 0; n < 20; ++n) solver.advance(solver.stable_step().dt);
  }
}

TEST(Audit, stresses_of_mixed_points_do_not_exceed_the_yield_stress) {
  ExplicitSolver<2> solver = deformed_block(150);
  const Resampling<2> change = resampled(solver, 0.5);
  solver.prepare(change);
  const PointState<2>& point = solver.state().point;
  const plasticity::Hardening& law = *solver.model().materials[0].hardening;
  int mixed = 0;
  for (std::size_t p = 0; p < point.size(); ++p) {
    if (change.parcels.begin[p + 1] - change.parcels.begin[p] < 2) continue;
    ++mixed;
    EXPECT_LE(point.equivalent_stress[p],
              law.flow_stress(point.plastic_strain[p], point.plastic_rate[p], point.temperature[p]) *
                  (1 + 1e-9));
  }
  EXPECT_GT(mixed, 50);
}

TEST(Audit, damage_goes_with_the_mass_and_limits_mixed_stresses) {
  plasticity::Material material = steel_304L();
  plasticity::Damage& damage = material.damage.emplace();
  damage.law = plasticity::JohnsonCookDamage{.D1 = 0.005};
  damage.fracture_energy = 1e3;
  ExplicitSolver<2> solver = deformed_block(150, material);
  for (const double factor : {0.5, 2.0}) {
    const State<2>& state = solver.state();
    const PointState<2>& point = state.point;
    const double damaged = sum_of_products(state.node.mass, point.damage),
                 soft = sum_of_products(state.node.mass, point.softening);
    const Field old_damage = point.damage, old_softening = point.softening,
                old_initiation = point.initiation_strain;
    const EnergyLedger before = solver.ledger();
    EXPECT_GT(before["damage"], 0.0);
    const Resampling<2> change = resampled(solver, factor);
    solver.prepare(change);
    ASSERT_EQ(point.softening.size(), state.node.size());
    EXPECT_NEAR(sum_of_products(state.node.mass, point.damage), damaged, 1e-12 * damaged);
    EXPECT_NEAR(sum_of_products(state.node.mass, point.softening), soft, 1e-12 * soft);
    EXPECT_NEAR(solver.ledger().residual(), before.residual(), 1e-11 * before.total());
    int all_soften = 0, mean_softens = 0, sound = 0, limited = 0;
    for (std::size_t p = 0; p < point.size(); ++p) {
      const auto first = change.parcels.from.begin() + change.parcels.begin[p],
                 last = change.parcels.from.begin() + change.parcels.begin[p + 1];
      if (last - first < 2) continue;
      const auto all = [&](const auto& of_node) {
        return std::all_of(first, last, [&](NodeIndex i) { return of_node(std::size_t(i)); });
      };
      if (all([&](std::size_t i) { return old_damage[i] == 1.0; })) {
        EXPECT_EQ(point.damage[p], 1.0) << "to the bit: else it would initiate again";
      }
      const bool softens = point.damage[p] + point.softening[p] >= 1.0;
      if (all([&](std::size_t i) { return old_damage[i] + old_softening[i] >= 1.0; })) {
        ++all_soften;
        EXPECT_TRUE(softens);
        double least = 1.0;
        for (auto i = first; i != last; ++i) least = std::min(least, old_initiation[std::size_t(*i)]);
        EXPECT_GE(point.initiation_strain[p], (1.0 - 1e-14) * least);
        EXPECT_GT(least, 0.0);
      } else if (softens) {
        ++mean_softens;
        EXPECT_GT(point.initiation_strain[p], 0.0); // sound matter counts as 0 in its mean
      } else {
        ++sound;
        EXPECT_EQ(point.initiation_strain[p], 0.0);
      }
      if (point.softening[p] == 0.0) continue;
      ++limited;
      const double flow = material.hardening->flow_stress(point.plastic_strain[p], point.plastic_rate[p],
                                                          point.temperature[p]);
      EXPECT_LE(point.equivalent_stress[p], (1.0 - point.softening[p] + 1e-9) * flow);
    }
    EXPECT_GT(all_soften, 10);
    EXPECT_GT(mean_softens, 10);
    EXPECT_GT(sound, 10);
    EXPECT_GT(limited, 20);
    for (int n = 0; n < 20; ++n) solver.advance(solver.stable_step().dt);
    EXPECT_LE(*std::max_element(point.softening.begin(), point.softening.end()), 1.0);
  }
}

// The gap of a broken point is volume without stress: spread over sound matter it must not become tension.
TEST(Audit, mixing_broken_with_sound_points_creates_no_tension) {
  plasticity::Material material = steel_304L();
  material.hardening = plasticity::JohnsonCook{.A = 5e8};
  plasticity::Damage& damage = material.damage.emplace();
  damage.law = plasticity::JohnsonCookDamage{.D1 = 1e-3};
  damage.fracture_energy = 1.0;
  Cloud<2> cloud = rectangle(1e-3, 1e-3, 1e-4, Lattice::hexagonal, 0.2);
  Problem<2> model = model_of(cloud, Method::cnem, material);
  model.strength.assign(cloud.position.size(), 1.0);
  for (std::size_t i = 0; i < cloud.position.size(); ++i) // the upper half stays elastic
    if (cloud.position[i].y() > 5e-4) model.strength[i] = 1e3;
  ExplicitSolver<2> solver = start(std::move(model), [](const Vec2& x) -> Vec2 { return 2e5 * x; });
  while (solver.state().time < 2e-7) solver.advance(solver.stable_step().dt);

  const PointState<2>& point = solver.state().point;
  Field held(point.size()); // (1 − ω)⟨θ⟩² κ²
  Field expanded(point.size());
  for (std::size_t p = 0; p < held.size(); ++p)
    expanded[p] = jacobian<2>(point.deformation, p) / point.stress_free[p];
  for (std::size_t p = 0; p < held.size(); ++p)
    if (point.softening[p] < 1.0 && point.pressure[p] < 0.0)
      held[p] = point.pressure[p] * point.pressure[p] / (1.0 - point.softening[p]);
  const Field mass = solver.state().node.mass, softening = point.softening;
  const EnergyLedger before = solver.ledger();
  const Resampling<2> change = resampled(solver, 0.5);
  carry_mean(change.parcels, mass, held);
  carry_mean(change.parcels, mass, expanded);
  solver.prepare(change);
  EXPECT_NEAR(solver.ledger().residual(), before.residual(), 1e-11 * before.total());
  int torn = 0, in_tension = 0;
  for (std::size_t p = 0; p < point.size(); ++p) {
    if (!change.mixed(p) || point.softening[p] == 1.0 || point.softening[p] == 0.0) continue;
    ++torn;
    EXPECT_NEAR(1.0 / point.stress_free[p], expanded[p], 1e-9) << "volumes add";
    if (point.pressure[p] >= 0.0) continue;
    ++in_tension;
    EXPECT_LE(point.pressure[p] * point.pressure[p] / (1.0 - point.softening[p]),
              held[p] * (1.0 + 1e-9) + 1.0); // Pa²
  }
  EXPECT_GT(torn, 5);
  EXPECT_GT(in_tension, 5);
}

// The patch test of a change: a body in uniform stress is in the same uniform stress afterwards.
TEST(Audit, a_uniform_state_stays_uniform) {
  Cloud<2> cloud = rectangle(1e-3, 1e-3, 1e-4, Lattice::hexagonal, 0.2);
  const Mat2 F = (Mat2() << 1.002, 0.001, -0.0005, 0.998).finished();
  std::vector<Support<2>> supports;
  const double time = 1e-7;
  for (const NodeIndex i : cloud.position.indices()) {
    const Vec2 u = (F - Mat2::Identity()) * cloud.position[static_cast<std::size_t>(i)];
    for (int k = 0; k < 2; ++k)
      supports.push_back({k == 0 ? "x" : "y",
                          Support<2>::Kind::velocity,
                          k == 0 ? Vec2(1, 0) : Vec2(0, 1),
                          TimeTable(u[k] / time),
                          {i},
                          {}});
  }
  Problem<2> model = model_of(cloud, Method::cnem, steel());
  model.supports = Supports<2>(std::move(supports), static_cast<std::size_t>(cloud.nodes()));
  model.viscosity = {};
  ExplicitSolver<2> solver =
      start(std::move(model), [&](const Vec2& x) -> Vec2 { return (F - Mat2::Identity()) * x / time; });
  for (int n = 0; n < 20; ++n) solver.advance(time / 20);
  const double stress = solver.state().point.equivalent_stress[0],
               pressure = solver.state().point.pressure[0];
  solver.prepare(resampled(solver, 0.5));
  const State<2>& state = solver.state();
  for (std::size_t p = 0; p < state.point.size(); ++p) {
    EXPECT_NEAR(state.point.equivalent_stress[p], stress, 1e-9 * stress);
    EXPECT_NEAR(state.point.pressure[p], pressure, 1e-9 * stress);
  }
  std::vector<char> boundary(state.node.size(), 0);
  for (const Facet<2>& facet : solver.conditions().cloud.facets)
    for (const NodeIndex i : facet.node) boundary[static_cast<std::size_t>(i)] = 1;
  for (std::size_t i = 0; i < state.node.size(); ++i) {
    if (boundary[i]) continue;
    EXPECT_NEAR(std::hypot(state.node.force[0][i], state.node.force[1][i]), 0.0, 1e-9 * stress * 1e-4);
  }
}

// Conditions hold what is new on their pieces.
TEST(Audit, supports_and_loads_follow_the_boundary) {
  Cloud<2> cloud = rectangle(1e-3, 1e-3, 1e-4, Lattice::hexagonal, 0.1);
  Problem<2> model = model_of(cloud, Method::cnem, steel());
  model.supports = Supports<2>(
      {{"left", Support<2>::Kind::symmetry, Vec2(-1, 0), {}, nodes_on(cloud, 3_piece), {3_piece}}},
      static_cast<std::size_t>(cloud.nodes()));
  std::vector<Facet<2>> right;
  for (const Facet<2>& facet : cloud.facets)
    if (facet.piece == 1_piece) right.push_back(facet);
  model.loads = Loads<2>({{"pull", {TimeTable(1e6), TimeTable()}, right}}, {}, {}, cloud.position);
  ExplicitSolver<2> solver = start(std::move(model), [](const Vec2&) -> Vec2 { return {0, 0}; });
  for (int n = 0; n < 3; ++n) solver.advance(solver.stable_step().dt);
  const std::size_t held = solver.conditions().supports.constraints().size();
  solver.prepare(resampled(solver, 0.4));
  EXPECT_GT(solver.conditions().supports.constraints().size(), held);
  for (const auto& constraint : solver.conditions().supports.constraints())
    EXPECT_NEAR(solver.state().node.position[0][static_cast<std::size_t>(constraint.node)], 0.0, 1e-15);
  double pull = 0.0;
  for (const double f : solver.conditions().loads.force()[0]) pull += f;
  EXPECT_NEAR(pull, 1e6 * 1e-3, 1e-9 * 1e3);
}

} // namespace
} // namespace cnem::testing
