#pragma once
#include "core/piecewise_linear.hpp"
#include "core/time_table.hpp"

#include <algorithm>
#include <array>

namespace cnem::contact {

/// A characteristic as the maker of a spring or a cushion gives it.
struct SpringTable {
  NumberList travel, forces; ///< m, N/m^(3−dim) (N of revolution)
  TimeTable curve;           ///< of complete(): the forces over the travel in the place of time

  static constexpr const char* name = "table";
  static constexpr const char* formula =
      "`forces` at the `travel` s, straight between points and constant beyond the ends";
  static constexpr const char* source = "";
  static constexpr ListParameter<SpringTable> lists[] = {{&SpringTable::travel,
                                                          {.name = "travel",
                                                           .unit = "m",
                                                           .required = true,
                                                           .meaning = "Values of s, increasing.",
                                                           .example = "\"0 5 10 mm\""}},
                                                         {&SpringTable::forces,
                                                          {.name = "forces",
                                                           .unit = "N/m",
                                                           .range = not_negative,
                                                           .required = true,
                                                           .meaning = "Forces at these.",
                                                           .example = "\"200 240 300 kN/m\""}}};
  static constexpr std::array<Parameter<SpringTable>, 0> parameters{};

  /// Throws InputError where the lists are no table.
  void complete() {
    check_points("travel", travel, "forces", forces);
    const auto vector = [](const NumberList& list) {
      return std::vector<double>(list.value, list.value + list.size);
    };
    curve = TimeTable(vector(travel), vector(forces));
  }

  double force(double s) const { return curve(s); }
  double energy(double s) const { return curve.integral(s); }
  double slope(double s) const {
    for (int k = 1; k < travel.size; ++k)
      if (s <= travel.value[k])
        return s < travel.value[0]
                   ? 0.0
                   : (forces.value[k] - forces.value[k - 1]) / (travel.value[k] - travel.value[k - 1]);
    return 0.0;
  }
};

} // namespace cnem::contact
