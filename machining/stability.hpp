#pragma once
// Which depths a milling cut bears: multipliers of Floquet, limits, charts over speed and depth.
#include "machining/milling_cut.hpp"
#include "machining/mode.hpp"

#include <complex>
#include <optional>
#include <span>
#include <vector>

namespace cnem::machining {

/// How a cut loses its stability: a vibration beside the harmonics of the teeth (a pair of complex
/// multipliers), every second period alike (−1), or none of its own (1).
enum class Bifurcation { hopf, flip, fold };
const char* name_of(Bifurcation kind);

/// The multiplier of largest magnitude: what a disturbance is multiplied by in one period (period_of()).
struct Multiplier {
  std::complex<double> value;
  double frequency = 0.0; ///< Hz, of the strongest vibration that belongs to it
  double teeth = 0.0;     ///< Hz, at which pitches repeat: what is told by it whether run-out does too or not
  Bifurcation kind() const;
};

/// Speed of the spindle in rad/s, axial depth in m > 0.
Multiplier multiplier(const MillingCut& cut, std::span<const Mode> modes, double spindle, double depth);
/// Its magnitude alone.
double spectral_radius(const MillingCut& cut, std::span<const Mode> modes, double spindle, double depth);

struct DepthLimit {
  double depth = 0.0; ///< m, where the spectral radius passes 1
  Multiplier at;
};

/// The first depth at which the cut is not stable, looked for in steps up to `most`, m, and found to 1e-7 of
/// itself; none where there is none.
std::optional<DepthLimit> depth_limit(const MillingCut& cut, std::span<const Mode> modes, double spindle,
                                      double step, double most);

struct StabilityChart {
  std::vector<double> speed;                     ///< rad/s
  std::vector<double> depth;                     ///< m, > 0
  std::vector<double> radius;                    ///< [speed × depths + depth]
  std::vector<std::optional<DepthLimit>> limit;  ///< of each speed, the first within the depths
  std::vector<std::optional<double>> zero_order; ///< m
};

/// Evenly spaced speeds from one to the other, and depths up to `deepest`. The same for any number of
/// threads.
StabilityChart stability_chart(const MillingCut& cut, std::span<const Mode> modes, double from, double to,
                               int speeds, double deepest, int depths);

/// Limits over speed and place along a path.
struct PlaceChart {
  std::vector<double> place;                    ///< m
  std::vector<bool> moves;                      ///< whether anything vibrates at a place
  std::vector<double> speed;                    ///< rad/s
  std::vector<std::optional<DepthLimit>> limit; ///< [place × speeds + speed], the first within the depths
  /// The place whose limit at the speed nearest to `spindle` is the least; the first one that moves where
  /// none has any. It has to move somewhere.
  std::size_t weakest(double spindle) const;
};
/// modes: [place] those that a cutter meets there, as they are there.
PlaceChart place_chart(const MillingCut& cut, const std::vector<std::vector<Mode>>& modes,
                       std::vector<double> places, double from, double to, int speeds, double deepest,
                       int depths);

/// The speed of the chart nearest to `spindle` whose limit is at least `depth`; none where there is none.
std::optional<std::size_t> nearest_speed(const StabilityChart& chart, double spindle, double depth);

} // namespace cnem::machining
