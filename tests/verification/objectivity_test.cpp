// Nothing in space depends on how a body stands to the axes, nor on how far it has turned.
#include "clouds/tetrahedral_block.hpp"
#include "core/fields/vector_at.hpp"
#include "mechanics/explicit_solver.hpp"
#include "mechanics/statics/statics.hpp"
#include "methods/registry.hpp"
#include "tests/unit/mechanics/models.hpp"
#include "voronoi/space/recovery.hpp"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace cnem::testing {
namespace {

using clouds::TetrahedralBlock;

/// 4 × 3 × 2 mm, nodes off their lattice, on faces along these: no four on a circle.
TetrahedralBlock block() {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> step(-0.2e-3, 0.2e-3);
  const Vec<3> size(4e-3, 3e-3, 2e-3);
  return clouds::tetrahedral_block(size, {4, 3, 2}, [&](const Vec<3>& x) -> Vec<3> {
    Vec<3> moved = x;
    for (Eigen::Index k = 0; k < 3; ++k)
      if (const double by = step(random); x[k] > 1e-9 && x[k] < size[k] - 1e-9) moved[k] += by;
    return moved;
  });
}

const Mat<3> arbitrary = Eigen::AngleAxisd(1.1, Vec<3>(1.0, -2.0, 0.7).normalized()).toRotationMatrix();

plasticity::Material metal() {
  plasticity::Material material;
  material.name = "metal";
  material.density = 7850.0;
  material.elasticity = {210e9, 0.3};
  return material;
}

Problem<3> problem_of(const TetrahedralBlock& of, std::vector<Support<3>> held,
                      std::vector<Traction<3>> pulled) {
  Problem<3> model;
  model.method = methods::make<3>("cnem", {.tetrahedra = of.tetrahedra});
  model.cloud = of.cloud;
  model.supports = Supports<3>(std::move(held), of.cloud.position.size());
  model.loads = Loads<3>(std::move(pulled), {}, {}, model.cloud.position);
  model.materials = {metal()};
  model.thermal = false;
  return model;
}

/// The block turned by `rotation`, held on one face in the turned axes, and pulled obliquely on the opposite
/// one.
struct Loaded {
  TetrahedralBlock body = block();
  std::vector<Support<3>> held;
  std::vector<Traction<3>> pulled;

  Loaded(const Mat<3>& rotation, double pull, scni::CellKind cells = scni::CellKind::median) {
    if (cells == scni::CellKind::voronoi) body.cloud = voronoi::recover_boundary(body.cloud).cloud;
    std::vector<NodeIndex> left;
    std::vector<Facet<3>> right;
    for (const NodeIndex i : body.cloud.position.indices())
      if (body.cloud.position[i].x() == 0.0) left.push_back(i);
    for (const Facet<3>& facet : body.cloud.facets)
      if (std::all_of(facet.node.begin(), facet.node.end(),
                      [&](NodeIndex i) { return body.cloud.position[i].x() > 4e-3 - 1e-9; }))
        right.push_back(facet);
    for (Eigen::Index k = 0; k < 3; ++k)
      held.push_back({"left", Support<3>::Kind::symmetry, rotation.col(k), {}, left, {}});
    const Vec<3> traction = pull * rotation * Vec<3>(1.0, 0.5, -0.3);
    pulled.push_back(
        {"right", {TimeTable(traction.x()), TimeTable(traction.y()), TimeTable(traction.z())}, right});
    for (Vec<3>& x : body.cloud.position) x = rotation * x;
  }
};

/// Largest distance of the vectors from the turned ones of `from`, over the largest of them.
double difference(const Fields<3>& of, const Fields<3>& from, const Mat<3>& rotation) {
  double most = 0.0, scale = 0.0;
  for (std::size_t i = 0; i < of[0].size(); ++i) {
    const Vec<3> wanted = rotation * vector_at<3>(from, i);
    most = std::max(most, (vector_at<3>(of, i) - wanted).norm());
    scale = std::max(scale, wanted.norm());
  }
  return most / scale;
}

class Equilibrium : public ::testing::TestWithParam<scni::CellKind> {};

TEST_P(Equilibrium, of_a_turned_block_is_the_turned_one) {
  const auto solve = [](const Mat<3>& rotation) {
    const Loaded loaded(rotation, 1e8, GetParam());
    Problem<3> model = problem_of(loaded.body, loaded.held, loaded.pulled);
    if (GetParam() == scni::CellKind::voronoi)
      model.method = methods::make<3>("cnem", {.functions = scni::Functions::laplace, .cells = GetParam()});
    const Approximation<3> approximation = model.method->rebuild(model.cloud);
    Fields<3> position;
    resize_all(position, model.cloud.position.size());
    for (std::size_t i = 0; i < position[0].size(); ++i)
      for (std::size_t k = 0; k < 3; ++k)
        position[k][i] = model.cloud.position[i][static_cast<Eigen::Index>(k)];
    model.loads.evaluate(1.0, position, approximation.mechanics.node_volume());
    return solve_statics<3>({.operators = approximation.mechanics,
                             .position = model.cloud.position,
                             .links = approximation.links,
                             .link_points = approximation.mechanics,
                             .elasticity = metal().elasticity,
                             .supports = model.supports,
                             .force = model.loads.force()});
  };
  const StaticSolution<3> straight = solve(Mat<3>::Identity()), turned = solve(arbitrary);
  EXPECT_LT(difference(turned.displacement, straight.displacement, arbitrary), 1e-9);
  EXPECT_LT(difference(turned.reaction, straight.reaction, arbitrary), 1e-9);
  EXPECT_NEAR(turned.strain_energy, straight.strain_energy, 1e-9 * straight.strain_energy);
}

INSTANTIATE_TEST_SUITE_P(cells, Equilibrium,
                         ::testing::Values(scni::CellKind::median, scni::CellKind::voronoi),
                         [](const auto& run) {
                           return run.param == scni::CellKind::median ? "median" : "voronoi";
                         });

// Metal that flows, on new references.
TEST(Objectivity, steps_of_a_turned_block_are_the_turned_ones) {
  const auto advance = [](const Mat<3>& rotation) {
    const Loaded loaded(rotation, 8e8);
    Problem<3> model = problem_of(loaded.body, loaded.held, loaded.pulled);
    model.materials.front().hardening = steel_304L().hardening;
    Fields<3> velocity;
    resize_all(velocity, model.cloud.position.size());
    auto solver = std::make_unique<ExplicitSolver<3>>(std::move(model), std::move(velocity),
                                                      Field(loaded.body.cloud.position.size(), 296.0));
    for (int n = 0; n < 200; ++n) {
      solver->advance(5e-8);
      if (n % 80 == 79) solver->prepare();
    }
    return solver;
  };
  const auto straight = advance(Mat<3>::Identity()), turned = advance(arbitrary);
  EXPECT_LT(difference(turned->state().node.position, straight->state().node.position, arbitrary), 1e-9);
  EXPECT_LT(difference(turned->state().node.velocity, straight->state().node.velocity, arbitrary), 1e-9);
  const Field &a = turned->state().point.plastic_strain, &b = straight->state().point.plastic_strain;
  EXPECT_GT(*std::max_element(b.begin(), b.end()), 0.02);
  for (std::size_t p = 0; p < a.size(); ++p) EXPECT_NEAR(a[p], b[p], 1e-9);
}

// All nodes are led round an oblique axis; four new references on the way.
TEST(Objectivity, a_whole_turn_leaves_no_stress) {
  const TetrahedralBlock body = block();
  constexpr int steps = 120;
  const Vec<3> axis = Vec<3>(1.0, -2.0, 0.7).normalized(), centre(1e-3, 2e-3, 1e-3);
  std::vector<double> times;
  for (int n = 0; n <= steps; ++n) times.push_back(n * 0x1p-24);
  std::vector<Support<3>> led;
  for (const NodeIndex i : body.cloud.position.indices())
    for (Eigen::Index k = 0; k < 3; ++k) {
      std::vector<double> way;
      for (int n = 0; n <= steps; ++n) {
        const Vec<3> arm = body.cloud.position[i] - centre;
        way.push_back((Eigen::AngleAxisd(2.0 * std::numbers::pi * n / steps, axis) * arm - arm)[k]);
      }
      led.push_back({"led", Support<3>::Kind::displacement, Vec<3>::Unit(k), TimeTable(times, way), {i}, {}});
    }
  Fields<3> velocity;
  resize_all(velocity, body.cloud.position.size());
  ExplicitSolver<3> solver(problem_of(body, std::move(led), {}), std::move(velocity),
                           Field(body.cloud.position.size(), 296.0));
  for (int n = 0; n < steps; ++n) {
    solver.advance(0x1p-24);
    if (n % 25 == 24) solver.prepare();
    const PointState<3>& point = solver.state().point;
    for (const Field& component : point.piola)
      for (const double stress : component) ASSERT_LT(std::abs(stress), 1e-10 * 210e9) << "step " << n;
  }
  EXPECT_LT(
      difference(solver.state().node.position, solver.state().node.initial_position, Mat<3>::Identity()),
      1e-12);
}

} // namespace
} // namespace cnem::testing
