#include "machining/milling_cut.hpp"

#include "core/index.hpp"
#include "machining/gauss.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace cnem::machining {

namespace {

/// Adds the integral of f over [from, to], in pieces of at most half a radian.
template<class F> void integrate(double from, double to, DirectionalFactors& sum, const F& f) {
  if (!(to > from)) return;
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
  const Cutter& cutter = cut.cutter;
  const std::size_t n = cutter.teeth();
  const double share = cutter.pitch_before(tooth) * static_cast<double>(n) / full_turn;
  return cut.feed * share * std::sin(phi) + cutter.radius_of(tooth) - cutter.radius_of((tooth + n - 1) % n);
}

SteadyChips steady_chips(const MillingCut& cut) {
  const double from = cut.engagement.entry(cut.cutter), to = cut.engagement.exit(cut.cutter);
  const double foremost = std::clamp(0.5 * std::numbers::pi, from, to); // where sin φ is the largest
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
DirectionalFactors along_edge(const MillingCut& cut, double tip, double depth, const PerDepth& per_depth) {
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
  for (int k = static_cast<int>(std::floor((low - to) / full_turn)); k * full_turn + from < high; ++k)
    integrate(std::max(low, k * full_turn + from), std::min(high, k * full_turn + to), sum,
              [&](double phi) { return per_depth(phi - k * full_turn); });
  return sum * (depth / std::abs(lag));
}

template<class PerDepth> DirectionalFactors mean_of_turn(const MillingCut& cut, const PerDepth& per_depth) {
  DirectionalFactors sum = DirectionalFactors::Zero();
  for (std::size_t j = 0; j < cut.cutter.teeth(); ++j)
    integrate(cut.engagement.entry(cut.cutter), cut.engagement.exit(cut.cutter), sum,
              [&](double phi) { return per_depth(j, phi); });
  return sum / full_turn;
}

/// Per depth, at one angle. N s/m²
DirectionalFactors damping_per_depth(const MillingCut& cut, std::size_t tooth, double phi, double spindle) {
  const double damping = cut.flank.damping(flank_rise(cut, tooth, phi), spindle * cut.cutter.radius());
  return damping * on_tool(phi, Vec3(cut.flank.friction, 1.0, 0.0)) * outward(phi).head<2>().transpose();
}

} // namespace

DirectionalFactors directional_factors(const MillingCut& cut, std::size_t tooth, double tip, double depth,
                                       double spindle) {
  return along_edge(cut, tip, depth,
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

DirectionalFactors damping_factors(const MillingCut& cut, std::size_t tooth, double tip, double depth,
                                   double spindle) {
  if (!cut.flank.presses()) return DirectionalFactors::Zero();
  return along_edge(cut, tip, depth, [&](double phi) { return damping_per_depth(cut, tooth, phi, spindle); });
}

DirectionalFactors mean_damping(const MillingCut& cut, double spindle) {
  if (!cut.flank.presses()) return DirectionalFactors::Zero();
  return mean_of_turn(cut,
                      [&](std::size_t j, double phi) { return damping_per_depth(cut, j, phi, spindle); });
}

} // namespace cnem::machining
