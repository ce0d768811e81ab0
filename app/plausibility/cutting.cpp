// Cuts that no lathe makes, and those from which no steady force can be read.
#include "app/plausibility/list.hpp"

#include <fmt/format.h>
#include <numbers>

namespace cnem::app {

void doubt_cutting(const input::Case& input, Doubts& doubts) {
  if (!input.cutting) return;
  const input::CuttingSetup& cut = *input.cutting;
  const auto doubt = [&](const char* key, const std::string& text) {
    doubts.push_back(doubt_about(input, fmt::format("cutting.{}", key), text));
  };
  constexpr double thick = 5e-3, fast = 150.0, rubbing = 0.5 * std::numbers::pi / 180.0;
  if (cut.feed > thick)
    doubt("feed", fmt::format("{:g} mm of uncut chip thickness, where turning takes 0.05 to 1 mm: is it in "
                              "the unit that is meant?",
                              1e3 * cut.feed));
  if (cut.speed > fast)
    doubt("speed",
          fmt::format("{:g} m/s are {:g} m/min, where lathes reach 30 to 3,000: are {:g} m/min meant?",
                      cut.speed, 60.0 * cut.speed, cut.speed));
  if (cut.clearance < rubbing)
    doubt("clearance", "without one the flank rubs on what has been cut, expected 3 to 15 deg");
  if (cut.edge_radius > cut.feed)
    doubt("edge_radius",
          fmt::format("{:.3g} mm is {:.2g} times the feed: such an edge ploughs, a chip may never form",
                      1e3 * cut.edge_radius, cut.edge_radius / cut.feed));
  const double steady = input.report.cutting ? input.report.cutting->steady_feeds + 1.0 : 4.0;
  if (constexpr double short_of = 3.0 - 1e-9; cut.length < short_of * cut.feed)
    doubt("length",
          fmt::format("{:.3g} feeds of cut, where the first is entry and forces count as steady over {:g} "
                      "more: expected {:g} at least",
                      cut.length / cut.feed, steady - 1.0, steady));
}

} // namespace cnem::app
