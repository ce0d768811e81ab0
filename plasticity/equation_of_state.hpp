#pragma once
// Mie and Grüneisen's equation of state in the form of paper 002, (5) and (6): pressure of compressed metal
// from its density and its internal energy.
#include "core/parameter.hpp"

#include <array>

namespace cnem::plasticity {

/// p = ρ0 C² μ (1 + (1 − γ0/2) μ − b μ²/2)/(1 − (S1 − 1) μ − S2 μ²/(μ + 1) − S3 μ³/(μ + 1)²)² + (γ0 + b μ) e
/// in compression, μ = ρ/ρ0 − 1 > 0, e the internal energy per initial volume. S1, S2 and S3 are of the speed
/// of shocks U = C + S1 u + S2 u²/U + S3 u³/U², u the speed of the metal behind them.
struct MieGruneisen {
  double C = infinite; ///< m/s; infinite: that of the elastic constants
  double S1 = 0.0, S2 = 0.0, S3 = 0.0, gamma0 = 0.0, b = 0.0;

  static constexpr const char* name = "mie-gruneisen";
  static constexpr const char* formula =
      "p = ρ0 C² μ (1 + (1 − gamma0/2) μ − b μ²/2)/(1 − (S1 − 1) μ − S2 μ²/(1 + μ) − S3 μ³/(1 + μ)²)² + "
      "(gamma0 "
      "+ b μ) e where μ = ρ/ρ0 − 1 > 0, e the internal energy per initial volume (paper 002, (5)); the "
      "logarithmic law of `elastic` in tension";
  static constexpr Parameter<MieGruneisen> parameters[] = {
      {&MieGruneisen::C,
       {.name = "C",
        .unit = "m/s",
        .range = positive,
        .meaning =
            "Bulk speed of sound: the bulk modulus is then ρ C², whatever `elastic` says, and the shear "
            "modulus that of `elastic`.",
        .example = "5328 m/s",
        .computed = "√(κ/ρ) of `elastic`"}},
      {&MieGruneisen::S1,
       {.name = "S1",
        .range = {.low = 0.0, .high = 5.0},
        .required = true,
        .meaning = "Slope of the speed of shocks over that of the metal behind them.",
        .example = "1.338"}},
      {&MieGruneisen::S2, {.name = "S2", .meaning = "The next coefficient of that speed."}},
      {&MieGruneisen::S3, {.name = "S3", .meaning = "The one after it."}},
      {&MieGruneisen::gamma0,
       {.name = "gamma0",
        .range = not_negative,
        .required = true,
        .meaning = "Grüneisen's γ: pressure over energy at constant volume. Heat expands the metal by it, "
                   "3α = γ ρ c/κ, in place of `heat.expansion`.",
        .example = "2.0"}},
      {&MieGruneisen::b, {.name = "b", .range = not_negative, .meaning = "What γ gains with μ."}}};
};

/// The same with the bulk modulus of a material. Without heat e is the energy E of compression alone,
/// dE/dμ = p/(1 + μ)², which is a series in μ here: (5) is met to 1e-6 of p up to μ = 0.3.
class CompressionCurve {
public:
  /// κ = ρ0 C², Pa.
  CompressionCurve(const MieGruneisen& law, double kappa);

  struct Compressed {
    double pressure; ///< Pa    p/(1 + μ): Kirchhoff's, per initial area
    double energy;   ///< J/m³  stored, whose slope over ln(ρ/ρ0) that is
    double modulus;  ///< Pa    slope of `pressure` over ln(ρ/ρ0)
  };
  /// At μ ≥ 0 and the heat ρ0 c (T − T0), J/m³, that the metal holds.
  Compressed at(double mu, double heat) const;

private:
  static constexpr int terms = 16;
  MieGruneisen law_;
  double kappa_;
  std::array<double, terms> cold_{}; ///< of E over κ, by powers of μ
};

} // namespace cnem::plasticity
