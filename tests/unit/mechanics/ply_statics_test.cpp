// Statics of plies: patches pulled and sheared off the axes of the fibres, and everything turned.
#include "cnem/scni.hpp"
#include "mechanics/statics/statics.hpp"
#include "methods/fe_simplices.hpp"
#include "tests/clouds.hpp"
#include "tests/degree.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

namespace cnem::testing {
namespace {

plasticity::Orthotropic glass(double angle) {
  return {.E1 = 34.28e9,
          .E2 = 11.57e9,
          .nu12 = 0.24244,
          .G12 = 2.05e9,
          .angle = angle,
          .E3 = 11.57e9,
          .nu13 = 0.24244};
}

/// The compliance off the axes (Jones, Mechanics of Composite Materials, 2.97), 1/Pa: εxx, εyy, γxy of σxx
/// and of σxy.
struct OffAxis {
  double xx, xy, xs, ss, ys;
  explicit OffAxis(const plasticity::Orthotropic& p) {
    const double c = std::cos(p.angle), s = std::sin(p.angle);
    const double S11 = 1 / p.E1, S22 = 1 / p.E2, S12 = -p.nu12 / p.E1, S66 = 1 / p.G12;
    xx = S11 * c * c * c * c + (2 * S12 + S66) * s * s * c * c + S22 * s * s * s * s;
    xy = S12 * (s * s * s * s + c * c * c * c) + (S11 + S22 - S66) * s * s * c * c;
    xs = (2 * S11 - 2 * S12 - S66) * s * c * c * c - (2 * S22 - 2 * S12 - S66) * s * s * s * c;
    ys = (2 * S11 - 2 * S12 - S66) * s * s * s * c - (2 * S22 - 2 * S12 - S66) * s * c * c * c;
    ss = 2 * (2 * S11 + 2 * S22 - 4 * S12 - S66) * s * s * c * c + S66 * (s * s * s * s + c * c * c * c);
  }
};

/// A unit square under tension and shear, in axes turned by `turn`; no rigid motion is left, and none is
/// held.
void check_patch(Discretisation<2>& method, double angle, double turn, const Mat<2>& stress) {
  using Kind = Support<2>::Kind;
  const Mat<2> R = Eigen::Rotation2Dd(turn).toRotationMatrix();
  const Cloud<2> own = jittered_square(0.1, 0.25, 3);
  Cloud<2> cloud = own;
  for (Vec2& x : cloud.position) x = R * x;
  const auto count = static_cast<std::size_t>(cloud.nodes());
  NodeIndex origin{}, corner{};
  for (const NodeIndex i : own.position.indices()) {
    if (own.position[i].norm() == 0.0) origin = i;
    if ((own.position[i] - Vec2(0, 1)).norm() < 1e-12) corner = i;
  }
  const Supports<2> supports({{"x", Kind::displacement, R.col(0), TimeTable(0.0), {origin, corner}, {}},
                              {"y", Kind::displacement, R.col(1), TimeTable(0.0), {origin}, {}}},
                             count);
  Fields<2> force;
  resize_all(force, count);
  for (const Facet<2>& facet : own.facets) {
    const Vec2 edge = own.position[facet.node[1]] - own.position[facet.node[0]];
    const Vec2 pull = R * (stress * Vec2(edge.y(), -edge.x()));
    for (const NodeIndex i : facet.node)
      for (int k : {0, 1}) force[static_cast<std::size_t>(k)][static_cast<std::size_t>(i)] += 0.5 * pull[k];
  }
  const Approximation<2> approximation = method.rebuild(cloud);
  const plasticity::Orthotropic ply = glass(angle);
  const StaticSolution<2> s = solve_statics<2>({.operators = approximation.mechanics,
                                                .position = cloud.position,
                                                .links = approximation.links,
                                                .link_points = approximation.mechanics,
                                                .elasticity = {},
                                                .ply = plasticity::plane_stiffness(glass(angle + turn), true),
                                                .out_of_plane = OutOfPlane::stress_free,
                                                .supports = supports,
                                                .force = force});
  const OffAxis S(ply);
  const double sx = stress(0, 0), st = stress(0, 1);
  const double exx = S.xx * sx + S.xs * st, eyy = S.xy * sx + S.ys * st, shear = S.xs * sx + S.ss * st;
  const double size = std::abs(exx) + std::abs(eyy) + std::abs(shear);
  for (const NodeIndex i : own.position.indices()) { // u_x = 0 at (0, 1), so that all of γ is in u_y
    const Vec2 x = own.position[i], wanted = R * Vec2(exx * x.x(), eyy * x.y() + shear * x.x());
    const auto n = static_cast<std::size_t>(i);
    EXPECT_NEAR(s.displacement[0][n], wanted.x(), 1e-9 * size) << angle / degree << " " << turn;
    EXPECT_NEAR(s.displacement[1][n], wanted.y(), 1e-9 * size) << angle / degree << " " << turn;
  }
  const double zz = -ply.nu13 / ply.E1, zz2 = -ply.nu23 / ply.E2; // εzz of σ11, σ22
  const double c = std::cos(angle), sn = std::sin(angle);
  const double s1 = c * c * sx + 2 * c * sn * st, s2 = sn * sn * sx - 2 * c * sn * st;
  EXPECT_NEAR(s.gradient[4][7], zz * s1 + zz2 * s2, 1e-9 * size);
  EXPECT_NEAR(s.strain_energy, 0.5 * (sx * exx + st * shear), 1e-9 * size);
  EXPECT_LT(s.stabilisation_energy, 1e-9 * s.strain_energy);
}

TEST(PlyStatics, patches_off_the_axes_are_exact_and_turn_with_everything) {
  const Mat<2> pulled = (Mat<2>() << 1, 0, 0, 0).finished(), sheared = (Mat<2>() << 0, 1, 1, 0).finished();
  scni::Cnem cnem;
  methods::FeTriangles triangles;
  for (Discretisation<2>* method :
       {static_cast<Discretisation<2>*>(&cnem), static_cast<Discretisation<2>*>(&triangles)})
    for (const double angle : {0.0, 25.0, 45.0, 70.0, 90.0})
      for (const double turn : {0.0, 37.0})
        for (const Mat<2>& stress : {pulled, sheared})
          check_patch(*method, angle * degree, turn * degree, stress);
}

} // namespace
} // namespace cnem::testing
