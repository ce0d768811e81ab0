#pragma once
// Milling benchmarks that several tests share.
#include "core/rpm.hpp"
#include "machining/milling_cut.hpp"
#include "machining/mode.hpp"

#include <numbers>
#include <vector>

namespace cnem::machining {

inline MillingCut milling_cut(std::size_t teeth, double Ktc, double Krc, Engagement::Side side,
                              double immersion) {
  MillingCut cut;
  cut.cutter.diameter = 12e-3;
  cut.cutter.pitch = equal_pitch(teeth);
  cut.engagement = {side, immersion * cut.cutter.diameter};
  cut.feed = 1e-4;
  LinearLaw law;
  law.Ktc = Ktc;
  law.Krc = Krc;
  cut.law = CuttingLaw(law);
  return cut;
}

/// Insperger and Stépán: two teeth, 922 Hz, ζ 0.011, 0.03993 kg.
inline MillingCut insperger(Engagement::Side side = Engagement::Side::up, double immersion = 1.0) {
  return milling_cut(2, 6e8, 2e8, side, immersion);
}
inline std::vector<Mode> insperger_modes(int dofs) {
  Mode mode{.of = Mode::Of::tool, .frequency = 922.0, .damping = 0.011};
  mode.stiffness = 0.03993 * mode.omega() * mode.omega();
  std::vector<Mode> modes{mode};
  if (dofs == 2) {
    mode.direction = Vec3::UnitY();
    modes.push_back(mode);
  }
  return modes;
}

/// Three teeth on a spindle, 603 and 666 Hz.
inline MillingCut spindle_cut(double immersion) {
  return milling_cut(3, 6e8, 0.07 * 6e8, Engagement::Side::up, immersion);
}
inline std::vector<Mode> spindle_modes() {
  return {{.of = Mode::Of::tool, .frequency = 603.0, .damping = 0.039, .stiffness = 5.59e6},
          {.of = Mode::Of::tool,
           .frequency = 666.0,
           .damping = 0.035,
           .stiffness = 5.715e6,
           .direction = Vec3::UnitY()}};
}

/// Al 7075-T6.
inline CuttingLaw aluminium() {
  LinearLaw law;
  law.Ktc = 767e6;
  law.Krc = 168.8e6;
  law.Kac = 222e6;
  law.Kte = 27.7e3;
  law.Kre = 26.6e3;
  law.Kae = 0.7e3;
  return CuttingLaw(law);
}

} // namespace cnem::machining
