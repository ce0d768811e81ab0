#pragma once
#include "contact/springs/preload.hpp"

#include <cmath>
#include <limits>

namespace cnem::contact {

/// A cylinder of gas: p Vⁿ stays as it is.
struct GasSpring {
  double preload = 0.0, length = 0.0, exponent = 1.4;

  static constexpr const char* name = "gas";
  static constexpr const char* formula = "`preload` (1 − s/`length`)^−`exponent`";
  static constexpr const char* source = "p Vⁿ = const.";
  static constexpr Parameter<GasSpring> parameters[] = {
      {&GasSpring::preload, spring_preload},
      {&GasSpring::length,
       {.name = "length",
        .unit = "m",
        .range = positive,
        .required = true,
        .meaning = "Of the column of gas at the start: its volume over the area of the piston.",
        .example = "50 mm"}},
      {&GasSpring::exponent,
       {.name = "exponent",
        .range = {.low = 1.0, .high = 2.0},
        .meaning = "1 where the gas has time to stay as warm as it is, 1.4 for nitrogen in a fast stroke."}}};

  static constexpr const char* strength[] = {"preload"};

  /// All are NaN where the piston has reached the bottom, s ≥ length.
  double force(double s) const { return preload * std::pow(rest(s), -exponent); }
  double energy(double s) const {
    return preload * length *
           (exponent == 1.0 ? -std::log(rest(s))
                            : (std::pow(rest(s), 1.0 - exponent) - 1.0) / (exponent - 1.0));
  }
  double slope(double s) const { return exponent * force(s) / (length - s); }

private:
  double rest(double s) const {
    return s < length ? 1.0 - s / length : std::numeric_limits<double>::quiet_NaN();
  }
};

} // namespace cnem::contact
