#include "machining/stability.hpp"

#include "core/index.hpp"
#include "core/machine/parallel.hpp"
#include "machining/largest_eigenvalue.hpp"
#include "machining/monodromy.hpp"
#include "machining/zero_order.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace cnem::machining {

namespace {

constexpr double of_limits = 1e-9, of_charts = 1e-6; // tolerances of multipliers

Eigenpair largest(const Monodromy& monodromy, double tolerance) {
  return largest_eigenvalue([&](const Eigen::VectorXd& from, Eigen::VectorXd& to) { monodromy(from, to); },
                            monodromy.size(), tolerance);
}

double radius_of(const MillingCut& cut, std::span<const Mode> modes, double spindle, double depth,
                 double tolerance) {
  return std::abs(largest(Monodromy(cut, modes, spindle, depth), tolerance).value);
}

/// Between a stable and an unstable depth, by false position with halved weights (Illinois).
DepthLimit refined(const MillingCut& cut, std::span<const Mode> modes, double spindle, double low,
                   double high, double radius_low, double radius_high) {
  double at_low = std::log(radius_low), at_high = std::log(radius_high);
  int side = 0;
  constexpr double close = 1e-7;
  while (high - low > close * high) {
    double depth = (low * at_high - high * at_low) / (at_high - at_low);
    if (!(depth > low && depth < high)) depth = 0.5 * (low + high);
    const double value = std::log(radius_of(cut, modes, spindle, depth, of_limits));
    if (value < 0.0) {
      if (side < 0) at_high *= 0.5;
      low = depth;
      at_low = value;
      side = -1;
      if (-value < 1e-9) break;
    } else {
      if (side > 0) at_low *= 0.5;
      high = depth;
      at_high = value;
      side = 1;
      if (value < 1e-9) break;
    }
  }
  const double depth = side < 0 ? low : high;
  return {depth, multiplier(cut, modes, spindle, depth)};
}

/// Of modes that nothing excites, over a period.
double free_radius(const MillingCut& cut, std::span<const Mode> modes, double spindle) {
  const double angle = period_of(cut);
  double most = 0.0;
  for (const Mode& mode : modes)
    most = std::max(most, std::exp(-mode.damping * mode.omega() * angle / spindle));
  return most;
}

} // namespace

const char* name_of(Bifurcation kind) {
  return kind == Bifurcation::hopf ? "Hopf" : kind == Bifurcation::flip ? "flip" : "fold";
}

Bifurcation Multiplier::kind() const {
  constexpr double real = 1e-9;
  if (std::abs(value.imag()) > real * std::abs(value)) return Bifurcation::hopf;
  const double beside = std::abs(std::remainder(frequency / teeth, 1.0)); // of harmonics
  constexpr double close = 1e-3;
  if (beside < close) return Bifurcation::fold;
  return beside > 0.5 - close ? Bifurcation::flip : Bifurcation::hopf;
}

Multiplier multiplier(const MillingCut& cut, std::span<const Mode> modes, double spindle, double depth) {
  const Monodromy monodromy(cut, modes, spindle, depth);
  const Eigenpair pair = largest(monodromy, of_limits);
  return {pair.value, monodromy.strongest_frequency(pair.value, pair.vector) / full_turn,
          spindle / cut.cutter.period(false)};
}

double spectral_radius(const MillingCut& cut, std::span<const Mode> modes, double spindle, double depth) {
  return radius_of(cut, modes, spindle, depth, of_limits);
}

std::optional<DepthLimit> depth_limit(const MillingCut& cut, std::span<const Mode> modes, double spindle,
                                      double step, double most) {
  double low = 0.0, before = free_radius(cut, modes, spindle);
  while (low < most) {
    const double high = std::min(low + step, most), radius = radius_of(cut, modes, spindle, high, of_limits);
    if (radius >= 1.0) return refined(cut, modes, spindle, low, high, before, radius);
    low = high;
    before = radius;
  }
  return std::nullopt;
}

StabilityChart stability_chart(const MillingCut& cut, std::span<const Mode> modes, double from, double to,
                               int speeds, double deepest, int depths) {
  StabilityChart chart;
  for (int i = 0; i < speeds; ++i) chart.speed.push_back(from + (to - from) * i / (speeds - 1));
  for (int i = 1; i <= depths; ++i) chart.depth.push_back(deepest * i / depths);
  const std::size_t rows = chart.depth.size();
  chart.radius.resize(chart.speed.size() * rows);
  chart.limit.resize(chart.speed.size());
  chart.zero_order.resize(chart.speed.size());
  ParallelFailure failure;
#pragma omp parallel for schedule(dynamic)
  for (std::ptrdiff_t s = 0; s < static_cast<std::ptrdiff_t>(chart.speed.size()); ++s)
    failure.guard(s, [&] {
      const std::size_t i = index_of(s);
      const double spindle = chart.speed[i];
      if (const auto zero = zero_order_limit(cut, modes, spindle)) chart.zero_order[i] = zero->depth;
      double low = 0.0, before = free_radius(cut, modes, spindle);
      for (std::size_t k = 0; k < rows; ++k) {
        const double depth = chart.depth[k], radius = radius_of(cut, modes, spindle, depth, of_charts);
        chart.radius[i * rows + k] = radius;
        if (radius >= 1.0 && !chart.limit[i])
          chart.limit[i] = refined(cut, modes, spindle, low, depth, before, radius);
        low = depth;
        before = radius;
      }
    });
  failure.rethrow();
  return chart;
}

std::optional<std::size_t> nearest_speed(const StabilityChart& chart, double spindle, double depth) {
  std::optional<std::size_t> best;
  const double deepest = chart.depth.back();
  for (std::size_t i = 0; i < chart.speed.size(); ++i) {
    const double limit = chart.limit[i] ? chart.limit[i]->depth : deepest;
    if (limit >= depth &&
        (!best || std::abs(chart.speed[i] - spindle) < std::abs(chart.speed[*best] - spindle)))
      best = i;
  }
  return best;
}

} // namespace cnem::machining
