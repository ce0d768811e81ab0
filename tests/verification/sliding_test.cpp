// An elastic strip that slides on a rigid plane with constant friction is unstable: Coulomb's law couples
// normal stress and slip, and waves that run along the strip grow, the faster the more friction there is
// (Brener, Weikamp, Spatschek, Bar-Sinai and Bouchbinder 2016). The rate at which they grow is the exact one.
#include "tests/unit/mechanics/tools.hpp"

#include <Eigen/Eigenvalues>
#include <complex>
#include <gtest/gtest.h>
#include <numbers>

namespace cnem::testing {
namespace {

constexpr int across = 8, along = 50;                            // nodes apart, of the strip and of the wave
constexpr double wave = 2.0 * std::numbers::pi * across / along; // wave number times the height of the strip

/// The fastest growth of disturbances exp(i k x + s t) of steady sliding, Re s in units of c_s/height. The
/// strip is held along x on its upper side, under a given normal stress; on the lower one v = 0 and τ = μ p.
/// Poisson's ratio is 0; quadratic elements across the strip. On the boundary of the body the friction of the
/// reaction is μ times the row of the held component, added to that of the free one.
double theory(double friction) {
  using Complex = std::complex<double>;
  constexpr int elements = 16, nodes = 2 * elements + 1;
  constexpr double size = 1.0 / elements;
  Eigen::MatrixXcd stiffness = Eigen::MatrixXcd::Zero(2 * nodes, 2 * nodes), mass = stiffness;
  const Eigen::Vector3d moduli(2.0, 2.0, 1.0); // λ = 0, μ = 1
  const double point = std::sqrt(0.6);
  for (int e = 0; e < elements; ++e)
    for (const auto& [x, weight] : {std::pair(-point, 5.0 / 9.0), {0.0, 8.0 / 9.0}, {point, 5.0 / 9.0}}) {
      const double value[3] = {0.5 * x * (x - 1.0), 1.0 - x * x, 0.5 * x * (x + 1.0)};
      const double slope[3] = {(2.0 * x - 1.0) / size, -4.0 * x / size, (2.0 * x + 1.0) / size};
      Eigen::Matrix<Complex, 3, 6> strain = Eigen::Matrix<Complex, 3, 6>::Zero();
      for (int a = 0; a < 3; ++a) {
        strain(0, 2 * a) = strain(2, 2 * a + 1) = Complex(0.0, wave * value[a]);
        strain(1, 2 * a + 1) = strain(2, 2 * a) = slope[a];
        for (int b = 0; b < 3; ++b)
          for (int k = 0; k < 2; ++k)
            mass(4 * e + 2 * a + k, 4 * e + 2 * b + k) += 0.5 * size * weight * value[a] * value[b];
      }
      stiffness.block<6, 6>(4 * e, 4 * e) +=
          0.5 * size * weight * strain.adjoint() * moduli.cast<Complex>().asDiagonal() * strain;
    }
  stiffness.row(0) += friction * stiffness.row(1);
  mass.row(0) += friction * mass.row(1);
  std::vector<int> free{0};
  for (int i = 2; i < 2 * nodes; ++i)
    if (i != 2 * nodes - 2) free.push_back(i);
  const Eigen::MatrixXcd K = stiffness(free, free), M = mass(free, free);
  const Eigen::ComplexEigenSolver<Eigen::MatrixXcd> modes(M.lu().solve(K), false);
  double fastest = 0.0;
  for (const Complex& square : modes.eigenvalues())
    fastest = std::max(fastest, std::abs(std::sqrt(-square).real()));
  return fastest;
}

/// Rises from 0 at 0 to `value` at `end` without kinks.
TimeTable smooth_ramp(double end, double value) {
  std::vector<double> time, values;
  for (int i = 0; i <= 200; ++i) {
    const double s = i / 200.0;
    time.push_back(s * end);
    values.push_back(value * s * s * s * (10.0 - 15.0 * s + 6.0 * s * s));
  }
  return TimeTable(time, values);
}

/// The growth of the wave in the forces on the ground between two times, in units of height/c_s.
double growth(Method method, double friction, double from, double to) {
  plasticity::Material material = steel();
  material.elasticity.poisson = 0.0;
  const double shear = 0.5 * material.elasticity.young, speed = std::sqrt(shear / material.density);
  const double height = 1e-3, h = height / across, length = along * h, unit = height / speed;
  const double pressure = 1e-3 * shear;
  Cloud<2> cloud = rectangle(length, height, h, Lattice::square, 0.0);
  std::vector<std::array<NodeIndex, 2>> pairs;
  for (const NodeIndex right : nodes_on(cloud, 1_piece))
    for (const NodeIndex left : nodes_on(cloud, 3_piece))
      if (std::abs(cloud.position[right].y() - cloud.position[left].y()) < 1e-3 * h)
        pairs.push_back({left, right});
  std::vector<Facet<2>> top;
  for (const Facet<2>& facet : cloud.facets)
    if (facet.piece == 2_piece) top.push_back(facet);
  Problem<2> model = model_of(cloud, method, material);
  model.viscosity = {1.2, 0.06};
  model.ties = Ties<2>(pairs, cloud.position);
  model.supports =
      Supports<2>({{"top", Support<2>::Kind::velocity, Vec2(1, 0), TimeTable(0.0), nodes_on(cloud, 2_piece)}},
                  static_cast<std::size_t>(cloud.nodes()));
  model.loads = Loads<2>({{"press", {TimeTable(0.0), smooth_ramp(30.0 * unit, -pressure)}, top}}, {}, {},
                         cloud.position);
  const double slip = 0.002 * speed;
  model.contact = contact::RigidContact<2>({rigid_tool("ground", box({-length, -height}, {2.0 * length, 0.0}),
                                                       {-slip, 0.0}, contact::Coulomb{friction})});
  ExplicitSolver<2> solver = start(std::move(model), [&](const Vec2& x) -> Vec2 {
    return {1e-12 * speed * std::sin(wave * x.x() / height) * (1.0 - x.y() / height), 0.0};
  });
  const double dt = solver.stable_step().dt, window = 8.0;
  double early = 0.0, late = 0.0;
  while (solver.state().time < to * unit) {
    solver.advance(dt);
    const contact::RigidContact<2>& contact = solver.conditions().contact;
    std::complex<double> amplitude = 0.0;
    for (const BoundaryNodeIndex b : contact.boundary_nodes().indices())
      amplitude += contact.nodal_impulse()[b].y() *
                   std::polar(1.0, -wave / height * cloud.position[contact.boundary_nodes()[b]].x());
    const double time = solver.state().time / unit;
    if (time >= from && time < from + window) early += std::norm(amplitude);
    if (time >= to - window && time < to) late += std::norm(amplitude);
  }
  EXPECT_LT(std::sqrt(late * dt / (window * unit)), 0.05 * pressure * length * dt) << "linear to the end";
  return 0.5 * std::log(late / early) / (to - window - from);
}

class Sliding : public ::testing::TestWithParam<Method> {};

TEST_P(Sliding, grows_unstable_at_the_rate_of_theory) {
  EXPECT_NEAR(theory(0.2), 2.0 * theory(0.1), 0.05 * theory(0.2));
  EXPECT_NEAR(growth(GetParam(), 0.2, 30.0, 60.0), theory(0.2), 0.04 * theory(0.2));
  EXPECT_NEAR(growth(GetParam(), 0.1, 60.0, 120.0), theory(0.1), 0.06 * theory(0.1));
}

TEST_P(Sliding, is_stable_without_friction) {
  EXPECT_LT(theory(0.0), 1e-6);
  EXPECT_LT(growth(GetParam(), 0.0, 30.0, 80.0), 0.01);
}

INSTANTIATE_TEST_SUITE_P(methods, Sliding, ::testing::Values(Method::cnem, Method::triangles));

} // namespace
} // namespace cnem::testing
