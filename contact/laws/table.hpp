#pragma once
#include "contact/laws/coulomb.hpp"
#include "contact/laws/tresca_limited.hpp"
#include "core/piecewise_linear.hpp"

#include <algorithm>
#include <numbers>

namespace cnem::contact {

/// Coulomb friction whose coefficient was measured over the temperature of the interface and the speed of
/// slip, as that of tools on chips, where both heat and speed lower it. The two act as factors: tables over
/// both at once are hardly measured.
struct Table {
  NumberList temperature, over_temperature; ///< K, –
  NumberList speed, over_speed;             ///< m/s, –
  double coefficient = 0.0, shear_limit = infinite, shear_factor = 1.0;

  static constexpr const char* name = "table";
  static constexpr const char* formula =
      "`coefficient` times `over_temperature` at the `temperature` of the interface times `over_speed` at "
      "the `speed` of slip, straight between points and constant beyond the ends, times the pressure; at "
      "most "
      "`shear_limit` and `shear_factor` σ_y/√3";
  static constexpr const char* source = "";
  static constexpr ListParameter<Table> lists[] = {{&Table::temperature,
                                                    {.name = "temperature",
                                                     .unit = "K",
                                                     .range = temperature_range,
                                                     .meaning = "Temperatures of the interface, increasing.",
                                                     .example = "\"293 900 1400 K\""}},
                                                   {&Table::over_temperature,
                                                    {.name = "over_temperature",
                                                     .range = not_negative,
                                                     .meaning = "Factors of the coefficient at these.",
                                                     .example = "[1.0, 0.8, 0.3]"}},
                                                   {&Table::speed,
                                                    {.name = "speed",
                                                     .unit = "m/s",
                                                     .range = not_negative,
                                                     .meaning = "Speeds of slip, increasing.",
                                                     .example = "\"0 1 5 m/s\""}},
                                                   {&Table::over_speed,
                                                    {.name = "over_speed",
                                                     .range = not_negative,
                                                     .meaning = "Factors of the coefficient at these.",
                                                     .example = "[1.0, 0.7, 0.5]"}}};
  static constexpr Parameter<Table> parameters[] = {
      {&Table::coefficient, Coulomb::parameters[0].info},
      {&Table::shear_limit, Coulomb::parameters[1].info},
      {&Table::shear_factor, TrescaLimited::parameters[1].info}};

  /// Throws InputError where lists are no tables.
  void complete() const {
    check_points("temperature", temperature, "over_temperature", over_temperature);
    check_points("speed", speed, "over_speed", over_speed);
  }

  bool needs_flow_stress() const { return coefficient > 0.0; }
  bool needs_speed() const { return speed.size > 0; }
  FrictionBound bound(const Rubbing& at) const {
    return {.coefficient = coefficient * piecewise_linear(temperature, over_temperature, at.temperature) *
                           piecewise_linear(speed, over_speed, at.speed),
            .shear = std::min(shear_limit, shear_factor * at.flow_stress / std::numbers::sqrt3)};
  }
};

} // namespace cnem::contact
