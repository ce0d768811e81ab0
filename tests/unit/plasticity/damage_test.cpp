// Damage: the table of fracture strains, the work of the largest tension, single-point paths, what breaking
// costs.
#include "plasticity/damage.hpp"
#include "tests/unit/plasticity/points.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <map>
#include <numbers>
#include <random>
#include <sstream>

namespace cnem::plasticity::test {
namespace {

/// D1 to D5 of the sets of the table, whose sign is that of Johnson and Cook.
const std::map<std::string, std::array<double, 5>> constants{
    {"4340_JC85", {0.05, 3.44, -2.12, 0.002, 0.61}},
    {"OFHC_JC85", {0.54, 4.89, -3.03, 0.014, 1.12}},
    {"Armco_JC85", {-2.20, 5.43, -0.47, 0.016, 0.63}},
    {"A2024_Mabrouki", {0.13, 0.13, -1.5, 0.011, 0.0}},
    {"Weldox460E_Borvik", {0.0705, 1.732, -0.54, -0.0123, 0.0}},
    {"Ti64_JC(D3=-0.5 JC form)", {-0.09, 0.25, -0.5, 0.014, 3.87}},
    {"Ti64_AbaqusInput d3=-0.5 => exp(+0.5 eta)", {-0.09, 0.25, 0.5, 0.014, 3.87}}};

JohnsonCookDamage law_of(const std::array<double, 5>& d) {
  return {.D1 = d[0],
          .D2 = d[1],
          .D3 = d[2],
          .D4 = d[3],
          .D5 = d[4],
          .T0 = 300.0,
          .Tmelt = 1300.0,
          .cut_off = -infinite};
}

Material perfect_steel(const DamageLaw& law) {
  Material m = steel();
  m.hardening = Perfect{500e6};
  m.damage = {{.fracture_energy = 1e5}, law};
  return m;
}

PointState<2> sound_points(std::size_t n, double temperature) {
  PointState<2> s = points_at_rest<2>(n, temperature);
  for (Field* f : {&s.damage, &s.softening, &s.initiation_strain}) f->assign(n, 0.0);
  return s;
}

/// A point that is taken along a path as the solver takes it.
struct Point {
  Material material;
  double length = 1e-4, temperature = 300.0, opening = 0.0;
  PointState<2> state = sound_points(1, temperature);
  double released = 0.0;

  void step(const Mat3& f, double dt) {
    set_deformation<2>(state, 0, f);
    Field factor{state.strength[0] * flow_share<2>(material, state, 0, state.pressure[0])};
    auto points = stress_points<2>(state);
    points.strength = factor.data();
    ASSERT_EQ(update_stress<2>({material}, state.material, points, 0, 1, dt), -1);
    released += update_damage<2>({material}, state.material,
                                 damage_points<2>(state, {length}, {1.0}, {opening}), 0, 1, dt)
                    .released;
  }
  double triaxiality() const { return -state.pressure[0] / state.equivalent_stress[0]; }
};

TEST(damage, fracture_strains_of_the_table) {
  std::ifstream in(CNEM_SOURCE_DIR "/tests/data/jc_damage_fracture_strain.csv");
  int rows = 0;
  const auto exact = [](double printed) { // η stands there with four decimals
    for (const double value : {1.0 / 3.0, -1.0 / 3.0, 1.0 / std::numbers::sqrt3})
      if (std::abs(printed - value) < 1e-4) return value;
    return printed;
  };
  for (std::string line; std::getline(in, line);) {
    if (line.empty() || line[0] == '#' || line.starts_with("set,")) continue;
    std::array<std::string, 5> cell;
    std::istringstream cells(line);
    for (std::string& text : cell) std::getline(cells, text, ',');
    const JohnsonCookDamage law = law_of(constants.at(cell[0]));
    const double eta = exact(std::stod(cell[1])), rate = std::stod(cell[2]);
    const double temperature = 300.0 + 1000.0 * std::stod(cell[3]), expected = std::stod(cell[4]);
    EXPECT_NEAR(law.fracture_strain(eta, rate, temperature), expected, 1e-4 * expected + 5e-6) << line;

    // The pass itself: one increment of plastic strain adds its share.
    PointState<2> s = sound_points(3, temperature);
    const double increment = 1e-3;
    s.plastic_rate.assign(3, rate);
    s.equivalent_stress.assign(3, 500e6);
    s.pressure.assign(3, -eta * 500e6);
    const Field length(3, 1e-4), volume(3, 1.0), opening(3, 0.0);
    update_damage<2>({perfect_steel(law)}, s.material, damage_points<2>(s, length, volume, opening), 0, 3,
                     increment / rate);
    for (const double d : s.damage) EXPECT_NEAR(increment / d, expected, 1e-4 * expected + 5e-6) << line;
    ++rows;
  }
  EXPECT_EQ(rows, 294);
}

/// Plastic strain at which softening begins on a path of constant triaxiality, by tension or simple shear.
double initiation_strain(double triaxiality, bool shear) {
  JohnsonCookDamage law = law_of(constants.at("4340_JC85"));
  law.D4 = law.D5 = 0.0;
  Point point{perfect_steel(law)};
  const double volume = std::exp(triaxiality * 500e6 / point.material.elasticity.kappa() / 3.0); // of an edge
  for (double e = 0.0; point.state.initiation_strain[0] == 0.0 && e < 20.0; e += 1e-3) {
    Mat3 f = Eigen::Vector3d(std::exp(e), std::exp(-e / 2), std::exp(-e / 2)).asDiagonal();
    if (shear) f << 1, 2.0 * std::sinh(std::numbers::sqrt3 / 2.0 * e), 0, 0, 1, 0, 0, 0, 1;
    point.step(volume * f, 1e-3);
    if (e > 0.1) { EXPECT_NEAR(point.triaxiality(), triaxiality, 2e-3); }
  }
  return point.state.initiation_strain[0];
}

TEST(damage, begins_at_the_fracture_strain_of_its_path) {
  const JohnsonCookDamage law = law_of(constants.at("4340_JC85"));
  for (const double triaxiality : {0.0, 1.0 / 3.0, 1.0, 1.5}) { // shear, smooth bar, notched bars
    const double expected = law.D1 + law.D2 * std::exp(law.D3 * triaxiality);
    EXPECT_NEAR(initiation_strain(triaxiality, false), expected, 2e-3 * expected + 2e-3) << triaxiality;
  }
  EXPECT_NEAR(initiation_strain(0.0, true), law.D1 + law.D2, 0.02) << "simple shear";
}

TEST(damage, does_not_grow_below_the_cut_off) {
  EXPECT_EQ(JohnsonCookDamage{}.cut_off, -1.0 / 3.0)
      << "of uniaxial compression, unless a case says otherwise";
  for (const double cut_off : {-infinite, -1.0 / 3.0}) {
    JohnsonCookDamage law = law_of(constants.at("4340_JC85"));
    law.cut_off = cut_off;
    Point point{perfect_steel(law)};
    const double edge = std::exp(-0.5 * 500e6 / point.material.elasticity.kappa() / 3.0);
    for (double e = 0.0; e < 0.5; e += 1e-3)
      point.step(edge * Mat3(Eigen::Vector3d(std::exp(e), std::exp(-e / 2), std::exp(-e / 2)).asDiagonal()),
                 1e-3);
    EXPECT_EQ(point.state.damage[0] > 0.0, cut_off < -1.0);
  }
}

/// A perfectly plastic point under a mean stress of `triaxiality` flow stresses, stretched or sheared at an
/// angle to the axes: D = ε̄p · (σ1/σ_eq) · rate_of_damage.
void expect_damage(const DamageLaw& law, double per_strain_and_ratio) {
  constexpr double yield = 500e6;
  for (const double triaxiality : {-0.9, -0.2, 0.0, 1.0 / 3.0, 1.0})
    for (const bool shear : {false, true}) {
      Point point{perfect_steel(law)};
      const double edge = std::exp(triaxiality * yield / point.material.elasticity.kappa() / 3.0);
      const Mat3 turned = Eigen::AngleAxisd(0.4, Eigen::Vector3d::UnitZ()).toRotationMatrix();
      for (double e = 0.0; e < 0.2; e += 1e-3) {
        Mat3 f = Eigen::Vector3d(std::exp(e), std::exp(-e / 2), std::exp(-e / 2)).asDiagonal();
        if (shear) f << 1, std::numbers::sqrt3 * e, 0, 0, 1, 0, 0, 0, 1;
        point.step(edge * turned * f, 1e-3);
      }
      const double deviator = shear ? 1.0 / std::numbers::sqrt3 : 2.0 / 3.0;
      const double ratio = std::max(triaxiality + deviator, 0.0); // σ1/σ_eq
      const double expected = point.state.plastic_strain[0] * ratio * per_strain_and_ratio;
      EXPECT_NEAR(point.state.damage[0], expected, 0.02 * expected) << triaxiality << ' ' << shear;
      if (ratio == 0.0) { EXPECT_EQ(point.state.damage[0], 0.0); }
    }
}

TEST(CockcroftLathamDamage, is_the_work_of_the_largest_tension) {
  expect_damage(CockcroftLatham{.critical_work = 400e6}, 500e6 / 400e6);
}

TEST(CockcroftLathamDamage, by_the_flow_stress_is_a_strain) {
  expect_damage(NormalisedCockcroftLatham{.critical_strain = 0.8}, 1.0 / 0.8);
}

/// In space, across packs and tails: σ1 from the definition.
TEST(CockcroftLathamDamage, takes_the_largest_principal_stress_in_space) {
  constexpr std::size_t n = 19;
  PointState<3> s = points_at_rest<3>(n, 300.0);
  for (Field* f : {&s.damage, &s.softening, &s.initiation_strain}) f->assign(n, 0.0);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> number(-0.03, 0.03);
  for (std::size_t p = 0; p < n; ++p) {
    Mat3 f = Mat3::Identity();
    for (double& component : f.reshaped()) component += number(random);
    set_deformation<3>(s, p, f);
  }
  Material material = perfect_steel(NormalisedCockcroftLatham{.critical_strain = 1.0});
  ASSERT_EQ(update_stress<3>({material}, s.material, stress_points<3>(s), 0, n, 1e-3), -1);
  const Field length(n, 1e-4), volume(n, 1.0), opening(n, 0.0);
  update_damage<3>({material}, s.material, damage_points<3>(s, length, volume, opening), 0, n, 1e-3);
  int grown = 0;
  for (std::size_t p = 0; p < n; ++p) {
    const Eigen::SelfAdjointEigenSolver<Mat3> principal(kirchhoff<3>(s, p));
    const double ratio = std::max(principal.eigenvalues()[2], 0.0) / s.equivalent_stress[p];
    EXPECT_NEAR(s.damage[p], std::min(ratio * s.plastic_strain[p], 1.0), 1e-9) << p;
    grown += s.damage[p] > 0.0;
  }
  EXPECT_GT(grown, 5);
}

/// Plastic work per area of band from initiation on, in units of the fracture energy.
double cost_of_breaking(Point& point, double step) {
  double e = 0.0, before = 0.0;
  while (point.state.softening[0] < 1.0 && e < 10.0) {
    e += step;
    point.step(Eigen::Vector3d(std::exp(e), std::exp(-e / 2), std::exp(-e / 2)).asDiagonal(), step / 1e3);
    if (point.state.damage[0] < 1.0) before = point.state.plastic_work[0];
  }
  EXPECT_EQ(point.state.softening[0], 1.0);
  return (point.state.plastic_work[0] - before) * point.length / point.material.damage->fracture_energy;
}

TEST(damage, breaking_takes_the_fracture_energy_whatever_size_and_hardening) {
  for (const double length : {1e-4, 4e-4, 1e-3})
    for (const double hardening : {0.0, 400e6}) {
      Point point{perfect_steel(law_of({0.2, 0, 0, 0, 0}))};
      point.length = length;
      point.material.hardening = Linear{500e6, hardening};
      EXPECT_NEAR(cost_of_breaking(point, 2e-4 * 1e-4 / length), 1.0, 2e-3) << length << ' ' << hardening;
    }
}

TEST(damage, what_broken_matter_keeps_is_paid_from_the_fracture_energy) {
  Point point{perfect_steel(law_of({0.2, 0, 0, 0, 0}))};
  point.material.damage->residual_strength = 0.3;
  EXPECT_NEAR(cost_of_breaking(point, 2e-4), 1.0, 2e-3);
  const Mat3 f = general<2>(point.state.deformation, 0);
  for (double e = 0.01; e < 0.1; e += 1e-3) // in compression, as it is in shear
    point.step(f * Mat3(Eigen::Vector3d(std::exp(-e), std::exp(e / 2), std::exp(e / 2)).asDiagonal()), 1e-6);
  EXPECT_NEAR(point.state.equivalent_stress[0], 0.3 * 500e6, 1e-6 * 500e6);
}

/// Sheared under a pressure: √3 μ p, never more than sound matter bears and nothing in tension.
TEST(damage, broken_matter_under_pressure_bears_friction) {
  for (const double pressure : {-100e6, 0.0, 200e6, 600e6, 5e9})
    for (const double residual : {0.0, 0.3}) {
      Point point{perfect_steel(law_of({0.2, 0, 0, 0, 0}))};
      point.material.damage->friction = 0.4;
      point.material.damage->residual_strength = residual;
      point.state.damage[0] = point.state.softening[0] = 1.0;
      const double edge = std::exp(-pressure / point.material.elasticity.kappa() / 3.0);
      for (double e = 0.0; e < 0.05; e += 1e-3) {
        Mat3 f;
        f << 1, e, 0, 0, 1, 0, 0, 0, 1;
        point.step(edge * f, 1e-3);
      }
      const double friction = std::numbers::sqrt3 * 0.4 * std::max(pressure, 0.0);
      EXPECT_NEAR(point.state.equivalent_stress[0], std::clamp(friction, residual * 500e6, 500e6),
                  1e-5 * 500e6)
          << pressure << ' ' << residual;
    }
}

TEST(damage, friction_comes_as_the_point_softens) {
  Breaking breaking{.residual_strength = 0.2};
  EXPECT_DOUBLE_EQ(breaking.flow_share(0.0, 0.5), 1.0);
  EXPECT_DOUBLE_EQ(breaking.flow_share(0.5, 0.5), 0.75);
  EXPECT_DOUBLE_EQ(breaking.flow_share(1.0, 0.5), 0.5);
  EXPECT_DOUBLE_EQ(breaking.flow_share(1.0, 0.1), 0.2);
}

TEST(damage, strength_falls_linearly_with_the_opening) {
  Point point{perfect_steel(law_of({0.2, 0, 0, 0, 0}))};
  const double opening = 2.0 * point.material.damage->fracture_energy / 500e6; // u_f = 2 G_f/σ_y
  for (double e = 0.0; point.state.softening[0] < 0.95; e += 1e-3) {
    point.step(Eigen::Vector3d(std::exp(e), std::exp(-e / 2), std::exp(-e / 2)).asDiagonal(), 1e-3);
    if (point.state.damage[0] < 1.0) continue;
    const double opened = (point.state.plastic_strain[0] - point.state.initiation_strain[0]) * point.length;
    EXPECT_NEAR(point.state.softening[0], opened / opening, 2e-3);
    EXPECT_NEAR(point.state.equivalent_stress[0], 500e6 * (1.0 - opened / opening), 3e6);
  }
}

TEST(damage, a_point_of_broken_and_sound_matter_softens_once_their_means_add_up_to_one) {
  for (const auto& [damage, softening] : {std::pair{0.9, 0.8}, {0.6, 0.4}, {0.9, 0.05}}) {
    Point point{perfect_steel(law_of({0.2, 0, 0, 0, 0}))};
    const bool softens = damage + softening >= 1.0;
    point.state.damage[0] = damage;
    point.state.softening[0] = softening;
    for (double e = 0.0; point.state.plastic_strain[0] == 0.0; e += 1e-3)
      point.step(Eigen::Vector3d(std::exp(e), std::exp(-e / 2), std::exp(-e / 2)).asDiagonal(), 1e-3);
    const double used = softens ? 0.0 : point.state.plastic_strain[0] / 0.2;
    EXPECT_LT(used, 0.05);
    EXPECT_NEAR(point.state.damage[0], damage + used, 1e-12);
    EXPECT_EQ(point.state.softening[0] > softening, softens);
    EXPECT_EQ(point.state.initiation_strain[0], 0.0);
    if (softens) continue;
    for (double e = 5e-3; point.state.softening[0] == softening; e += 1e-3)
      point.step(Eigen::Vector3d(std::exp(e), std::exp(-e / 2), std::exp(-e / 2)).asDiagonal(), 1e-3);
    EXPECT_NEAR(point.state.damage[0] + softening, 1.0, 6e-3); // a step's growth
    EXPECT_GT(point.state.initiation_strain[0], 0.0);
  }
}

TEST(damage, a_broken_point_carries_pressure_but_neither_tension_nor_shear) {
  Point point{perfect_steel(law_of({0.0, 0, 0, 0, 0}))}; // breaks with the first flow
  cost_of_breaking(point, 1e-3);
  const double kappa = point.material.elasticity.kappa();
  const Mat3 f = general<2>(point.state.deformation, 0);
  for (const double volume : {1.02, 0.98}) {
    point.step(std::cbrt(volume) * f, 1e-3);
    const Mat3 tau = kirchhoff<2>(point.state, 0);
    const double expected = volume < 1.0 ? kappa * std::log(volume) : 0.0;
    EXPECT_LT((tau - expected * Mat3::Identity()).norm(), 1e-7 * kappa) << volume;
    EXPECT_NEAR(point.state.pressure[0], -expected, 1e-7 * kappa);
    EXPECT_NEAR(point.state.stored_energy[0], 0.5 * expected * expected / kappa, 1e-9 * kappa);
  }
}

TEST(damage, an_opening_takes_dilatation_without_tension) {
  Point point{perfect_steel(law_of({0.2, 0, 0, 0, 0}))};
  point.opening = 0.01;
  const double kappa = point.material.elasticity.kappa();
  double work = 0.0, last_tension = 0.0, last_volume = 1.0;
  for (int k = 1; k <= 500; ++k) {
    const double dilatation = 3e-2 * std::sin(2.0 * std::numbers::pi * k / 400),
                 volume = std::exp(dilatation);
    point.step(std::cbrt(volume) * Mat3::Identity(), 1e-6);
    const double tension = kappa * (std::max(dilatation - point.opening, 0.0) + std::min(dilatation, 0.0));
    EXPECT_NEAR(point.state.pressure[0], -tension, 1e-9 * kappa);
    EXPECT_NEAR((kirchhoff<2>(point.state, 0) - tension * Mat3::Identity()).norm(), 0.0, 1e-9 * kappa);
    EXPECT_NEAR(point.state.stored_energy[0], 0.5 * tension * tension / kappa, 1e-9 * kappa);
    work += 0.5 * (tension / volume + last_tension / last_volume) * (volume - last_volume);
    last_tension = tension, last_volume = volume;
    EXPECT_NEAR(work, point.state.stored_energy[0], 1e-6 * kappa);
  }
  EXPECT_EQ(point.released, 0.0);
}

TEST(damage, work_of_a_path_with_tension_is_accounted_for) {
  // Stress power = stored + plastic + let go, with a mean stress that rises while the point softens.
  Point point{perfect_steel(law_of({0.02, 0, 0, 0, 0}))};
  double work = 0.0;
  Mat3 last_f = Mat3::Identity(), last_p = Mat3::Zero();
  const int steps = 20000;
  for (int k = 1; k <= steps; ++k) {
    const double e = 2.0 * k / steps, edge = std::exp(0.002 * std::sin(2.0 * e) + 0.001 * e);
    const Mat3 f = edge * Mat3(Eigen::Vector3d(std::exp(e), std::exp(-e / 2), std::exp(-e / 2)).asDiagonal());
    point.step(f, 1e-6);
    const Mat3 p = general<2>(point.state.piola, 0);
    work += 0.5 * ((p + last_p).transpose() * (f - last_f)).trace();
    last_f = f, last_p = p;
  }
  EXPECT_GT(point.state.softening[0], 0.3);
  EXPECT_GT(point.released, 1e3);
  EXPECT_NEAR(point.state.stored_energy[0] + point.state.plastic_work[0] + point.released, work, 2e-4 * work);
}

} // namespace
} // namespace cnem::plasticity::test
