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

/// rad, within the engagement, where sin φ is the largest.
double foremost_of(const MillingCut& cut) {
  return std::clamp(0.5 * std::numbers::pi, cut.engagement.entry(cut.cutter),
                    cut.engagement.exit(cut.cutter));
}

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

/// Adds the integral of f over [from, to], in pieces of at most half a radian that end at the changes, in
/// order.
template<class F>
void integrate(double from, double to, std::span<const double> changes, DirectionalFactors& sum, const F& f) {
  if (!(to > from)) return;
  for (const double at : changes)
    if (at > from && at < to) {
      integrate(from, at, {}, sum, f);
      from = at;
    }
  constexpr double piece = 0.5;
  const int pieces = static_cast<int>(std::ceil((to - from) / piece));
  const GaussRule& rule = gauss_rule(8);
  const double width = (to - from) / pieces;
  for (int k = 0; k < pieces; ++k)
    for (std::size_t i = 0; i < rule.node.size(); ++i)
      sum += rule.weight[i] * width * f(from + (k + rule.node[i]) * width);
}

} // namespace

double steady_thickness(const MillingCut& cut, std::size_t tooth, double phi) {
  const Chip chip = chip_of(cut, tooth);
  return chip.feed * std::sin(phi) + chip.more;
}

double period_of(const MillingCut& cut) {
  return cut.cutter.period(!cut.law.linear() || cut.flank.presses());
}

std::vector<double> changes_within(const MillingCut& cut, std::size_t tooth) {
  const double from = cut.engagement.entry(cut.cutter), to = cut.engagement.exit(cut.cutter);
  std::vector<double> changes;
  const auto where_sine_is = [&](double sine) {
    if (!(std::abs(sine) < 1.0)) return;
    for (const double phi : {std::asin(sine), std::numbers::pi - std::asin(sine)})
      if (phi > from && phi < to) changes.push_back(phi);
  };
  const Chip chip = chip_of(cut, tooth);
  if (cut.flank.presses() || !cut.law.linear()) where_sine_is(-chip.more / chip.feed);
  if (cut.flank.presses()) {
    const double still = std::tan(cut.flank.clearance) - cut.flank.recovery / cut.flank.land;
    const double level = flank_rise(cut, tooth, 0.0),
                 slope = flank_rise(cut, tooth, 0.5 * std::numbers::pi) - level;
    where_sine_is((still - level) / slope);
  }
  std::sort(changes.begin(), changes.end());
  return changes;
}

SteadyChips steady_chips(const MillingCut& cut) {
  const double from = cut.engagement.entry(cut.cutter), to = cut.engagement.exit(cut.cutter);
  const double foremost = foremost_of(cut);
  SteadyChips chips;
  for (std::size_t j = 0; j < cut.cutter.teeth(); ++j) {
    chips.thickest = std::max(chips.thickest, steady_thickness(cut, j, foremost));
    // Within a hundredth of the engagement of where the thickness is nothing anyway it does not count.
    for (int k = 1; k < 100; ++k)
      chips.thinnest = std::min(chips.thinnest, steady_thickness(cut, j, from + 0.01 * k * (to - from)));
  }
  return chips;
}

DirectionalFactors directional_factors(const MillingCut& cut, std::size_t tooth, double phi, double spindle) {
  const double h = steady_thickness(cut, tooth, phi);
  if (!(h > 0.0) && !cut.law.linear()) return DirectionalFactors::Zero();
  const LawPoint point = cut.law.at({.thickness = h, .speed = spindle * cut.cutter.radius()});
  return on_tool(phi, point.slope) * outward(phi).head<2>().transpose();
}

namespace {

/// Of one tooth whose tip is at an angle: per_depth(φ) over the part of [0, depth] that is in the cut.
template<class PerDepth>
DirectionalFactors along_edge(const MillingCut& cut, std::size_t tooth, double tip, double depth,
                              const PerDepth& per_depth) {
  DirectionalFactors sum = DirectionalFactors::Zero();
  const double from = cut.engagement.entry(cut.cutter), to = cut.engagement.exit(cut.cutter);
  const double lag = cut.cutter.lag(depth);
  constexpr double straight = 1e-9; // rad of lag
  if (std::abs(lag) < straight) {
    const double phi = tip - full_turn * std::floor(tip / full_turn);
    if (phi >= from && phi <= to) sum = depth * per_depth(phi);
    return sum;
  }
  // φ goes from tip − lag to tip along the edge; a long one is in the cut in several places.
  const double low = std::min(tip - lag, tip), high = std::max(tip - lag, tip);
  const std::vector<double> changes = changes_within(cut, tooth);
  for (int k = static_cast<int>(std::floor((low - to) / full_turn)); k * full_turn + from < high; ++k)
    integrate(std::max(low - k * full_turn, from), std::min(high - k * full_turn, to), changes, sum,
              per_depth);
  return sum * (depth / std::abs(lag));
}

template<class PerDepth> DirectionalFactors mean_of_turn(const MillingCut& cut, const PerDepth& per_depth) {
  DirectionalFactors sum = DirectionalFactors::Zero();
  for (std::size_t j = 0; j < cut.cutter.teeth(); ++j)
    integrate(cut.engagement.entry(cut.cutter), cut.engagement.exit(cut.cutter), changes_within(cut, j), sum,
              [&](double phi) { return per_depth(j, phi); });
  return sum / full_turn;
}

/// Per depth, at one angle, of an edge that cuts there. N s/m²
DirectionalFactors damping_per_depth(const MillingCut& cut, std::size_t tooth, double phi, double spindle) {
  if (!(steady_thickness(cut, tooth, phi) > 0.0)) return DirectionalFactors::Zero();
  const double damping = cut.flank.damping(flank_rise(cut, tooth, phi), spindle * cut.cutter.radius());
  return damping * on_tool(phi, Vec3(cut.flank.friction, 1.0, 0.0)) * outward(phi).head<2>().transpose();
}

} // namespace

DirectionalFactors directional_factors(const MillingCut& cut, std::size_t tooth, double tip, double depth,
                                       double spindle) {
  return along_edge(cut, tooth, tip, depth,
                    [&](double phi) { return directional_factors(cut, tooth, phi, spindle); });
}

DirectionalFactors mean_factors(const MillingCut& cut, double spindle) {
  return mean_of_turn(cut,
                      [&](std::size_t j, double phi) { return directional_factors(cut, j, phi, spindle); });
}

double flank_rise(const MillingCut& cut, std::size_t tooth, double phi) {
  const Cutter& cutter = cut.cutter;
  const double feed = cut.feed * static_cast<double>(cutter.teeth()) / full_turn; // m per rad
  return (feed * std::sin(phi) - cutter.run_out * std::sin(cutter.run_out_angle + cutter.behind(tooth))) /
         cutter.radius();
}

bool engages(const MillingCut& cut, std::size_t tooth, double tip, double depth) {
  return !along_edge(cut, tooth, tip, depth, [](double) -> DirectionalFactors {
            return DirectionalFactors::Ones();
          }).isZero(0.0);
}

double longest_contact(const MillingCut& cut) {
  const double foremost = foremost_of(cut);
  double longest = 0.0;
  for (std::size_t j = 0; j < cut.cutter.teeth(); ++j)
    if (steady_thickness(cut, j, foremost) > 0.0)
      longest = std::max(longest, cut.flank.contact(flank_rise(cut, j, foremost)));
  return longest;
}

DirectionalFactors damping_factors(const MillingCut& cut, std::size_t tooth, double tip, double depth,
                                   double spindle) {
  if (!cut.flank.presses()) return DirectionalFactors::Zero();
  return along_edge(cut, tooth, tip, depth,
                    [&](double phi) { return damping_per_depth(cut, tooth, phi, spindle); });
}

DirectionalFactors mean_damping(const MillingCut& cut, double spindle) {
  if (!cut.flank.presses()) return DirectionalFactors::Zero();
  return mean_of_turn(cut,
                      [&](std::size_t j, double phi) { return damping_per_depth(cut, j, phi, spindle); });
}

} // namespace cnem::machining
