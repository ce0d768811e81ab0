// Mie and Grüneisen's equation of state at a point: (5) of paper 002 with the energy that compression takes.
#include "plasticity/equation_of_state.hpp"
#include "plasticity/material.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace cnem::plasticity::test {
namespace {

constexpr double bulk = 76e9;

/// Constants with and without the higher ones.
std::vector<MieGruneisen> laws() {
  return {{.S1 = 1.338, .gamma0 = 2.0},
          {.S1 = 1.338, .gamma0 = 2.0, .b = 0.48},
          {.S1 = 1.49, .S2 = 0.3, .S3 = -0.2, .gamma0 = 1.67, .b = 1.2},
          {.S1 = 0.0, .gamma0 = 0.0}};
}

/// p of (5), Pa.
double printed(const MieGruneisen& law, double mu, double energy) {
  const double top = bulk * mu * (1.0 + (1.0 - 0.5 * law.gamma0) * mu - 0.5 * law.b * mu * mu);
  const double bottom = 1.0 - (law.S1 - 1.0) * mu - law.S2 * mu * mu / (mu + 1.0) -
                        law.S3 * std::pow(mu, 3) / std::pow(mu + 1.0, 2);
  return top / (bottom * bottom) + (law.gamma0 + law.b * mu) * energy;
}

/// E(μ) of dE/dμ = p/(1 + μ)² by the classical Runge-Kutta method.
double compressed_energy(const MieGruneisen& law, double mu) {
  constexpr int steps = 400;
  const double h = mu / steps;
  const auto slope = [&](double x, double energy) { return printed(law, x, energy) / std::pow(1.0 + x, 2); };
  double energy = 0.0;
  for (int i = 0; i < steps; ++i) {
    const double x = i * h, a = slope(x, energy), b = slope(x + 0.5 * h, energy + 0.5 * h * a),
                 c = slope(x + 0.5 * h, energy + 0.5 * h * b), d = slope(x + h, energy + h * c);
    energy += h / 6.0 * (a + 2.0 * b + 2.0 * c + d);
  }
  return energy;
}

TEST(EquationOfState, IsThatOfThePaperWithTheEnergyOfCompression) {
  for (const MieGruneisen& law : laws())
    for (const double mu : {0.001, 0.02, 0.1, 0.3}) {
      const double energy = compressed_energy(law, mu), pressure = printed(law, mu, energy);
      const CompressionCurve::Compressed is = CompressionCurve(law, bulk).at(mu, 0.0);
      EXPECT_NEAR(is.energy, energy, 1e-6 * energy) << law.S1 << " at " << mu;
      EXPECT_NEAR(is.pressure * (1.0 + mu), pressure, 1e-6 * pressure) << law.S1 << " at " << mu;
    }
}

TEST(EquationOfState, HeatPressesByGamma) {
  constexpr double heat = 5e8;
  for (const MieGruneisen& law : laws())
    for (const double mu : {0.0, 0.02, 0.1}) {
      const CompressionCurve curve(law, bulk);
      const double more = (curve.at(mu, heat).pressure - curve.at(mu, 0.0).pressure) * (1.0 + mu);
      EXPECT_NEAR(more, (law.gamma0 + law.b * mu) * heat, 1e-3);
    }
}

TEST(EquationOfState, PressureIsTheSlopeOfTheEnergyAndHasTheModulusForIts) {
  constexpr double step = 1e-5;
  for (const MieGruneisen& law : laws())
    for (const double mu : {0.01, 0.1, 0.25}) {
      const CompressionCurve curve(law, bulk);
      const auto at = [&](double change) { return curve.at((1.0 + mu) * std::exp(change) - 1.0, 3e8); };
      const CompressionCurve::Compressed is = at(0.0), more = at(step), less = at(-step);
      EXPECT_NEAR((more.energy - less.energy) / (2.0 * step), is.pressure, 1e-5 * is.pressure);
      EXPECT_NEAR((more.pressure - less.pressure) / (2.0 * step), is.modulus, 1e-5 * is.modulus);
    }
}

TEST(EquationOfState, BeginsAsElasticityDoes) {
  for (const MieGruneisen& law : laws()) {
    const CompressionCurve::Compressed is = CompressionCurve(law, bulk).at(0.0, 0.0);
    EXPECT_EQ(is.pressure, 0.0);
    EXPECT_EQ(is.energy, 0.0);
    EXPECT_DOUBLE_EQ(is.modulus, bulk);
  }
}

TEST(Elasticity, KeepsItsShearModulusWithAnotherBulkModulus) {
  const Elasticity before{73e9, 0.33}, after = before.with_bulk_modulus(bulk);
  EXPECT_NEAR(after.kappa(), bulk, 1e-6 * bulk);
  EXPECT_NEAR(after.mu(), before.mu(), 1e-6 * before.mu());
}

} // namespace
} // namespace cnem::plasticity::test
