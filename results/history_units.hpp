#pragma once
// Words and units in the headers of histories: per metre of thickness, or of whole bodies.
#include "input/case.hpp"

#include <string>

namespace cnem::results {

struct HistoryUnits {
  std::string force = "[N/m]", energy = "[J/m]", mass = "[kg/m]", momentum = "[N s/m]",
              angular_momentum = "[N s]";
  std::string measure = "[m^2]", enclosed = "area", broken = "broken_area"; ///< what the boundary encloses
};
/// Of revolution and in space they are those of whole bodies.
HistoryUnits history_units(const input::Analysis& analysis);

} // namespace cnem::results
