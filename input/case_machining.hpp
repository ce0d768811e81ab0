#pragma once
// A milling case as read: of analyses in which nothing but the cut and the modes of tool and part counts.
#include "machining/milling_cut.hpp"
#include "machining/mode.hpp"

#include <optional>
#include <string>
#include <vector>

namespace cnem::input {

struct NamedMode : machining::Mode {
  std::string name;
};

/// What a chart of stability spans.
struct StabilityRange {
  double speed_from = 0.0, speed_to = 0.0; ///< rad/s of the spindle
  int speeds = 200;
  std::optional<double> depth_to; ///< m; none: as deep as is of interest
  int depths = 100;
};

struct MachiningCase {
  machining::MillingCut cut;
  double speed = 0.0;       ///< rad/s of the spindle
  double axial_depth = 0.0; ///< m
  std::vector<NamedMode> modes;
  StabilityRange stability;
};

} // namespace cnem::input
