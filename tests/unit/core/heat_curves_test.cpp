// Enthalpies and potentials of tables against their integrals.
#include "core/heat_curves.hpp"

#include "core/error.hpp"
#include "core/piecewise_linear.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace cnem {
namespace {

HeatCurves curves() {
  HeatCurves made;
  made.at = {.value = {300.0, 500.0, 900.0}, .size = 3};
  made.specific_heat = {.value = {1.0, 1.5, 1.2}, .size = 3};
  made.conductivity = {.value = {1.0, 0.8, 2.0}, .size = 3};
  made.complete();
  return made;
}

TEST(HeatCurves, are_integrals_of_their_factors) {
  const HeatCurves made = curves();
  constexpr int parts = 1000; // of Simpson's rule, with kinks between parts
  for (const double end : {200.0, 300.0, 420.0, 500.0, 700.0, 900.0, 1500.0}) {
    double enthalpy = 300.0, potential = 300.0;
    const double h = (end - 300.0) / parts;
    for (int n = 0; n < parts; ++n)
      for (const auto& [s, weight] : {std::pair{0.0, 1.0 / 6.0}, {0.5, 4.0 / 6.0}, {1.0, 1.0 / 6.0}}) {
        enthalpy += h * weight * piecewise_linear(made.at, made.specific_heat, 300.0 + h * (n + s));
        potential += h * weight * piecewise_linear(made.at, made.conductivity, 300.0 + h * (n + s));
      }
    EXPECT_NEAR(made.enthalpy(end), enthalpy, 1e-3) << end;
    EXPECT_NEAR(made.potential(end), potential, 1e-3) << end;
  }
}

TEST(HeatCurves, give_back_what_was_warmed) {
  const HeatCurves made = curves();
  for (double temperature = 100.0; temperature < 1500.0; temperature += 7.0) {
    EXPECT_NEAR(made.temperature_of(made.enthalpy(temperature)), temperature, 1e-12 * temperature);
    const double warm = made.warmed(temperature, 123.0);
    EXPECT_NEAR(made.rise(temperature, warm), 123.0, 1e-11);
    EXPECT_NEAR(made.warmed(warm, -123.0), temperature, 1e-11);
  }
}

TEST(HeatCurves, bound_how_quick_exchange_is) {
  EXPECT_DOUBLE_EQ(curves().quickest, 1.2 / 2.0);
  HeatCurves poor = curves();
  poor.conductivity = {.value = {0.5, 0.5, 0.5}, .size = 3};
  poor.complete();
  EXPECT_DOUBLE_EQ(poor.quickest, 1.0) << "what flows to a tool knows no conductivity";
}

TEST(HeatCurves, one_factor_alone_leaves_the_other) {
  HeatCurves made;
  made.at = {.value = {300.0, 500.0}, .size = 2};
  made.specific_heat = {.value = {1.0, 3.0}, .size = 2};
  made.complete();
  EXPECT_DOUBLE_EQ(made.potential(450.0), 450.0);
  EXPECT_DOUBLE_EQ(made.enthalpy(500.0), 700.0);
}

TEST(HeatCurves, without_points_are_none) {
  HeatCurves none;
  none.complete();
  EXPECT_EQ(none.warmed(300.1, 0.2), 300.1 + 0.2);
  EXPECT_EQ(none.potential(300.1), 300.1);
  EXPECT_EQ(none.quickest, 1.0);
}

} // namespace
} // namespace cnem
