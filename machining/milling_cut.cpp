#include "machining/milling_cut.hpp"

#include "core/index.hpp"
#include "machining/gauss.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

namespace cnem::machining {

namespace {

/// Thickness of a steady chip over sin φ, and what run-out adds, m.
struct Chip {
  double feed, more;
};
Chip chip_of(const MillingCut& cut, std::size_t tooth) {
  const Cutter& cutter = cut.cutter;
  const std::size_t n = cutter.teeth();
  const double share = cutter.pitch_before(tooth) * static_cast<double>(n) / full_turn;
  return {cut.feed * share, cutter.radius_of(tooth) - cutter.radius_of((tooth + n - 1) % n)};
}

} // namespace

MillingCut with_edge_forces(MillingCut cut) {
  constexpr double share = 1e-4; // of the feed
  cut.onset = share * cut.feed;
  return cut;
}

double steady_thickness(const MillingCut& cut, std::size_t tooth, double phi) {
  const Chip chip = chip_of(cut, tooth);
  return chip.feed * std::sin(phi) + chip.more;
}

double period_of(const MillingCut& cut) { return cut.cutter.period(!cut.linear() || cut.flank.presses()); }

std::vector<double> changes_within(const MillingCut& cut, std::size_t tooth, double radius) {
  const double from = cut.engagement.entry(cut.cutter, radius), to = cut.engagement.exit(cut.cutter, radius);
  std::vector<double> changes;
  const auto where_sine_is = [&](double sine) {
    if (!(std::abs(sine) < 1.0)) return;
    for (const double phi : {std::asin(sine), std::numbers::pi - std::asin(sine)})
      if (phi > from && phi < to) changes.push_back(phi);
  };
  const Chip chip = chip_of(cut, tooth);
  if (cut.flank.presses() || !cut.linear()) where_sine_is(-chip.more / chip.feed);
  if (cut.onset > 0.0) where_sine_is((cut.onset - chip.more) / chip.feed);
  if (cut.flank.presses()) {
    const Flank flank = cut.flank.about(radius);
    const double still = std::tan(flank.clearance) - flank.recovery / flank.land;
    const double level = flank_rise(cut, tooth, 0.0, radius),
                 slope = flank_rise(cut, tooth, 0.5 * std::numbers::pi, radius) - level;
    where_sine_is((still - level) / slope);
  }
  std::sort(changes.begin(), changes.end());
  return changes;
}

double flank_rise(const MillingCut& cut, std::size_t tooth, double phi, double radius) {
  const Cutter& cutter = cut.cutter;
  const double feed = cut.feed * static_cast<double>(cutter.teeth()) / full_turn; // m per rad
  return (feed * std::sin(phi) - cutter.run_out * std::sin(cutter.run_out_angle + cutter.behind(tooth))) /
         radius;
}

double foremost_of(double entry, double exit) { return std::clamp(0.5 * std::numbers::pi, entry, exit); }

double longest_contact(const MillingCut& cut) {
  const double foremost = foremost_of(cut.engagement.entry(cut.cutter), cut.engagement.exit(cut.cutter));
  double longest = 0.0;
  for (std::size_t j = 0; j < cut.cutter.teeth(); ++j)
    if (steady_thickness(cut, j, foremost) > 0.0)
      longest = std::max(longest, cut.flank.contact(flank_rise(cut, j, foremost, cut.cutter.radius())));
  return longest;
}

} // namespace cnem::machining
