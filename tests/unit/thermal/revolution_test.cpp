// Conduction and boundaries in bodies of revolution.
#include "cnem/scni.hpp"
#include "core/operators/side_by_side.hpp"
#include "tests/clouds.hpp"
#include "tests/unit/thermal/decay.hpp"
#include "tests/unit/thermal/steel.hpp"
#include "thermal/boundaries.hpp"
#include "thermal/conduction.hpp"

#include <gtest/gtest.h>

namespace cnem::testing {
namespace {

struct Cylinder {
  Cloud<2> cloud;
  Approximation<2> approximation;
  Fields<2> position;
  Field capacity, temperature, flow;
  Conduction<2> conduction;

  /// Radius a, height b; `stretch` is (radial, axial) from the reference.
  Cylinder(double a, double b, double h, const Vec2& stretch = {1, 1}) {
    add_loop(cloud, {{0, 0}, {a, 0}, {a, b}, {0, b}}, h);
    fill(cloud, Lattice::hexagonal, h, 0.15, 0.5 * h, 3);
    approximation = scni::Cnem({.space = Space::revolution}).rebuild(cloud);
    capacity = approximation.node_volume;
    resize_all(position, capacity.size());
    for (std::size_t i = 0; i < capacity.size(); ++i) {
      position[0][i] = stretch.x() * cloud.position[i].x();
      position[1][i] = stretch.y() * cloud.position[i].y();
    }
    for (double& value : capacity) value *= rho * c;
    flow.assign(capacity.size(), 0.0);
    conduction.set_operators(approximation.conduction,
                             Field(static_cast<std::size_t>(approximation.conduction.points), k));
  }
  Cylinder(const Cylinder&) = delete;

  void run(double end, const ThermalBoundaries<2>& boundaries) {
    const double decay = conduction.fastest_decay(side_by_side<2>(position), capacity) +
                         boundaries.fastest_decay(0.0, position, capacity);
    const int steps = static_cast<int>(std::ceil(end / (0.9 * 2.0 / decay)));
    for (int n = 0; n < steps; ++n) {
      std::fill(flow.begin(), flow.end(), 0.0);
      boundaries.add_flow(0.0, position, temperature, flow);
      conduction.add_flow(side_by_side<2>(position), temperature, flow);
      for (std::size_t i = 0; i < flow.size(); ++i) temperature[i] += end / steps * flow[i] / capacity[i];
      boundaries.hold(0.0, [&](NodeIndex node, double value) { temperature[index_of(node)] = value; });
    }
  }
};

/// θ(r, t) of a cylinder of radius a that starts at 1 and whose surface is held at 0.
double bessel_series(double r, double a, double t) {
  constexpr double zero[]{2.404825557695773,  5.520078110286311,  8.653727912911013,
                          11.791534439014281, 14.930917708487787, 18.071063967910923};
  double sum = 0.0;
  for (const double j : zero)
    sum += 2.0 * std::cyl_bessel_j(0, j * r / a) / (j * std::cyl_bessel_j(1, j)) *
           std::exp(-j * j * diffusivity * t / (a * a));
  return sum;
}

/// Largest error at Fo = 0.1. The body is meshed at 1/stretch of its size, so that F is not the identity.
double cooling_error(double h, const Vec2& stretch) {
  const double a = 1e-3, end = 0.1 * a * a / diffusivity;
  Cylinder body(a / stretch.x(), 4 * h / stretch.y(), h / stretch.x(), stretch);
  const double J = stretch.x() * stretch.x() * stretch.y();
  for (double& value : body.capacity) value *= J;
  body.temperature.assign(body.capacity.size(), 1.0);
  std::vector<NodeIndex> skin;
  for (std::size_t i = 0; i < body.capacity.size(); ++i)
    if (std::abs(body.position[0][i] - a) < 1e-9 * a) skin.push_back(as<NodeIndex>(i));
  body.run(end, ThermalBoundaries<2>({{"skin", TimeTable(0.0), skin}}, {}, {}, Space::revolution));
  double worst = 0.0;
  for (std::size_t i = 0; i < body.capacity.size(); ++i)
    worst = std::max(worst, std::abs(body.temperature[i] - bessel_series(body.position[0][i], a, end)));
  return worst;
}

TEST(Revolution, cooling_cylinder_follows_the_bessel_series_with_second_order) {
  const double coarse = cooling_error(1e-4, {1, 1}), fine = cooling_error(0.5e-4, {1, 1});
  EXPECT_LT(fine, 2e-3);
  EXPECT_GT(std::log2(coarse / fine), 1.6);
}

TEST(Revolution, conduction_takes_place_on_the_deformed_body) {
  EXPECT_LT(cooling_error(0.5e-4, {1.25, 0.8}), 2e-3);
}

TEST(Revolution, flux_and_convection_act_on_areas_of_revolution) {
  const double a = 1e-3, b = 0.5e-3;
  Cylinder body(a, b, 1e-4);
  body.temperature.assign(body.capacity.size(), 0.0);
  const auto received = [&](const ThermalBoundaries<2>& boundaries) {
    std::fill(body.flow.begin(), body.flow.end(), 0.0);
    boundaries.add_flow(0.0, body.position, body.temperature, body.flow);
    double sum = 0.0;
    for (const double q : body.flow) sum += q;
    return sum;
  };
  const double skin = 2.0 * std::numbers::pi * (a * a + a * b);
  EXPECT_NEAR(received({{}, {{"all", TimeTable(3.0), body.cloud.facets}}, {}, Space::revolution}), 3.0 * skin,
              1e-12 * skin);
  EXPECT_NEAR(
      received({{}, {}, {{{"all", TimeTable(2.0), TimeTable(5.0)}, body.cloud.facets}}, Space::revolution}),
      10.0 * skin, 1e-11 * skin);
}

TEST(Revolution, heat_is_conserved_and_a_uniform_temperature_stays) {
  Cylinder body(1e-3, 0.5e-3, 1e-4);
  body.temperature.assign(body.capacity.size(), 7.0);
  body.run(1e-3, {});
  for (const double T : body.temperature) EXPECT_NEAR(T, 7.0, 1e-10);
  double before = 0.0, after = 0.0;
  for (std::size_t i = 0; i < body.capacity.size(); ++i) {
    body.temperature[i] = body.position[0][i] * 1e3;
    before += body.capacity[i] * body.temperature[i];
  }
  body.run(5e-3, {});
  for (std::size_t i = 0; i < body.capacity.size(); ++i) after += body.capacity[i] * body.temperature[i];
  EXPECT_NEAR(after, before, 1e-11 * before);
}

TEST(Revolution, conduction_stays_bounded_in_triangles_that_turn_inside_out) {
  Cylinder body(1e-3, 1e-3, 1.25e-4);
  expect_bounded_conduction(body, {5e-4, 5e-4}, 1.25e-4);
}

} // namespace
} // namespace cnem::testing
