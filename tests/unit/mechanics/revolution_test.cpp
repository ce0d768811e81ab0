// Bodies of revolution: patch tests, Lamé's solutions, waves and vibrations, the bound on the step.
#include "tests/unit/mechanics/linear.hpp"

#include <Eigen/Cholesky>
#include <gtest/gtest.h>
#include <numbers>

namespace cnem::testing {
namespace {

class Revolution : public ::testing::TestWithParam<Method> {};

Cloud<2> moved(Cloud<2> cloud, double radius) {
  for (Vec2& x : cloud.position) x.x() += radius;
  return cloud;
}

Problem<2> solid(Cloud<2> cloud, Method method, plasticity::Material material) {
  Problem<2> model = model_of(std::move(cloud), method, std::move(material));
  model.method = make(method, Space::revolution);
  return model;
}

Support<2> held_axis(const Cloud<2>& cloud) {
  Support<2> axis{"axis", Support<2>::Kind::symmetry, Vec2(1, 0), {}, {}};
  for (const NodeIndex i : cloud.position.indices())
    if (cloud.position[static_cast<std::size_t>(i)].x() == 0.0) axis.nodes.push_back(i);
  return axis;
}

/// The boundary follows r = (1 + a) R, z = (1 + b) Z; the interior starts with the matching velocity.
ExplicitSolver<2> stretched(Method method, double radius, double a, double b, double end,
                            plasticity::Material material) {
  const Cloud<2> cloud = moved(rectangle(1e-2, 0.8e-2, 1e-3, Lattice::hexagonal, 0.2), radius);
  std::vector<Support<2>> supports;
  for (const NodeIndex i : IndexRange<NodeIndex>(cloud.facets.size())) {
    const Vec2& x = cloud.position[static_cast<std::size_t>(i)];
    supports.push_back({"side", Support<2>::Kind::velocity, Vec2(1, 0), TimeTable(a * x.x() / end), {i}});
    supports.push_back({"side", Support<2>::Kind::velocity, Vec2(0, 1), TimeTable(b * x.y() / end), {i}});
  }
  Problem<2> model = solid(cloud, method, std::move(material));
  model.supports = Supports<2>(std::move(supports), static_cast<std::size_t>(cloud.nodes()));
  return start(std::move(model), [&](const Vec2& x) -> Vec2 { return {a * x.x() / end, b * x.y() / end}; });
}

void expect_stretched(const ExplicitSolver<2>& solver, double a, double b) {
  const State<2>& state = solver.state();
  for (std::size_t i = 0; i < state.node.size(); ++i) {
    EXPECT_NEAR(state.node.position[0][i], (1 + a) * solver.state().node.initial_position[0][i], 1e-12)
        << "node " << i;
    EXPECT_NEAR(state.node.position[1][i], (1 + b) * solver.state().node.initial_position[1][i], 1e-12)
        << "node " << i;
  }
  for (std::size_t p = 0; p < state.point.size(); ++p)
    EXPECT_NEAR(state.point.piola[0][p], state.point.piola[4][p], 1e-9 * 210e9) << "point " << p;
}

TEST_P(Revolution, patch_large_uniform_stretch_with_and_without_the_axis) {
  for (const double radius : {0.0, 0.5e-2}) {
    const double end = 2e-5;
    ExplicitSolver<2> solver = stretched(GetParam(), radius, 0.6, -0.4, end, steel());
    for (int n = 0; n < 400; ++n) solver.advance(end / 400);
    expect_stretched(solver, 0.6, -0.4);
    for (std::size_t p = 0; p < solver.state().point.size(); ++p)
      EXPECT_NEAR(solver.state().point.deformation[4][p], 1.6, 1e-12);
  }
}

TEST_P(Revolution, plastic_stretch_stays_uniform_through_new_references) {
  const double end = 2e-5;
  ExplicitSolver<2> solver = stretched(GetParam(), 0.0, 0.3, -0.4, end, steel_304L());
  for (int n = 0; n < 400; ++n) {
    if (n % 50 == 49) solver.prepare(); // the last one after 399 steps
    solver.advance(end / 400);
  }
  expect_stretched(solver, 0.3, -0.4);
  EXPECT_GT(solver.state().point.plastic_strain[0], 0.3);
  double volume = 0.0;
  for (const double v : solver.approximation().mechanics.volume) volume += v;
  const double stretch = 1.0 + 0.3 * 399.0 / 400.0, height = 1.0 - 0.4 * 399.0 / 400.0;
  EXPECT_NEAR(volume, std::numbers::pi * stretch * stretch * 1e-4 * height * 0.8e-2, 1e-17);
  EXPECT_EQ(solver.references(), 9);
}

TEST_P(Revolution, rigid_axial_motion_does_nothing) {
  const Cloud<2> cloud = rectangle(1e-2, 0.8e-2, 1e-3);
  ExplicitSolver<2> solver = start(solid(cloud, GetParam(), steel()), [](const Vec2&) -> Vec2 {
    return {0.0, 100.0};
  });
  for (int n = 0; n < 50; ++n) solver.advance(1e-8);
  for (std::size_t p = 0; p < solver.state().point.size(); ++p)
    EXPECT_LT(solver.state().point.equivalent_stress[p], 1e-9 * 210e9);
  double mass = 0.0;
  for (const double m : solver.state().node.mass) mass += m;
  EXPECT_NEAR(mass, 7850.0 * std::numbers::pi * 1e-4 * 0.8e-2, 1e-12);
  EXPECT_NEAR(solver.ledger()["kinetic"], 0.5 * mass * 1e4, 1e-9 * mass * 1e4);
}

/// Static displacements under a pressure of 1 Pa on the facets of `loaded`. Nodes in `held` [dof] do not
/// move.
Eigen::VectorXd statics(const Cloud<2>& cloud, Method method, const plasticity::Material& material,
                        const std::vector<Facet<2>>& loaded,
                        const std::function<bool(const Vec2&, int)>& held) {
  Approximation<2> approximation = make(method, Space::revolution)->rebuild(cloud);
  Linear linear = linearise(approximation, cloud, material, 0.05);
  Loads<2> loads({}, {{"p", TimeTable(1.0), loaded}}, {}, cloud.position, Space::revolution);
  const auto n = static_cast<std::size_t>(cloud.nodes());
  Fields<2> x;
  resize_all(x, n);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = 0; k < 2; ++k) x[k][i] = cloud.position[i][static_cast<Eigen::Index>(k)];
  loads.evaluate(0.0, x, Field(n, 1.0));
  Eigen::VectorXd f(2 * static_cast<Eigen::Index>(n));
  for (std::size_t i = 0; i < n; ++i)
    for (int k = 0; k < 2; ++k) {
      const auto dof = static_cast<Eigen::Index>(2 * i) + k;
      f[dof] = loads.force()[static_cast<std::size_t>(k)][i];
      if (!held(cloud.position[i], k)) continue;
      linear.stiffness.row(dof).setZero();
      linear.stiffness.col(dof).setZero();
      linear.stiffness(dof, dof) = material.elasticity.mu();
      f[dof] = 0.0;
    }
  return linear.stiffness.ldlt().solve(f);
}

TEST_P(Revolution, solid_bar_under_lateral_pressure_is_exact) {
  const double h = 0.125;
  const Cloud<2> cloud = rectangle(1.0, 1.0, h, Lattice::hexagonal, 0.2);
  std::vector<Facet<2>> side;
  for (const Facet<2>& facet : cloud.facets)
    if (facet.piece == 1_piece) side.push_back(facet);
  const plasticity::Material material = steel();
  const auto u = statics(cloud, GetParam(), material, side, [](const Vec2& x, int k) {
    return (k == 0 && x.x() == 0.0) || (k == 1 && x.y() == 0.0);
  });
  const double nu = 0.33, E = 210e9;
  for (std::size_t i = 0; i < cloud.position.size(); ++i) {
    EXPECT_NEAR(u[static_cast<Eigen::Index>(2 * i)] * E, -(1 - nu) * cloud.position[i].x(), 1e-9);
    EXPECT_NEAR(u[static_cast<Eigen::Index>(2 * i + 1)] * E, 2 * nu * cloud.position[i].y(), 1e-9);
  }
}

/// Relative L2 error of the displacement of nodes, weighted with their volumes.
double l2_error(const Cloud<2>& cloud, Method method, const Eigen::VectorXd& u,
                const std::function<Vec2(const Vec2&)>& exact) {
  const Field volume = make(method, Space::revolution)->rebuild(cloud).node_volume;
  double error = 0.0, norm = 0.0;
  for (std::size_t i = 0; i < volume.size(); ++i) {
    const Vec2 found(u[static_cast<Eigen::Index>(2 * i)], u[static_cast<Eigen::Index>(2 * i + 1)]);
    const Vec2 e = exact(cloud.position[i]);
    error += volume[i] * (found - e).squaredNorm();
    norm += volume[i] * e.squaredNorm();
  }
  return std::sqrt(error / norm);
}

/// Error of a tube, a = 1, b = 2, plane strain, under inner pressure.
double tube_error(Method method, double h) {
  const Cloud<2> cloud = moved(rectangle(1.0, 0.4, h, Lattice::hexagonal, 0.1), 1.0);
  std::vector<Facet<2>> inner;
  for (const Facet<2>& facet : cloud.facets)
    if (facet.piece == 3_piece) inner.push_back(facet);
  const plasticity::Material material = steel();
  const auto u = statics(cloud, method, material, inner,
                         [](const Vec2& x, int k) { return k == 1 && (x.y() == 0.0 || x.y() == 0.4); });
  const double G = material.elasticity.mu(), nu = 0.33, A = 1.0 / 3.0, B = 4.0 / 3.0;
  return l2_error(cloud, method, u, [&](const Vec2& x) -> Vec2 {
    return {(A * (1 - 2 * nu) * x.x() + B / x.x()) / (2 * G), 0.0};
  });
}

TEST_P(Revolution, thick_tube_follows_lame_with_second_order) {
  const double coarse = tube_error(GetParam(), 0.1), fine = tube_error(GetParam(), 0.05);
  EXPECT_LT(fine, 2e-3);
  EXPECT_GT(std::log2(coarse / fine), 1.8);
}

/// Error of a hollow sphere, a = 1, b = 2.
double sphere_error(Method method, double h) {
  Cloud<2> cloud;
  std::vector<Vec2> corners;
  const int outer = static_cast<int>(std::ceil(std::numbers::pi / h)), inner = (outer + 1) / 2;
  for (int k = 0; k <= outer; ++k) {
    const double t = 0.5 * std::numbers::pi * k / outer;
    corners.push_back(k == outer ? Vec2(0, 2) : Vec2(2 * std::cos(t), 2 * std::sin(t)));
  }
  for (int k = inner; k >= 0; --k) {
    const double t = 0.5 * std::numbers::pi * k / inner;
    corners.push_back(k == inner ? Vec2(0, 1) : Vec2(std::cos(t), std::sin(t)));
  }
  add_loop(cloud, corners, 1.2 * h);
  fill(cloud, Lattice::hexagonal, h, 0.1, 0.5 * h, 1);
  std::vector<Facet<2>> bore;
  for (const Facet<2>& facet : cloud.facets) {
    const Vec2 middle = 0.5 * (cloud.position[static_cast<std::size_t>(facet.node[0])] +
                               cloud.position[static_cast<std::size_t>(facet.node[1])]);
    if (middle.norm() < 1.001 && middle.x() > 1e-9 && middle.y() > 1e-9) bore.push_back(facet);
  }
  const plasticity::Material material = steel();
  const auto u =
      statics(cloud, method, material, bore, [](const Vec2& x, int k) { return std::abs(x[k]) < 1e-12; });
  // u = A r + B/r² with p = 1 at a = 1, none at b = 2
  const double G = material.elasticity.mu(), K = material.elasticity.lambda() + 2.0 * G / 3.0;
  const double A = 1.0 / 7.0 / (3 * K), B = 8.0 / 7.0 / (4 * G);
  return l2_error(cloud, method, u, [&](const Vec2& x) -> Vec2 {
    return (A * x.norm() + B / x.squaredNorm()) * x.normalized();
  });
}

TEST_P(Revolution, hollow_sphere_follows_lame_with_second_order) {
  const double coarse = sphere_error(GetParam(), 0.2), fine = sphere_error(GetParam(), 0.1);
  EXPECT_LT(fine, 0.015);
  EXPECT_GT(std::log2(coarse / fine), 1.8);
}

/// Time at which the sign of `measure` changes first, interpolated; velocities live half a step back.
template<class Measure> double first_zero(ExplicitSolver<2>& solver, double dt, Measure&& measure) {
  double before = measure(solver.state());
  for (int n = 0; n < 100000; ++n) {
    solver.advance(dt);
    const double now = measure(solver.state());
    if (n > 0 && now * before <= 0.0) return solver.state().time - 0.5 * dt - dt * now / (now - before);
    before = now;
  }
  return 0.0;
}

TEST_P(Revolution, thin_ring_breathes_at_the_speed_of_its_hoop) {
  // ω = √(E/ρ)/R for a ring whose section is small against R.
  const double R = 0.1, w = 2e-3;
  Cloud<2> cloud = moved(rectangle(w, w, 0.5e-3), R - 0.5 * w);
  Problem<2> model = solid(cloud, GetParam(), steel());
  model.viscosity = {0.0, 0.0};
  ExplicitSolver<2> solver = start(std::move(model), [](const Vec2&) -> Vec2 { return {1.0, 0.0}; });
  const double quarter = first_zero(solver, solver.stable_step().dt, [](const State<2>& s) {
    double p = 0.0;
    for (std::size_t i = 0; i < s.node.size(); ++i) p += s.node.mass[i] * s.node.velocity[0][i];
    return p;
  });
  const double omega = std::sqrt(210e9 / 7850.0) / R;
  EXPECT_NEAR(quarter * omega, 0.5 * std::numbers::pi, 2e-3);
}

TEST_P(Revolution, slender_bar_carries_waves_at_the_rod_speed) {
  // First free-free mode: ω = (π c₀/L)(1 − (νπR/L)²/4), c₀ = √(E/ρ).
  const double R = 1e-3, L = 2e-2;
  const Cloud<2> cloud = rectangle(R, L, 0.25e-3);
  Problem<2> model = solid(cloud, GetParam(), steel());
  model.supports = Supports<2>({held_axis(cloud)}, static_cast<std::size_t>(cloud.nodes()));
  model.viscosity = {0.0, 0.0};
  const auto mode = [&](double y) { return std::cos(std::numbers::pi * y / L); };
  ExplicitSolver<2> solver = start(std::move(model), [&](const Vec2& x) -> Vec2 {
    return {0.0, 0.01 * mode(x.y())};
  });
  const Field start_y = solver.state().node.initial_position[1];
  const double quarter = first_zero(solver, solver.stable_step().dt, [&](const State<2>& s) {
    double p = 0.0;
    for (std::size_t i = 0; i < s.node.size(); ++i)
      p += s.node.mass[i] * mode(start_y[i]) * s.node.velocity[1][i];
    return p;
  });
  const double correction = 0.33 * std::numbers::pi * R / L;
  const double omega =
      std::numbers::pi * std::sqrt(210e9 / 7850.0) / L * (1.0 - 0.25 * correction * correction);
  EXPECT_NEAR(quarter * omega, 0.5 * std::numbers::pi, 0.01);
  EXPECT_LT(std::abs(solver.ledger().residual()), 1e-4 * solver.ledger().initial());
}

TEST_P(Revolution, bound_on_the_step_holds_and_is_not_far) {
  for (const double radius : {0.0, 0.3}) {
    const Cloud<2> cloud = moved(rectangle(1.0, 1.0, 0.12, Lattice::hexagonal, 0.25), radius);
    Approximation<2> approximation = make(GetParam(), Space::revolution)->rebuild(cloud);
    const DiscreteOperators<2>& op = approximation.mechanics;
    const plasticity::Material material = steel();
    const auto points = static_cast<std::size_t>(op.points);
    Fields<5> F;
    resize_all(F, points);
    for (const std::size_t k : {0U, 3U, 4U}) F[k].assign(points, 1.0);
    Field mass = op.node_volume();
    for (double& m : mass) m *= material.density;
    SpectralBound<2> bound;
    const double modulus = material.elasticity.lambda() + 2.0 * material.elasticity.mu();
    const double largest = bound.of_all(op, F, Field(points, modulus), mass).value;
    for (const double alpha : {0.0, 0.05}) {
      const double step = stable_wave_step(largest, alpha, 0.0);
      const double highest = squared_frequencies(linearise(approximation, cloud, material, alpha)).maxCoeff();
      EXPECT_LE(step, 2.0 / std::sqrt(highest));
      EXPECT_GE(step, 0.4 * 2.0 / std::sqrt(highest));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(methods, Revolution,
                         ::testing::Values(Method::cnem, Method::triangles, Method::hybrid));

} // namespace
} // namespace cnem::testing
