// The elementary functions of the kernels on double; packs run the same template (tests/unit/plasticity).
#include "core/machine/simd.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace cnem {
namespace {

/// Error in units of the last place of the exact value.
double ulps(double computed, long double exact) {
  const double rounded = static_cast<double>(exact);
  const double unit = std::nextafter(std::abs(rounded), INFINITY) - std::abs(rounded);
  return static_cast<double>(std::abs(computed - exact)) / unit;
}

TEST(simd, logarithm_to_one_ulp) {
  std::mt19937_64 random(1);
  double worst = 0.0;
  for (int k = 0; k < 300000; ++k) {
    const double near = std::exp(std::uniform_real_distribution<double>(-1.0, 1.0)(random));
    const double far = std::exp(std::uniform_real_distribution<double>(-700.0, 700.0)(random));
    const double close = 1.0 + std::uniform_real_distribution<double>(-1e-3, 1e-3)(random);
    for (double x : {near, far, close})
      worst = std::max(worst, ulps(generic::log(x), std::log(static_cast<long double>(x))));
  }
  EXPECT_LT(worst, 1.0);
  EXPECT_EQ(generic::log(1.0), 0.0);
  EXPECT_LE(generic::log(0.0), -708.0);
}

TEST(simd, several_logarithms_share_a_division) {
  std::mt19937_64 random(2);
  double worst = 0.0;
  for (int k = 0; k < 300000; ++k) {
    double x[3], y[3];
    for (double& v : x) v = std::exp(std::uniform_real_distribution<double>(-2.0, 2.0)(random));
    generic::logarithms(x, y);
    for (int c = 0; c < 3; ++c) worst = std::max(worst, ulps(y[c], std::log(static_cast<long double>(x[c]))));
  }
  EXPECT_LT(worst, 1.5);
}

TEST(simd, exponential_to_one_ulp) {
  std::mt19937_64 random(3);
  double worst = 0.0;
  for (int k = 0; k < 300000; ++k)
    for (double range : {1e-3, 1.0, 700.0}) {
      const double x = std::uniform_real_distribution<double>(-range, range)(random);
      worst = std::max(worst, ulps(generic::exp(x), std::exp(static_cast<long double>(x))));
    }
  EXPECT_LT(worst, 1.0);
  EXPECT_EQ(generic::exp(0.0), 1.0);
}

TEST(simd, reciprocals) {
  double inverse[4];
  generic::reciprocals({2.0, -0.25, 1e-100, 3e50}, inverse);
  const double exact[] = {0.5, -4.0, 1e100, 1.0 / 3e50};
  for (int k = 0; k < 4; ++k) EXPECT_LT(ulps(inverse[k], exact[k]), 4.0);
}

TEST(simd, selection_and_polynomials) {
  EXPECT_EQ(generic::max(1.0, 2.0), 2.0);
  EXPECT_EQ(generic::min(1.0, 2.0), 1.0);
  EXPECT_EQ(generic::max(std::nan(""), 2.0), 2.0);
  EXPECT_EQ(generic::abs(-3.0), 3.0);
  EXPECT_EQ(generic::select(true, 1.0, 2.0), 1.0);
  const double c[] = {1.0, 2.0, 3.0};
  EXPECT_EQ(generic::polynomial(2.0, c), 17.0);
}

} // namespace
} // namespace cnem
