#pragma once
// Specific heat and conductivity that change with temperature.
#include "core/parameter.hpp"

namespace cnem {

/// Factors of a specific heat c and a conductivity k over temperature, straight between points and constant
/// beyond the ends; without points 1 everywhere. Heat is counted by the *enthalpy* h = ∫ c dT, so that none
/// is lost however much a temperature changes in a step, and conducted by the potential Φ = ∫ k dT (Kirchhoff
/// 1894), which makes the steady profile of a constant k that of Φ.
struct HeatCurves {
  NumberList at;                          ///< K
  NumberList specific_heat, conductivity; ///< – at these; either may be left out

  static constexpr ListParameter<HeatCurves> lists[] = {
      {&HeatCurves::at,
       {.name = "factors_at",
        .unit = "K",
        .range = temperature_range,
        .meaning =
            "Temperatures at which the factors stand, increasing; between them they are straight, beyond "
            "them constant.",
        .example = "\"293 793 K\""}},
      {&HeatCurves::specific_heat,
       {.name = "specific_heat_factors",
        .range = positive,
        .meaning = "On `specific_heat` at these temperatures.",
        .example = "[1.0, 1.31]"}},
      {&HeatCurves::conductivity,
       {.name = "conductivity_factors",
        .range = positive,
        .meaning = "On `conductivity` at these temperatures.",
        .example = "[1.0, 2.03]"}}};

  /// Works out what follows from the lists. Throws InputError where they are no tables.
  void complete();

  bool given() const { return at.size > 0; }
  /// The temperature, K, after heat has come: `rise` is that heat over the capacity at factor 1, K.
  double warmed(double temperature, double rise) const {
    return given() ? temperature_of(enthalpy(temperature) + rise) : temperature + rise;
  }
  /// Heat from one temperature to another over the capacity at factor 1, K.
  double rise(double from, double to) const { return given() ? enthalpy(to) - enthalpy(from) : to - from; }
  /// h over c at factor 1, K; the temperature itself without points.
  double enthalpy(double temperature) const;
  double temperature_of(double enthalpy) const; ///< K, with that enthalpy
  double specific_heat_factor(double temperature) const;
  /// Φ over k at factor 1, K; the temperature itself without points.
  double potential(double temperature) const;

  /// A factor on the capacity with which no exchange is slower than this one: the least of c and c/k.
  double quickest = 1.0;

private:
  NumberList enthalpy_, potential_; ///< K, at the points: integrals of the factors from the first one on
};

} // namespace cnem
