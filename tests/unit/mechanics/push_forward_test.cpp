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
  push_forward<2>(point);
  Mat<2> F, C;
  F << f[0], f[1], f[2], f[3];
  C << c[0], c[3], c[3], c[1];
  const Mat<2> expected = F * C * F.transpose();
  EXPECT_NEAR(point.inverse_plastic_cauchy_green[0][0], expected(0, 0), 1e-15);
  EXPECT_NEAR(point.inverse_plastic_cauchy_green[1][0], expected(1, 1), 1e-15);
  EXPECT_NEAR(point.inverse_plastic_cauchy_green[2][0], 1.2 * 1.2 * 1.1, 1e-15);
  EXPECT_NEAR(point.inverse_plastic_cauchy_green[3][0], expected(0, 1), 1e-15);
}

} // namespace
} // namespace cnem
