#pragma once
// A stress point of a ply, in the plane.
#include "plasticity/ply_update.hpp"
#include "tests/unit/plasticity/points.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace cnem::plasticity::test {

using Mat2 = Eigen::Matrix2d;

inline Mat2 turn(double angle) { return Eigen::Rotation2Dd(angle).toRotationMatrix(); }
inline constexpr double degrees = std::numbers::pi / 180.0;

/// UD-GFRP of paper 000, Table 2, with the out-of-plane constants of docs/theory.md.
inline Material gfrp(double angle) {
  Material m;
  m.name = "gfrp";
  m.density = 1580.0;
  m.ply = Orthotropic{.E1 = 34.28e9,
                      .E2 = 11.57e9,
                      .nu12 = 0.24244,
                      .G12 = 2.05e9,
                      .angle = angle,
                      .E3 = 11.57e9,
                      .nu13 = 0.24244,
                      .nu23 = 0.4};
  return m;
}

/// One point, at rest.
struct PlyPoint {
  PointState<2> state = points_at_rest<2>(1, 293.15);
  Material material;

  explicit PlyPoint(Material m, bool stress_free = true, double length = 1e-4) : material(std::move(m)) {
    for (FieldTable* table : {&state.oriented, &state.fibrous}) table->switch_on(true), table->rest(1);
    state.thin.switch_on(stress_free);
    state.thin.rest(1);
    state.failing.switch_on(material.failure.has_value());
    state.failing.rest(1);
    state.flowing.switch_on(material.hardening.has_value());
    state.flowing.rest(1);
    if (material.failure) state.failure_length[0] = length;
    set(Mat2::Identity(), 0.0);
  }
  /// F from the reference, over a step of dt; whether it means something.
  bool set(const Mat2& F, double dt) {
    for (std::size_t k = 0; k < 4; ++k) state.deformation[k][0] = F(as<int>(k / 2), as<int>(k % 2));
    return update_stress(material, stress_points(state), 0, 1, dt) < 0;
  }
  void set_earlier(const Mat2& F) {
    for (std::size_t k = 0; k < 4; ++k) state.earlier_deformation[k][0] = F(as<int>(k / 2), as<int>(k % 2));
  }
  Mat2 piola() const {
    return (Mat2() << state.piola[0][0], state.piola[1][0], state.piola[2][0], state.piola[3][0]).finished();
  }
  /// Per reference volume, J/m³.
  double energy() const { return state.stored_energy[0] * state.stress_free[0]; }
};

/// F without rotation whose ½ ln C has these components in axes turned by an angle: ε11, ε22, γ12.
inline Mat2 stretch(const Eigen::Vector3d& e, double angle) {
  const Mat2 own = (Mat2() << e[0], 0.5 * e[2], 0.5 * e[2], e[1]).finished();
  const Mat2 E = turn(angle) * own * turn(-angle);
  const Eigen::SelfAdjointEigenSolver<Mat2> axes(E);
  return axes.eigenvectors() * axes.eigenvalues().array().exp().matrix().asDiagonal() *
         axes.eigenvectors().transpose();
}

/// P at F is the derivative of the stored energy, which is that of a step without time.
inline void expect_derivative_of_energy(PlyPoint& point, const Mat2& F) {
  ASSERT_TRUE(point.set(F, 0.0));
  const Mat2 P = point.piola();
  const double step = 1e-5;
  for (int i = 0; i < 2; ++i)
    for (int k = 0; k < 2; ++k) {
      double energy[2];
      for (const int side : {0, 1}) {
        Mat2 near = F;
        near(i, k) += side == 0 ? -step : step;
        ASSERT_TRUE(point.set(near, 0.0));
        energy[side] = point.energy();
      }
      EXPECT_NEAR(P(i, k), (energy[1] - energy[0]) / (2.0 * step), 1e-7 * P.norm() + 1e-7 * 1e9) << i << k;
    }
}

} // namespace cnem::plasticity::test
