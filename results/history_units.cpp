#include "results/history_units.hpp"

namespace cnem::results {

HistoryUnits history_units(const input::Analysis& analysis) {
  if (analysis.space() == Space::plane && analysis.dimensions() == 2) return {};
  return {.force = "[N]",
          .energy = "[J]",
          .mass = "[kg]",
          .momentum = "[N s]",
          .angular_momentum = "[N m s]",
          .measure = "[m^3]",
          .enclosed = "enclosed_volume", // `volume_drift` is of the volumes that material points lose
          .broken = "broken_volume"};
}

} // namespace cnem::results
