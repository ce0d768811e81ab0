// Ductile damage in plane stress, of plies and of metals: what breaking takes, what broken matter bears, and
// the work of whole paths.
#include "plasticity/damage.hpp"
#include "tests/unit/plasticity/ply_points.hpp"

#include <gtest/gtest.h>

#include <random>

namespace cnem::plasticity::test {
namespace {

constexpr double fracture_energy = 132.0, onset = 0.01;

/// At a strain of 1% whatever the stress.
Damage ductile() {
  return {{.fracture_energy = fracture_energy},
          JohnsonCookDamage{.D1 = onset, .D2 = 0.0, .D3 = 0.0, .cut_off = -infinite}};
}

/// Flax of paper 001 that hardens as assumed.
Material flax() {
  Material m;
  m.density = 1500.0;
  m.ply =
      Orthotropic{.E1 = 50e9, .E2 = 12e9, .nu12 = 0.178, .G12 = 3.4e9, .E3 = 12e9, .nu13 = 0.2, .nu23 = 0.2};
  m.anisotropy = HillRatios{.R22 = 0.2, .R33 = 0.2, .R12 = 0.046188, .R13 = 0.046188, .R23 = 0.046188};
  m.hardening = Linear{300e6, 2e9};
  m.damage = ductile();
  return m;
}
Material pla() {
  Material m;
  m.density = 1250.0;
  m.elasticity = {1.4e9, 0.35};
  m.hardening = Linear{40e6, 2e8};
  m.damage = ductile();
  return m;
}

/// A point of plane stress that is taken along a path as the solver takes it.
class ThinPoint {
public:
  explicit ThinPoint(Material material) : point_(std::move(material)) {
    PointState<2>& s = point_.state;
    s.damaged.switch_on(true);
    s.damaged.rest(1);
    s.flow_factor[0] = 1.0;
  }

  void step(const Mat2& F) {
    PointState<2>& s = point_.state;
    const Mat2 before = point_.piola();
    s.flow_factor[0] = flow_share<2>(point_.material, s, 0, s.pressure[0]);
    ASSERT_TRUE(point_.set(F, 1e-6));
    update_damage<2>({point_.material}, s.material, damage_points<2>(s, {length}, {1.0}, {0.0}), 0, 1, 1e-6);
    EXPECT_GE(s.dissipation[0], 0.0);
    work += (0.5 * (before + point_.piola()).array() * (F - last_).array()).sum();
    last_ = F;
  }
  /// From here on to F, straight in the gradient.
  void go(const Mat2& F, int steps) {
    const Mat2 from = last_;
    for (int k = 1; k <= steps; ++k) step(from + k * (F - from) / steps);
  }

  static constexpr double length = 2e-6;
  double work = 0.0; ///< J/m³
  const PointState<2>& state() const { return point_.state; }
  Mat2 piola() const { return point_.piola(); }
  /// Kept and taken, J/m³.
  double energy() const { return state().stored_energy[0] + state().plastic_work[0]; }

private:
  PlyPoint point_;
  Mat2 last_ = Mat2::Identity();
};

Mat2 pulled(double strain, double angle) {
  const Mat2 F = Eigen::Vector2d(std::exp(strain), 1.0).asDiagonal();
  return turn(angle) * F * turn(-angle);
}

TEST(ThinDamage, breaking_takes_the_fracture_energy_in_any_direction) {
  for (const Material& material : {flax(), pla()})
    for (const double angle : {0.0, 45.0 * degrees, 90.0 * degrees}) {
      ThinPoint point(material);
      double before = 0.0; // plastic work up to D = 1
      double softened = 1.0;
      for (int k = 1; k <= 20000 && point.state().softening[0] < 1.0; ++k) {
        point.step(pulled(1e-4 * k, angle));
        if (point.state().damage[0] < 1.0) before = point.state().plastic_work[0];
        EXPECT_LE(1.0 - point.state().softening[0], softened);
        softened = 1.0 - point.state().softening[0];
      }
      EXPECT_EQ(point.state().softening[0], 1.0) << angle;
      EXPECT_NEAR(point.state().initiation_strain[0], onset, 2e-4);
      EXPECT_NEAR((point.state().plastic_work[0] - before) * ThinPoint::length, fracture_energy,
                  0.01 * fracture_energy)
          << angle;
      EXPECT_NEAR(point.energy(), point.work, 1e-3 * point.work) << angle;
      point.go(pulled(3.0, angle), 10);
      EXPECT_LT(point.piola().norm(), 1e-6 * 1e9) << angle;
    }
}

/// Broken in tension along x, and closed again.
ThinPoint broken(const Material& material) {
  ThinPoint point(material);
  point.go(pulled(2.0, 0.0), 4000);
  EXPECT_EQ(point.state().softening[0], 1.0);
  point.go(Mat2::Identity(), 400);
  return point;
}

TEST(ThinDamage, closed_cracks_bear_pressure_alone) {
  for (const Material& material : {flax(), pla()}) {
    ThinPoint point = broken(material);
    point.go(0.97 * Mat2::Identity(), 100);
    const Mat2 P = point.piola();
    EXPECT_LT(P(0, 0), 0.0);
    EXPECT_NEAR(P(0, 0), P(1, 1), 1e-6 * P.norm());
    EXPECT_LT(std::abs(P(0, 1)), 1e-6 * P.norm());
    point.go(0.97 * (Mat2() << 1.0, 0.5, 0.0, 1.0).finished(), 200); // no shear on them
    const Mat2 cauchy = point.piola() * (0.97 * (Mat2() << 1.0, 0.5, 0.0, 1.0).finished()).transpose();
    EXPECT_LT(std::abs(cauchy(0, 1)), 1e-6 * cauchy.norm());
    point.go(1.05 * Mat2::Identity(), 200);
    EXPECT_LT(point.piola().norm(), 1e-6 * 1e9);
  }
}

TEST(ThinDamage, plies_bear_pressure_by_their_stiffness_against_it) {
  const Material material = flax();
  ThinPoint point = broken(material);
  const Orthotropic& ply = *material.ply;
  const double K = 1.0 / (1.0 / ply.E1 + 1.0 / ply.E2 - 2.0 * ply.nu12 / ply.E1);
  point.go(0.99 * Mat2::Identity(), 100);
  const double first = 0.99 * point.piola()(0, 0);
  point.go(0.98 * Mat2::Identity(), 100);
  EXPECT_NEAR(0.98 * point.piola()(0, 0) - first, 2.0 * K * std::log(0.98 / 0.99), 1e-6 * K);
}

TEST(ThinDamage, random_paths_of_breaking_matter_dissipate_and_close_their_balance) {
  std::mt19937 generator(18);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  for (const Material& material : {flax(), pla()})
    for (int path = 0; path < 4; ++path) {
      ThinPoint point(material);
      for (int leg = 0; leg < 6; ++leg) {
        const Mat2 F = turn(any(generator)) *
                       stretch({0.15 * any(generator), 0.15 * any(generator), 0.3 * any(generator)}, 0.0);
        const double work = point.work, energy = point.energy();
        point.go(F, 4000);
        EXPECT_NEAR(point.work - work, point.energy() - energy, 5e-3 * std::abs(point.energy()))
            << path << leg;
      }
      EXPECT_GT(point.state().softening[0], 0.0);
    }
}

} // namespace
} // namespace cnem::plasticity::test
