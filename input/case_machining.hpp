#pragma once
// A milling case as read: of analyses in which nothing but the cut and the modes of tool and part counts.
#include "machining/milling_cut.hpp"
#include "machining/milling_process.hpp"
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
  std::vector<double> places; ///< m along the path, of a chart over them; none: there is none
  struct Box {
    Vec3 low, high; ///< m
  };
  std::optional<Box> takes; ///< of the part: what the cutter takes on its way
};

/// How a cut in the time domain is resolved.
struct DexelSettings {
  double pitch = 0.0; ///< m
  int layers = 1;     ///< along the axis
  int steps = 720;    ///< in a turn
};

struct MachiningCase {
  machining::MillingCut cut;
  std::optional<double> rake;    ///< rad, of the edges
  machining::LawRange law_range; ///< from where to where the law holds, as the case says
  double speed = 0.0;            ///< rad/s of the spindle, the largest; so is the feed of the cut
  std::optional<machining::DriveTables> drive; ///< where one of them changes with time
  double axial_depth = 0.0;                    ///< m
  double length = 0.0; ///< m, of the path of the axis in the time domain, all passes together
  std::vector<machining::ToolPath> passes; ///< none: straight along x
  std::optional<machining::Blank> blank;   ///< of passes; none where an earlier run has left it
  std::string earlier_run;                 ///< folder of the run that has left the workpiece, from the root
  double dwell = 0.0;                      ///< turns at its end without feed
  machining::ProcessSettings::Start start = machining::ProcessSettings::Start::inside; ///< where it begins
  DexelSettings dexels;
  std::vector<NamedMode> modes;
  StabilityRange stability;
};

/// Why a workpiece of that extent (m) takes more cells of dexels than memory is wanted for; empty: it does
/// not.
std::string too_many_cells(const MachiningCase& milling, const Vec2& size, const machining::Blank& blank);

} // namespace cnem::input
