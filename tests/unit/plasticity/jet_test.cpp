// Numbers with derivatives against differences of the same functions.
#include "plasticity/jet.hpp"

#include <gtest/gtest.h>

namespace cnem::plasticity::generic {
namespace {

/// All functions and operators of formulas.
template<class N> N formula(N x) {
  const N a = 2.0 - power(x, 0.3) * exponential(0.5 * x), b = logarithm(x) + 1.5;
  return (a * b + at_least(x, 0.5) - x * x) / 3.0 + (x - 1.0) - (0.25 + x) * 2.0;
}

TEST(Jet, has_the_derivatives_of_its_value) {
  const double h = 1e-5;
  for (const double x : {0.1, 0.7, 3.0}) {
    const Jet<double> jet = formula(Jet<double>(x, 1.0, 0.0));
    EXPECT_DOUBLE_EQ(jet.value, formula(x));
    EXPECT_NEAR(jet.first, (formula(x + h) - formula(x - h)) / (2 * h), 1e-7);
    EXPECT_NEAR(jet.second, (formula(x + h) - 2 * formula(x) + formula(x - h)) / (h * h), 1e-3);
  }
}

TEST(Jet, of_a_constant_has_none) {
  const Jet<double> jet = formula(Jet<double>(0.7));
  EXPECT_DOUBLE_EQ(jet.value, formula(0.7));
  EXPECT_EQ(jet.first, 0.0);
  EXPECT_EQ(jet.second, 0.0);
}

} // namespace
} // namespace cnem::plasticity::generic
