// Linear tetrahedra under the same solver, loads, heat and contact as in the plane.
#include "clouds/tetrahedral_block.hpp"
#include "contact/plane_shape.hpp"
#include "core/error.hpp"
#include "core/geometry/facets.hpp"
#include "mechanics/explicit_solver.hpp"
#include "methods/fe_simplices.hpp"
#include "plasticity/hardening_laws.hpp"
#include "tests/index_literals.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <gtest/gtest.h>
#include <omp.h>
#include <random>

namespace cnem::testing {

using namespace literals;

namespace {

using Vec3 = Vec<3>;
using clouds::TetrahedralBlock;

/// A block of 3 × 2 × 4 boxes whose inner nodes are moved at random.
TetrahedralBlock jittered(double jitter = 0.15) {
  std::mt19937 random(7);
  const Vec3 size(3e-3, 2e-3, 4e-3);
  return clouds::tetrahedral_block(size, {3, 2, 4}, [&](const Vec3& x) {
    Vec3 moved = x;
    for (int k = 0; k < 3; ++k) {
      const double step = jitter * 1e-3 * (2.0 * double(random() % 1000) / 999.0 - 1.0);
      if (x[k] > 0.0 && x[k] < size[k]) moved[k] += step;
    }
    return moved;
  });
}

plasticity::Material steel() {
  plasticity::Material material;
  material.name = "steel";
  material.density = 7850.0;
  material.elasticity = {.young = 210e9, .poisson = 0.3};
  material.specific_heat = 460.0;
  material.conductivity = 50.0;
  return material;
}

Problem<3> problem_of(TetrahedralBlock block, plasticity::Material material) {
  Problem<3> problem;
  problem.method = std::make_unique<methods::FeTetrahedra>(std::move(block.tetrahedra));
  problem.supports = Supports<3>({}, block.cloud.position.size());
  problem.loads = Loads<3>({}, {}, {}, block.cloud.position);
  problem.cloud = std::move(block.cloud);
  problem.materials = {std::move(material)};
  problem.thermal = false;
  return problem;
}

ExplicitSolver<3> start(Problem<3> problem, const std::function<Vec3(const Vec3&)>& velocity) {
  Fields<3> v;
  resize_all(v, problem.cloud.position.size());
  for (std::size_t i = 0; i < v[0].size(); ++i)
    for (std::size_t k = 0; k < 3; ++k)
      v[k][i] = velocity(problem.cloud.position[i])[static_cast<Eigen::Index>(k)];
  Field temperature(v[0].size(), 296.0);
  return ExplicitSolver<3>(std::move(problem), std::move(v), std::move(temperature));
}

Vec3 at(const Fields<3>& field, std::size_t i) { return {field[0][i], field[1][i], field[2][i]}; }

struct Momenta {
  Vec3 linear = Vec3::Zero(), angular = Vec3::Zero();
};
Momenta momenta(const ExplicitSolver<3>& solver) {
  const NodeState<3>& node = solver.state().node;
  Momenta sum;
  for (std::size_t i = 0; i < node.size(); ++i) {
    const Vec3 mv = node.mass[i] * at(node.velocity, i);
    sum.linear += mv;
    sum.angular += at(node.position, i).cross(mv);
  }
  return sum;
}

/// Facets close the block, point outwards and are as large as its sides.
TEST(Tetrahedra, have_a_closed_boundary) {
  const TetrahedralBlock block = jittered();
  Vec3 closed = Vec3::Zero();
  double volume = 0.0;
  std::array<double, 6> area{};
  for (const Facet<3>& facet : block.cloud.facets) {
    const auto corner = corners_of<3>(facet, block.cloud.position);
    const Vec3 normal = area_normal<3>(corner);
    closed += normal;
    volume += (corner[0] + corner[1] + corner[2]).dot(normal) / 9.0;
    area[index_of(facet.piece)] += normal.norm();
    const auto shares = corner_areas<3>(Space::plane, corner);
    EXPECT_NEAR(shares[0] + shares[1] + shares[2], normal.norm(), 1e-20);
  }
  EXPECT_LT(closed.norm(), 1e-18);
  EXPECT_NEAR(volume, 24e-9, 1e-21);
  EXPECT_NEAR(area[0], 8e-6, 1e-17);
  EXPECT_NEAR(area[3], 12e-6, 1e-17);
  EXPECT_NEAR(area[5], 6e-6, 1e-17);
}

TEST(Tetrahedra, refuse_blocks_that_are_none) {
  EXPECT_THROW(clouds::tetrahedral_block({1.0, 1.0, 1.0}, {1, 0, 1}), GeometryError);
  EXPECT_THROW(clouds::tetrahedral_block({1.0, 0.0, 1.0}, {1, 1, 1}), GeometryError);
  EXPECT_THROW(clouds::tetrahedral_block({1.0, 1.0, 1.0}, {1, 1, 1},
                                         [](const Vec3& x) { return Vec3(x.x(), x.y(), 0.0); }),
               GeometryError);
  TetrahedralBlock block = jittered();
  std::swap(block.tetrahedra[5][0], block.tetrahedra[5][1]);
  EXPECT_THROW(methods::FeTetrahedra(block.tetrahedra).rebuild(block.cloud), GeometryError);
  std::swap(block.tetrahedra[5][0], block.tetrahedra[5][1]);
  EXPECT_NO_THROW(methods::FeTetrahedra(block.tetrahedra).rebuild(block.cloud));
  block.cloud.position.push_back({1e-3, 2e-3, 3e-3});
  try {
    methods::FeTetrahedra(block.tetrahedra).rebuild(block.cloud);
    FAIL() << "a node beside the mesh is taken";
  } catch (const GeometryError& error) {
    EXPECT_STREQ(error.what(), "the node at (0.001, 0.002, 0.003) m belongs to no tetrahedron");
  }
}

/// The patch test: all boundary nodes follow an affine motion, and so does everything within.
TEST(Tetrahedra, pass_the_patch_test_at_finite_strain) {
  Problem<3> problem = problem_of(jittered(), steel());
  Mat<3> rate;
  rate << 200.0, 150.0, -80.0, 90.0, -250.0, 60.0, -40.0, 110.0, 180.0;
  std::vector<bool> boundary(problem.cloud.position.size(), false);
  for (const Facet<3>& facet : problem.cloud.facets)
    for (const NodeIndex i : facet.node) boundary[static_cast<std::size_t>(i)] = true;
  std::vector<Support<3>> supports;
  for (std::size_t i = 0; i < boundary.size(); ++i)
    if (boundary[i])
      for (int k = 0; k < 3; ++k) {
        const double speed = (rate * problem.cloud.position[i])[k];
        supports.push_back({"boundary",
                            Support<3>::Kind::velocity,
                            Vec3::Unit(k),
                            TimeTable(speed),
                            {as<NodeIndex>(i)},
                            {}});
      }
  problem.supports = Supports<3>(std::move(supports), boundary.size());
  ExplicitSolver<3> solver = start(std::move(problem), [&](const Vec3& x) { return Vec3(rate * x); });
  const double dt = 0.9 * solver.stable_step().dt;
  constexpr int steps = 1200;
  for (int n = 0; n < steps; ++n) solver.advance(dt);
  const Mat<3> F = Mat<3>::Identity() + steps * dt * rate;
  EXPECT_GT((F - Mat<3>::Identity()).norm(), 0.02);
  const State<3>& state = solver.state();
  for (std::size_t i = 0; i < state.node.size(); ++i)
    EXPECT_LT((at(state.node.position, i) - F * at(state.node.initial_position, i)).norm(), 1e-12 * 4e-3)
        << i;
  for (std::size_t c = 0; c < 9; ++c)
    for (std::size_t p = 1; p < state.point.size(); ++p)
      EXPECT_NEAR(state.point.piola[c][p], state.point.piola[c][0], 1e-9 * 210e9) << c;
  EXPECT_LT(std::abs(solver.ledger().residual()), 1e-6 * solver.ledger().external());
}

TEST(Tetrahedra, conserve_momentum_and_energy_in_plastic_flow) {
  plasticity::Material soft = steel();
  soft.hardening = plasticity::JohnsonCook{.A = 200e6, .B = 500e6};
  ExplicitSolver<3> solver = start(problem_of(jittered(), soft), [](const Vec3& x) -> Vec3 {
    return {40.0 * std::sin(900.0 * x.y()), -50.0 * std::sin(700.0 * x.z()), 30.0 * std::cos(800.0 * x.x())};
  });
  const Momenta before = momenta(solver);
  const double initial = solver.ledger().total();
  for (int n = 0; n < 500; ++n) {
    const double dt = 0.9 * solver.stable_step().dt;
    solver.advance(dt);
  }
  const Momenta after = momenta(solver);
  EXPECT_LT((after.linear - before.linear).norm(), 1e-12 * before.linear.norm());
  EXPECT_LT((after.angular - before.angular).norm(), 1e-11 * before.linear.norm() * 1e-3);
  EXPECT_GT(solver.ledger()["plastic"], 0.05 * initial);
  EXPECT_LT(std::abs(solver.ledger().residual()), 2e-3 * initial);
}

/// Layers from 0.03 to 0.6 mm.
TEST(Tetrahedra, are_refused_a_new_reference_by_the_promise) {
  ExplicitSolver<3> solver = start(problem_of(jittered(), steel()), [](const Vec3&) -> Vec3 {
    return {0, 0, 0};
  });
  try {
    solver.prepare();
    FAIL() << "their mesh has no better ones";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("'history that is carried to new points'"), std::string::npos)
        << error.what();
  }
}

TEST(Tetrahedra, take_local_time_steps) {
  plasticity::Material soft = steel();
  soft.hardening = plasticity::JohnsonCook{.A = 200e6, .B = 500e6};
  const auto run = [&](bool local) {
    const auto grade = [](const Vec3& x) -> Vec3 {
      const double s = x.z() / 4e-3;
      return {x.x(), x.y(), 4e-3 * (0.1 * s + 0.9 * s * s)};
    };
    Problem<3> problem = problem_of(clouds::tetrahedral_block({3e-3, 3e-3, 4e-3}, {5, 5, 14}, grade), soft);
    problem.local = {.on = local, .least_gain = 0.0};
    ExplicitSolver<3> solver = start(std::move(problem), [](const Vec3& x) -> Vec3 {
      return {40.0 * std::sin(900.0 * x.y()), -50.0 * std::sin(700.0 * x.z()),
              30.0 * std::cos(800.0 * x.x())};
    });
    const Momenta before = momenta(solver);
    const double initial = solver.ledger().total(), end = 1e-6;
    while (solver.state().time < end * (1.0 - 1e-9)) {
      const double left = end - solver.state().time;
      solver.advance(left / std::ceil(left / solver.stable_step().dt));
    }
    EXPECT_EQ(solver.sub_steps() > 1, local);
    const Momenta after = momenta(solver);
    EXPECT_LT((after.linear - before.linear).norm(), 1e-12 * before.linear.norm());
    EXPECT_LT((after.angular - before.angular).norm(), 1e-11 * before.linear.norm() * 1e-3);
    EXPECT_LT(std::abs(solver.ledger().residual()), 2e-3 * initial);
    return solver.ledger();
  };
  const EnergyLedger global = run(false), local = run(true);
  EXPECT_GT(global["plastic"], 0.05 * global.total());
  EXPECT_NEAR(local["plastic"], global["plastic"], 0.01 * global["plastic"]);
  EXPECT_NEAR(local["kinetic"], global["kinetic"], 0.01 * global["kinetic"]);
}

TEST(Tetrahedra, results_do_not_depend_on_threads) {
  std::vector<Field> seen;
  for (const int threads : {1, 2, 3}) {
    omp_set_num_threads(threads);
    ExplicitSolver<3> solver =
        start(problem_of(clouds::tetrahedral_block({4e-3, 4e-3, 4e-3}, {9, 9, 9}), steel()),
              [](const Vec3& x) -> Vec3 {
                return {0.0, 0.0, -1e4 * x.z()};
              });
    for (int n = 0; n < 20; ++n) solver.advance(0.9 * solver.stable_step().dt);
    Field all = solver.state().node.position[2];
    all.push_back(solver.ledger().residual());
    seen.push_back(std::move(all));
  }
  omp_set_num_threads(2);
  EXPECT_EQ(seen[0], seen[1]);
  EXPECT_EQ(seen[0], seen[2]);
}

/// Pressure on all sides of a block balances itself and presses it together as much as elasticity says.
TEST(Tetrahedra, take_pressure_on_their_facets) {
  TetrahedralBlock block = jittered();
  Problem<3> problem = problem_of(block, steel());
  problem.loads = Loads<3>({}, {{"all", TimeTable(1e8), block.cloud.facets}}, {}, block.cloud.position);
  Fields<3> position;
  resize_all(position, block.cloud.position.size());
  for (std::size_t i = 0; i < block.cloud.position.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k)
      position[k][i] = block.cloud.position[i][static_cast<Eigen::Index>(k)];
  problem.loads.evaluate(0.0, position, Field(position[0].size(), 0.0));
  Vec3 sum = Vec3::Zero(), moment = Vec3::Zero();
  double up = 0.0;
  for (std::size_t i = 0; i < position[0].size(); ++i) {
    const Vec3 f = at(problem.loads.force(), i);
    sum += f;
    moment += at(position, i).cross(f);
    if (position[2][i] == 0.0) up += f.z();
  }
  EXPECT_LT(sum.norm(), 1e-12 * 1e8 * 12e-6);
  EXPECT_LT(moment.norm(), 1e-12 * 1e8 * 12e-6 * 4e-3);
  EXPECT_NEAR(up, 1e8 * 6e-6, 1e-9 * 600.0);
}

/// A heated side: what flows in is what the block holds.
TEST(Tetrahedra, conduct_heat_and_balance_it) {
  TetrahedralBlock block = jittered();
  Problem<3> problem = problem_of(block, steel());
  problem.thermal = true;
  problem.mechanical = false;
  std::vector<Facet<3>> top;
  for (const Facet<3>& facet : block.cloud.facets)
    if (facet.piece == 5_piece) top.push_back(facet);
  problem.heat_boundaries = ThermalBoundaries<3>({}, {{"top", TimeTable(1e6), top}}, {});
  ExplicitSolver<3> solver = start(std::move(problem), [](const Vec3&) { return Vec3::Zero(); });
  while (solver.state().time < 1.0) solver.advance(solver.stable_step().dt);
  const double heat = 1e6 * 6e-6 * solver.state().time;
  EXPECT_NEAR(solver.ledger()["heat_content"], heat, 1e-9 * heat);
  EXPECT_NEAR(solver.ledger()["heat_exchanged"], heat, 1e-9 * heat);
  // quasi-steady: the gradient at the heated side is q/k and falls to nothing on the other one
  double low = 0.0, high = 0.0, low_weight = 0.0, high_weight = 0.0;
  const NodeState<3>& node = solver.state().node;
  for (std::size_t i = 0; i < node.size(); ++i) {
    const double weight = node.heat_capacity[i];
    if (node.position[2][i] == 0.0) low += weight * node.temperature[i], low_weight += weight;
    if (node.position[2][i] == 4e-3) high += weight * node.temperature[i], high_weight += weight;
  }
  EXPECT_NEAR(high / high_weight - low / low_weight, 1e6 * 4e-3 / (2.0 * 50.0), 0.01 * 40.0);
}

/// A block that hits a wall leaves it again: impulses balance, no node is left inside.
TEST(Plane, may_have_a_normal_of_any_length) {
  for (const double length : {1e-200, 1.0, 1e200}) {
    const contact::PlaneShape<3> plane(Vec3::Zero(), Vec3(0.0, 0.6 * length, 0.8 * length), 1.0);
    EXPECT_NEAR(plane.closest(Vec3(0.0, 0.0, 1.0)).distance, 0.8, 1e-15) << length;
  }
}

TEST(Tetrahedra, bounce_off_a_plane) {
  Problem<3> problem = problem_of(jittered(), steel());
  contact::Tool<3> wall;
  wall.name = "wall";
  wall.shape = std::make_shared<contact::PlaneShape<3>>(Vec3(0.0, 0.0, -1e-5), Vec3(0.0, 0.0, 2.0), 0.1);
  wall.friction = contact::Coulomb{0.1};
  problem.contact = contact::RigidContact<3>({wall});
  ExplicitSolver<3> solver = start(std::move(problem), [](const Vec3&) -> Vec3 { return {3.0, 0.0, -10.0}; });
  const Momenta before = momenta(solver);
  double peak = 0.0;
  while (solver.state().time < 6e-6) {
    solver.advance(0.9 * solver.stable_step().dt);
    peak = std::max(peak, solver.conditions().contact.results()[0].force.z());
    for (std::size_t i = 0; i < solver.state().node.size(); ++i)
      ASSERT_GT(solver.state().node.position[2][i], -1e-5 - 1e-12);
  }
  const Momenta after = momenta(solver);
  const contact::ToolResult<3>& result = solver.conditions().contact.results()[0];
  EXPECT_GT(peak, 1e3);
  EXPECT_LT((after.linear - before.linear - result.impulse).norm(), 1e-12 * before.linear.norm());
  EXPECT_GT(after.linear.z(), 0.5 * std::abs(before.linear.z()));
  EXPECT_LT(after.linear.x(), before.linear.x());
  EXPECT_LT(std::abs(solver.ledger().residual()), 1e-2 * solver.ledger().initial());
}

} // namespace
} // namespace cnem::testing
