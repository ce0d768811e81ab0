// Explicit conduction with the operators a discretisation hands over, against exact solutions.
#include "cnem/scni.hpp"
#include "core/operators/side_by_side.hpp"
#include "tests/clouds.hpp"
#include "tests/index_literals.hpp"
#include "tests/unit/thermal/decay.hpp"
#include "tests/unit/thermal/steel.hpp"
#include "thermal/boundaries.hpp"
#include "thermal/conduction.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <gtest/gtest.h>

namespace cnem::testing {
namespace {

using namespace literals;

/// A body that conducts, with its own explicit steps.
struct Body {
  Cloud<2> cloud;
  Approximation<2> approximation;
  Fields<2> position;
  Field capacity, temperature, flow;
  Conduction<2> conduction;

  Body(
      Cloud<2> made, const std::function<Vec2(const Vec2&)>& deform = [](const Vec2& x) { return x; },
      bool nodal_operator = false)
      : cloud(std::move(made)), approximation(scni::Cnem().rebuild(cloud)) {
    const auto n = static_cast<std::size_t>(cloud.nodes());
    resize_all(position, n);
    for (std::size_t i = 0; i < n; ++i) {
      const Vec2 x = deform(cloud.position[i]);
      position[0][i] = x.x();
      position[1][i] = x.y();
    }
    capacity = approximation.mechanics.node_volume();
    for (double& value : capacity) value *= rho * c;
    temperature.assign(n, 0.0);
    flow.assign(n, 0.0);
    const DiscreteOperators<2>& op = nodal_operator ? approximation.mechanics : approximation.conduction;
    conduction.set_operators(op, Field(static_cast<std::size_t>(op.points), k));
  }
  Body(const Body&) = delete;
  double stable_step() { return 2.0 / conduction.fastest_decay(side_by_side<2>(position), capacity); }
  double heat() const {
    double sum = 0.0;
    for (std::size_t i = 0; i < capacity.size(); ++i) sum += capacity[i] * temperature[i];
    return sum;
  }
  void step(double dt, const ThermalBoundaries<2>& boundaries = {}, double time = 0.0,
            const HeatContacts<2>& touching = {}) {
    std::fill(flow.begin(), flow.end(), 0.0);
    boundaries.add_flow(time, position, temperature, flow);
    touching.add_flow(temperature, flow);
    conduction.add_flow(side_by_side<2>(position), temperature, flow);
    for (std::size_t i = 0; i < flow.size(); ++i) temperature[i] += dt * flow[i] / capacity[i];
    boundaries.hold(time + dt, [&](NodeIndex node, double value) { temperature[index_of(node)] = value; });
  }
  void run(double end, const ThermalBoundaries<2>& boundaries) {
    const int steps = static_cast<int>(std::ceil(end / (0.9 * stable_step())));
    for (int n = 0; n < steps; ++n) step(end / steps, boundaries, end * n / steps);
  }
};

Cloud<2> strip(double length, double width, double h, double jitter = 0.15) {
  Cloud<2> cloud;
  add_loop(cloud, {{0, 0}, {length, 0}, {length, width}, {0, width}}, h);
  fill(cloud, Lattice::hexagonal, h, jitter, 0.5 * h, 3);
  return cloud;
}

std::vector<Facet<2>> facets_at_x(const Cloud<2>& cloud, double x) {
  std::vector<Facet<2>> facets;
  for (const Facet<2>& facet : cloud.facets)
    if (std::abs(cloud.position[static_cast<std::size_t>(facet.node[0])].x() - x) < 1e-12 &&
        std::abs(cloud.position[static_cast<std::size_t>(facet.node[1])].x() - x) < 1e-12)
      facets.push_back(facet);
  return facets;
}

std::vector<NodeIndex> nodes_at_x(const Cloud<2>& cloud, double x) {
  std::vector<NodeIndex> nodes;
  for (const NodeIndex i : cloud.position.indices())
    if (std::abs(cloud.position[i].x() - x) < 1e-12) nodes.push_back(i);
  return nodes;
}

/// Largest error of a half space whose face jumps from 0 to 1, at t = 1 ms.
double half_space_error(double h) {
  const double length = 0.8e-3, end = 1e-3;
  Body body(strip(length, 6 * h, h));
  body.run(end, ThermalBoundaries<2>({{"face", TimeTable(1.0), nodes_at_x(body.cloud, 0.0)}}, {}, {}));
  double worst = 0.0;
  for (std::size_t i = 0; i < body.temperature.size(); ++i) {
    const double exact = std::erfc(body.cloud.position[i].x() / (2.0 * std::sqrt(diffusivity * end)));
    worst = std::max(worst, std::abs(body.temperature[i] - exact));
  }
  return worst;
}

TEST(Conduction, half_space_follows_erfc_with_second_order) {
  // The tabulated values themselves: θ at 20, 50, 100, 200 µm after 1 ms.
  const double table[4][2] = {{20e-6, 0.902595}, {50e-6, 0.759635}, {100e-6, 0.540591}, {200e-6, 0.221013}};
  for (const auto& [x, theta] : table)
    EXPECT_NEAR(std::erfc(x / (2.0 * std::sqrt(diffusivity * 1e-3))), theta, 1e-5);
  const double coarse = half_space_error(40e-6), fine = half_space_error(20e-6);
  EXPECT_LT(fine, 2e-3);
  EXPECT_GT(std::log2(coarse / fine), 1.7);
}

TEST(Conduction, flux_into_a_half_space) {
  const double end = 1e-3, h = 10e-6;
  Body body(strip(0.8e-3, 4 * h, h));
  body.run(end, ThermalBoundaries<2>({}, {{"face", TimeTable(1e8), facets_at_x(body.cloud, 0.0)}}, {}));
  for (const NodeIndex i : nodes_at_x(body.cloud, 0.0))
    EXPECT_NEAR(body.temperature[static_cast<std::size_t>(i)], 260.781, 0.5); // 2q √(αt/π)/k
}

TEST(Conduction, convection_settles_to_the_series_resistance) {
  // Hot face held at 100, h (T_wall − 0) on the other: T_wall = 100/(1 + hL/k).
  const double length = 1e-3, h = 5e4;
  Body body(strip(length, 0.3e-3, 1e-4));
  const ThermalBoundaries<2> boundaries(
      {{"hot", TimeTable(100.0), nodes_at_x(body.cloud, 0.0)}}, {},
      {{{"cold", TimeTable(h), TimeTable(0.0)}, facets_at_x(body.cloud, length)}});
  body.run(0.6, boundaries);
  for (const NodeIndex i : nodes_at_x(body.cloud, length))
    EXPECT_NEAR(body.temperature[static_cast<std::size_t>(i)], 100.0 / (1.0 + h * length / k), 1e-3);
}

TEST(Conduction, conductance_to_a_tool_relaxes_as_a_lump) {
  Body body(strip(1e-4, 1e-4, 5e-5));
  std::fill(body.temperature.begin(), body.temperature.end(), 400.0);
  const double conductance = 100.0, tool = 300.0;
  HeatContacts<2> touch;
  for (const NodeIndex i : nodes_at_x(body.cloud, 0.0))
    touch.tools.push_back({i, conductance, 1e-4 / 3, tool});
  ASSERT_EQ(touch.tools.size(), 3U);
  double capacity = 0.0;
  for (const double value : body.capacity) capacity += value;
  const double rate = conductance * 1e-4 / capacity, end = 0.5 / rate;
  const int steps = 4000;
  ASSERT_LT(end / steps, body.stable_step() * 100);
  const int inner = static_cast<int>(std::ceil(end / (0.9 * body.stable_step())));
  for (int n = 0; n < inner; ++n) body.step(end / inner, {}, 0.0, touch);
  EXPECT_NEAR(body.temperature[0], tool + 100.0 * std::exp(-0.5), 0.05);
}

TEST(Conduction, exchange_between_faces_keeps_heat_and_stays_below_its_bound) {
  Field temperature{400.0, 300.0, 320.0, 350.0, 310.0};
  const Field capacity{2.0, 1.0, 3.0, 0.5, 1.5};
  HeatContacts<2> touching; // nodes 0 and 3 on the facet 1 2, node 1 on the facet 3 0
  touching.bodies = {{0_node, {1_node, 2_node}, {0.25, 0.75}, 1e3, 1e-3},
                     {3_node, {1_node, 2_node}, {0.9, 0.1}, 1e3, 2e-3},
                     {1_node, {3_node, 0_node}, {0.5, 0.5}, 1e3, 5e-4}};
  touching.tools = {{4_node, 1e3, 1e-3, 500.0}};
  const auto rate = [&](const Field& t) {
    Field flow(t.size(), 0.0);
    touching.add_flow(t, flow);
    for (std::size_t i = 0; i < flow.size(); ++i) flow[i] /= capacity[i];
    return flow;
  };
  const Field first = rate(temperature);
  EXPECT_NEAR(capacity[4] * first[4], 190.0, 1e-12);
  double bodies = 0.0;
  for (std::size_t i = 0; i < 4; ++i) bodies += capacity[i] * first[i];
  EXPECT_NEAR(bodies, 0.0, 1e-12);
  EXPECT_NEAR(capacity[2] * first[2], 0.75 * (400.0 - 315.0) + 0.1 * 2.0 * (350.0 - 302.0), 1e-12);
  // largest eigenvalue by power iteration on differences from a state at rest
  const Field rest(5, 500.0);
  Field x{1.0, -1.0, 0.5, 2.0, 1.0};
  double eigenvalue = 0.0;
  for (int n = 0; n < 200; ++n) {
    Field state = rest;
    for (std::size_t i = 0; i < x.size(); ++i) state[i] += x[i];
    const Field y = rate(state);
    eigenvalue = 0.0;
    for (const double value : y) eigenvalue = std::max(eigenvalue, std::abs(value));
    for (std::size_t i = 0; i < x.size(); ++i) x[i] = y[i] / eigenvalue;
  }
  EXPECT_GT(touching.fastest_decay(capacity), eigenvalue);
  EXPECT_LT(touching.fastest_decay(capacity), 3.0 * eigenvalue);
}

TEST(Conduction, insulated_body_keeps_its_heat_on_any_deformation) {
  Body body(strip(1e-3, 1e-3, 1e-4, 0.25), [](const Vec2& x) -> Vec2 {
    return {1.4 * x.x() + 0.6 * x.y() + 200.0 * x.x() * x.y(), 0.8 * x.y() - 0.3 * x.x()};
  });
  for (std::size_t i = 0; i < body.temperature.size(); ++i)
    body.temperature[i] = 300.0 + 50.0 * static_cast<double>(i % 7);
  const double before = body.heat(), dt = 0.9 * body.stable_step();
  for (int n = 0; n < 500; ++n) body.step(dt);
  EXPECT_NEAR(body.heat(), before, 1e-12 * before);
}

TEST(Conduction, stretched_body_conducts_as_the_stretched_geometry) {
  const Mat2 F = (Mat2() << 0.0, -1.6, 0.7, 0.0).finished(); // quarter turn with stretches 0.7 and 1.6
  const auto deform = [&](const Vec2& x) -> Vec2 { return F * x; };
  Body moved(strip(1e-3, 0.5e-3, 1e-4), deform);
  Cloud<2> there = moved.cloud;
  for (Vec2& x : there.position) x = deform(x);
  // Linear triangles see the same linear fields on either configuration when the triangles are the same; the
  // flows they make of one linear temperature must agree: k ∇T·n over the present boundary.
  const Vec2 slope(3e5, -2e5);
  for (std::size_t i = 0; i < moved.temperature.size(); ++i)
    moved.temperature[i] = slope.dot(Vec2(moved.position[0][i], moved.position[1][i]));
  std::fill(moved.flow.begin(), moved.flow.end(), 0.0);
  moved.conduction.add_flow(side_by_side<2>(moved.position), moved.temperature, moved.flow);
  Field expected(moved.flow.size(), 0.0);
  for (const Facet<2>& facet : there.facets) {
    const auto a = static_cast<std::size_t>(facet.node[0]), b = static_cast<std::size_t>(facet.node[1]);
    const double through = -k * slope.dot(right_normal(there.position[b] - there.position[a]));
    expected[a] += 0.5 * through;
    expected[b] += 0.5 * through;
  }
  for (std::size_t i = 0; i < expected.size(); ++i)
    EXPECT_NEAR(moved.flow[i], expected[i], 1e-9 * k * slope.norm() * 1e-3);
}

/// Lowest temperature over a run that starts with one hot node in a cold body.
double coldest_after_hot_spot(bool nodal_operator) {
  Body body(
      strip(1e-3, 1e-3, 1e-4, 0.1), [](const Vec2& x) { return x; }, nodal_operator);
  std::size_t centre = 0;
  for (std::size_t i = 0; i < body.temperature.size(); ++i)
    if ((body.cloud.position[i] - Vec2(5e-4, 5e-4)).norm() <
        (body.cloud.position[centre] - Vec2(5e-4, 5e-4)).norm())
      centre = i;
  body.temperature[centre] = 1000.0;
  const double dt = 0.25 * body.stable_step();
  double coldest = 0.0;
  for (int n = 0; n < 400; ++n) {
    body.step(dt);
    coldest = std::min(coldest, *std::min_element(body.temperature.begin(), body.temperature.end()));
  }
  return coldest;
}

TEST(Conduction, hot_spot_spreads_without_checkerboard) {
  EXPECT_GT(coldest_after_hot_spot(false), -1e-9) << "nothing may get colder than the coldest";
  EXPECT_LT(coldest_after_hot_spot(true), -10.0) << "the nodal operator does: that is why it is not used";
}

/// Plane triangles conduct from present positions alone: the same as J F⁻¹F⁻ᵀ on the reference.
TEST(Conduction, triangles_give_what_the_pulled_back_operator_gives) {
  const Cloud<2> cloud = jittered_square(0.1, 0.25, 7);
  const auto bend = [](const Vec2& x) {
    return Vec2(1.3 * x.x() + 0.4 * x.y() * x.y(), 0.7 * x.y() - 0.2 * x.x() * x.x() + 0.1 * x.x());
  };
  Body fast(cloud, bend);
  // With a fourth entry of no weight in every row the general path is taken.
  DiscreteOperators<2> padded = fast.approximation.conduction;
  const auto rows = static_cast<std::size_t>(padded.points);
  DiscreteOperators<2> wide = padded;
  wide.node.clear();
  for (Field* field : {&wide.gradient[0], &wide.gradient[1], &wide.value}) field->clear();
  for (std::size_t p = 0; p < rows; ++p) {
    for (std::size_t e = 3 * p; e < 3 * p + 4; ++e) {
      const bool real = e < 3 * p + 3;
      wide.node.push_back(padded.node[real ? e : 3 * p]);
      for (std::size_t i = 0; i < 2; ++i) wide.gradient[i].push_back(real ? padded.gradient[i][e] : 0.0);
      if (!padded.value.empty()) wide.value.push_back(real ? padded.value[e] : 0.0);
    }
    wide.row_begin[p + 1] = static_cast<std::int32_t>(4 * (p + 1));
  }
  wide.build_transpose();
  Conduction<2> general;
  general.set_operators(wide, Field(rows, k));
  Random random(3);
  for (double& temperature : fast.temperature) temperature = random.uniform(200, 900);
  Field flow(fast.flow.size(), 0.0), expected = flow;
  const Field position = side_by_side<2>(fast.position);
  fast.conduction.add_flow(position, fast.temperature, flow);
  general.add_flow(position, fast.temperature, expected);
  for (std::size_t i = 0; i < flow.size(); ++i) EXPECT_NEAR(flow[i], expected[i], 1e-12 * k * 900);
}

TEST(Conduction, a_limit_holds_back_light_nodes_alone) {
  Body body(jittered_square(0.1, 0.2, 7));
  const std::vector<Vec2>& place = body.cloud.position;
  const auto light =
      static_cast<std::size_t>(std::min_element(place.begin(), place.end(),
                                                [](const Vec2& a, const Vec2& b) {
                                                  const Vec2 middle(0.5, 0.5);
                                                  return (a - middle).norm() < (b - middle).norm();
                                                }) -
                               place.begin());
  const double usual = 2.0 / body.stable_step();
  body.capacity[light] *= 1e-6;
  const Field positions = side_by_side<2>(body.position);
  EXPECT_GT(body.conduction.fastest_decay(positions, body.capacity), 1e4 * usual);
  for (std::size_t i = 0; i < body.temperature.size(); ++i)
    body.temperature[i] = std::sin(7.0 * place[i].x()) + place[i].y();
  const auto flow = [&] {
    Field result(body.flow.size(), 0.0);
    body.conduction.add_flow(positions, body.temperature, result);
    return result;
  };
  const Field before = flow();
  EXPECT_LE(body.conduction.limit_decay(positions, body.capacity, 2.0 * usual), 2.0 * usual);
  const Field limited = flow();
  double sum = 0.0, largest = 0.0;
  std::size_t changed = 0;
  for (std::size_t i = 0; i < limited.size(); ++i) {
    sum += limited[i];
    largest = std::max(largest, std::abs(limited[i]));
    changed += limited[i] != before[i];
  }
  EXPECT_NEAR(sum, 0.0, 1e-12 * largest);
  EXPECT_GT(changed, 3u);
  EXPECT_LT(changed, 12u); // the node and its neighbours
  // Explicit steps that long bring it among its neighbours and stay there.
  const double h = 1.0 / (2.0 * usual), high = 100.0;
  std::fill(body.temperature.begin(), body.temperature.end(), 0.0);
  body.temperature[light] = high;
  const double heat = body.heat();
  for (int i = 0; i < 100; ++i) {
    body.step(h);
    for (const double t : body.temperature) ASSERT_LT(std::abs(t), high);
  }
  EXPECT_NEAR(body.heat(), heat, 1e-12 * heat);
  EXPECT_LT(std::abs(body.temperature[light]), 1e-2 * high);
  body.conduction.lift_limit();
  for (std::size_t i = 0; i < body.temperature.size(); ++i)
    body.temperature[i] = std::sin(7.0 * place[i].x()) + place[i].y();
  EXPECT_EQ(flow(), before);
}

TEST(Conduction, a_limit_leaves_fine_cells_of_usual_density_alone) {
  Body body(jittered_square(0.1, 0.2, 7));
  const Field positions = side_by_side<2>(body.position);
  for (std::size_t i = 0; i < body.temperature.size(); ++i)
    body.temperature[i] = std::sin(7.0 * body.cloud.position[i].x());
  const auto flow = [&] {
    Field result(body.flow.size(), 0.0);
    body.conduction.add_flow(positions, body.temperature, result);
    return result;
  };
  const Field before = flow();
  const double usual = body.conduction.fastest_decay(positions, body.capacity);
  EXPECT_EQ(body.conduction.limit_decay(positions, body.capacity, 1e-3 * usual), usual);
  EXPECT_EQ(flow(), before);
}

TEST(Conduction, fastest_decay_bounds_the_exact_rate) {
  for (const bool deformed : {false, true}) {
    Body body(strip(1e-3, 1e-3, 1.25e-4, 0.25), [&](const Vec2& x) -> Vec2 {
      return deformed ? Vec2(1.5 * x.x() + 0.8 * x.y(), 0.6 * x.y()) : x;
    });
    const double exact = decay_rates(decay_matrix(body)).maxCoeff();
    const double bound = body.conduction.fastest_decay(side_by_side<2>(body.position), body.capacity);
    EXPECT_GT(bound, exact);
    EXPECT_LT(bound, 6.0 * exact);
  }
}

TEST(Conduction, stays_bounded_and_from_hot_to_cold_in_triangles_that_turn_inside_out) {
  Body body(strip(1e-3, 1e-3, 1.25e-4));
  expect_bounded_conduction(body, {5e-4, 5e-4}, 1.25e-4);
}

} // namespace
} // namespace cnem::testing
