// Metals without stress out of the plane: thickness, yield, work, and a reference that is renewed.
#include "mechanics/kinematics.hpp"
#include "tests/unit/plasticity/ply_points.hpp"

#include <gtest/gtest.h>

namespace cnem::plasticity::test {
namespace {

PointState<2> thin_points(std::size_t n) {
  PointState<2> s = points_at_rest<2>(n, 296.0);
  s.thin.switch_on(true);
  s.thin.rest(n);
  return s;
}

void set(PointState<2>& s, std::size_t p, const Mat2& F) {
  for (std::size_t k = 0; k < 4; ++k) s.deformation[k][p] = F(as<int>(k / 2), as<int>(k % 2));
}

TEST(PlaneStress, elastic_sheets_are_those_of_hooke) {
  Material m = steel();
  m.hardening.reset();
  PointState<2> s = thin_points(1);
  const double ex = 3e-3, ey = -1e-3, E = 210e9, nu = 0.33;
  set(s, 0, Eigen::Vector2d(std::exp(ex), std::exp(ey)).asDiagonal());
  ASSERT_LT(update(m, s, 0.0), 0);
  EXPECT_NEAR(s.piola[0][0] * std::exp(ex), E / (1 - nu * nu) * (ex + nu * ey), 1e-3);
  EXPECT_NEAR(s.piola[3][0] * std::exp(ey), E / (1 - nu * nu) * (ey + nu * ex), 1e-3);
  EXPECT_NEAR(s.piola[4][0], 0.0, 1e-1);
  EXPECT_NEAR(std::log(s.thickness[0]), -nu / (1 - nu) * (ex + ey), 1e-12);
  EXPECT_NEAR(s.stress_free[0], 1.0, 1e-14); // per initial thickness
}

TEST(PlaneStress, sheets_that_cannot_narrow_flow_at_two_over_root_three) {
  Material m = steel();
  m.hardening = Linear{300e6, 1e9};
  PointState<2> s = thin_points(1);
  double work = 0.0, stress = 0.0, last = 1.0;
  const int steps = 2000;
  for (int k = 1; k <= steps; ++k) {
    const double stretch = std::exp(0.4 * k / steps);
    set(s, 0, Eigen::Vector2d(stretch, 1.0).asDiagonal());
    ASSERT_LT(update(m, s, 1e-3), 0);
    work += 0.5 * (stress + s.piola[0][0]) * (stretch - last);
    stress = s.piola[0][0], last = stretch;
  }
  const double flow = 300e6 + 1e9 * s.plastic_strain[0], tau = stress * last;
  // what is elastic of the strain along and across: (τ_xx − ν τ_yy)/E and (1 − 2ν) tr τ/E of the volume
  const double E = 210e9, nu = 0.33;
  EXPECT_NEAR(s.plastic_strain[0], 2.0 / std::sqrt(3.0) * (0.4 - (1.0 - 0.5 * nu) * tau / E), 1e-3);
  EXPECT_NEAR(tau, 2.0 / std::sqrt(3.0) * flow, 1e-4 * flow);
  EXPECT_NEAR(s.piola[3][0], 0.5 * tau, 1e-3 * tau);
  EXPECT_LT(std::abs(s.piola[4][0]), 1.0);
  EXPECT_NEAR(std::log(s.thickness[0]), -0.4 + (1.0 - 2.0 * nu) / E * 1.5 * tau,
              1e-5); // plastic flow keeps it
  EXPECT_NEAR(work, s.plastic_work[0] + s.stored_energy[0], 1e-4 * work);
}

TEST(PlaneStress, a_new_reference_changes_nothing) {
  const Material m = steel();
  PointState<2> s = thin_points(40), fresh = thin_points(40); // more than are held at a time
  const auto deformation = [](std::size_t p, double share) {
    const Mat2 G = (Mat2() << 0.1 + 0.004 * double(p), 0.05, -0.02 * double(p % 3), -0.08).finished();
    return (Mat2::Identity() + share * G).eval();
  };
  for (std::size_t p = 0; p < 40; ++p) {
    set(s, p, deformation(p, 0.5));
    set(fresh, p, deformation(p, 0.5));
  }
  ASSERT_LT(update(m, s, 1e-6), 0);
  ASSERT_LT(update(m, fresh, 1e-6), 0);
  push_forward(fresh);
  for (std::size_t p = 0; p < 40; ++p) set(fresh, p, Mat2::Identity());
  ASSERT_LT(update(m, fresh, 0.0), 0);
  for (std::size_t p = 0; p < 40; ++p) {
    set(s, p, deformation(p, 1.0));
    set(fresh, p, deformation(p, 1.0) * deformation(p, 0.5).inverse());
  }
  ASSERT_LT(update(m, s, 1e-6), 0);
  ASSERT_LT(update(m, fresh, 1e-6), 0);
  for (std::size_t p = 0; p < 40; ++p) {
    EXPECT_NEAR(fresh.stress_free[p], 1.0 / deformation(p, 0.5).determinant(), 1e-12);
    EXPECT_NEAR(fresh.thickness[p], s.thickness[p], 1e-12);
    EXPECT_NEAR(fresh.plastic_strain[p], s.plastic_strain[p], 1e-12);
    EXPECT_NEAR(fresh.equivalent_stress[p], s.equivalent_stress[p], 1e-10 * s.equivalent_stress[p]);
    // P of the first reference over that of the new one
    const Mat2 old = (Mat2() << s.piola[0][p], s.piola[1][p], s.piola[2][p], s.piola[3][p]).finished();
    const Mat2 now =
        (Mat2() << fresh.piola[0][p], fresh.piola[1][p], fresh.piola[2][p], fresh.piola[3][p]).finished();
    const Mat2 half = deformation(p, 0.5);
    EXPECT_LT((now - old * half.transpose() / half.determinant()).norm(), 1e-9 * old.norm()) << p;
  }
}

TEST(PlaneStress, points_do_not_know_their_neighbours) {
  const Material m = steel();
  PointState<2> all = thin_points(37), alone = thin_points(1);
  for (std::size_t p = 0; p < 37; ++p)
    set(all, p, (Mat2() << 1.0 + 0.01 * double(p), 0.02, 0.0, 1.0 - 0.004 * double(p)).finished());
  ASSERT_LT(update(m, all, 1e-6), 0);
  for (const std::size_t p : {0u, 12u, 31u, 32u, 36u}) {
    alone = thin_points(1);
    set(alone, 0, (Mat2() << 1.0 + 0.01 * double(p), 0.02, 0.0, 1.0 - 0.004 * double(p)).finished());
    ASSERT_LT(update(m, alone, 1e-6), 0);
    EXPECT_EQ(alone.piola[0][0], all.piola[0][p]);
    EXPECT_EQ(alone.thickness[0], all.thickness[p]);
    EXPECT_EQ(alone.plastic_strain[0], all.plastic_strain[p]);
  }
}

} // namespace
} // namespace cnem::plasticity::test
