// C_p⁻¹ goes to a new reference as F C_p⁻¹ Fᵀ, in the plane and in space.
#include "core/index.hpp"
#include "core/vec.hpp"
#include "mechanics/kinematics.hpp"

#include <gtest/gtest.h>

namespace cnem {
namespace {

TEST(PushForward, is_F_C_Ft_in_space) {
  constexpr int place[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}};
  Mat<3> f, c;
  f << 1.1, 0.2, -0.3, 0.05, 0.9, 0.4, -0.1, 0.15, 1.2;
  c << 1.3, 0.1, -0.2, 0.1, 0.8, 0.3, -0.2, 0.3, 1.1;
  PointState<3> point;
  point.table.rest(2);
  for (std::size_t p = 0; p < 2; ++p) {
    const double scale = 1.0 + static_cast<double>(p);
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k) point.deformation[index_of(3 * i + k)][p] = scale * f(i, k);
    for (std::size_t s = 0; s < 6; ++s)
      point.inverse_plastic_cauchy_green[s][p] = c(place[s][0], place[s][1]);
  }
  push_forward<3>(point);
  const Mat<3> expected = f * c * f.transpose();
  for (std::size_t p = 0; p < 2; ++p)
    for (std::size_t s = 0; s < 6; ++s)
      EXPECT_NEAR(point.inverse_plastic_cauchy_green[s][p],
                  (p == 0 ? 1.0 : 4.0) * expected(place[s][0], place[s][1]), 1e-14);
}

TEST(PushForward, keeps_the_direction_out_of_the_plane) {
  PointState<2> point;
  point.table.rest(1);
  const double f[5] = {1.1, 0.2, -0.3, 0.9, 1.2}, c[4] = {1.3, 0.8, 1.1, 0.1}; // xx xy yx yy zz; xx yy zz xy
  for (std::size_t k = 0; k < 5; ++k) point.deformation[k][0] = f[k];
  for (std::size_t k = 0; k < 4; ++k) point.inverse_plastic_cauchy_green[k][0] = c[k];
  point.oriented.switch_on(true);
  point.oriented.rest(1);
  const double earlier[5] = {0.9, 0.4, 0.1, 1.3, 0.8};
  for (std::size_t k = 0; k < 5; ++k) point.earlier_deformation[k][0] = earlier[k];
  push_forward<2>(point);
  Mat<2> F, C;
  F << f[0], f[1], f[2], f[3];
  C << c[0], c[3], c[3], c[1];
  const Mat<2> expected = F * C * F.transpose();
  EXPECT_NEAR(point.inverse_plastic_cauchy_green[0][0], expected(0, 0), 1e-15);
  EXPECT_NEAR(point.inverse_plastic_cauchy_green[1][0], expected(1, 1), 1e-15);
  EXPECT_NEAR(point.inverse_plastic_cauchy_green[2][0], 1.2 * 1.2 * 1.1, 1e-15);
  EXPECT_NEAR(point.inverse_plastic_cauchy_green[3][0], expected(0, 1), 1e-15);
  Mat<2> before;
  before << earlier[0], earlier[1], earlier[2], earlier[3];
  const Mat<2> total = F * before;
  for (std::size_t k = 0; k < 4; ++k)
    EXPECT_NEAR(point.earlier_deformation[k][0], total(static_cast<int>(k / 2), static_cast<int>(k % 2)),
                1e-15);
  EXPECT_NEAR(point.earlier_deformation[4][0], 1.2 * 0.8, 1e-15);
}

TEST(PushForward, takes_the_axes_of_a_material_along_in_space) {
  PointState<3> point;
  point.table.rest(1);
  point.oriented.switch_on(true);
  point.oriented.rest(1);
  Mat<3> f, before;
  f << 1.1, 0.2, -0.1, 0.3, 0.9, 0.2, 0.0, -0.2, 1.2;
  before << 0.8, 0.1, 0.0, -0.3, 1.2, 0.1, 0.2, 0.0, 1.1;
  for (int k = 0; k < 9; ++k) {
    point.deformation[index_of(k)][0] = f(k / 3, k % 3);
    point.earlier_deformation[index_of(k)][0] = before(k / 3, k % 3);
  }
  push_forward<3>(point);
  const Mat<3> total = f * before;
  for (int k = 0; k < 9; ++k)
    EXPECT_NEAR(point.earlier_deformation[index_of(k)][0], total(k / 3, k % 3), 1e-15);
}

} // namespace
} // namespace cnem
