#include "machining/cut_vibration.hpp"

#include "machining/line_fit.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numeric>
#include <span>

namespace cnem::machining {

namespace {

int period_of(const Cutter& cutter, int steps) {
  const double samples = steps * cutter.period(true) / full_turn;
  constexpr double whole = 1e-9;
  return std::abs(samples - std::round(samples)) < whole * steps ? static_cast<int>(std::lround(samples))
                                                                 : steps;
}

} // namespace

CutVibration::CutVibration(const Cutter& cutter, int steps)
    : steps_(steps), period_(period_of(cutter, steps)) {}

void CutVibration::add(const Vec3& force, const Vec3& displacement) {
  for (int axis = 0; axis < 3; ++axis) {
    sample_[index_of(axis)].push_back(force[axis]);
    sample_[3 + index_of(axis)].push_back(displacement[axis]);
  }
}

void CutVibration::archive(Archive& archive) {
  for (std::size_t k = 0; k < signals; ++k)
    archive.list(fmt::format("run/vibration/{}", k), k < 3 ? "N" : "m", sample_[k]);
}

std::optional<Spectrum> CutVibration::spectrum(Signal signal, double spindle) const {
  const std::size_t turn = index_of(steps_), turns = samples() / turn;
  if (turns < 2) return std::nullopt;
  const std::span<const double> all(sample_[signal]);
  return spectrum_of(all.last(turns * turn), full_turn / spindle / steps_);
}

std::optional<SpectralPeak> CutVibration::chatter(double spindle) const {
  std::optional<SpectralPeak> strongest;
  for (const Signal signal : {x, y})
    if (const auto spectrum = this->spectrum(signal, spindle))
      if (const auto peak = strongest_beside(*spectrum, base(spindle)))
        if (peak->amplitude > (strongest ? strongest->amplitude : 0.0)) strongest = peak;
  return strongest;
}

std::optional<CutVibration::Growth> CutVibration::growth() const {
  const std::size_t period = index_of(period_), periods = samples() / period;
  constexpr std::size_t least = 6;
  if (periods < least) return std::nullopt;
  const std::size_t first = samples() - periods * period;
  std::vector<double> number, logarithm;
  Growth growth;
  for (std::size_t k = 1; k < periods; ++k) {
    double square = 0.0;
    for (const Signal signal : {x, y})
      for (std::size_t i = first + k * period; i < first + (k + 1) * period; ++i) {
        const double differs = sample_[signal][i] - sample_[signal][i - period];
        square += differs * differs;
      }
    if (!(square > 0.0)) continue;
    number.push_back(static_cast<double>(k));
    logarithm.push_back(0.5 * std::log(square));
    growth.size = std::sqrt(square / static_cast<double>(period));
  }
  if (number.size() < least - 1) return std::nullopt;
  const auto slope = [&](std::size_t last) {
    const std::span<const double> periods_on(number), sizes(logarithm);
    return fit_line(periods_on.last(last), sizes.last(last), std::vector<double>(last, 0.0)).slope;
  };
  growth.factor = std::exp(slope(number.size()).value);
  const Estimate late = slope(std::max(least - 1, number.size() / 3));
  growth.late = std::exp(late.value - 2.0 * late.error);
  double square = 0.0;
  for (const Signal signal : {x, y}) {
    const std::vector<double>& sample = sample_[signal];
    const double rest =
        std::accumulate(sample.begin(), sample.end(), 0.0) / static_cast<double>(sample.size());
    for (const double value : sample) square += (value - rest) * (value - rest);
  }
  growth.vibration = std::sqrt(square / static_cast<double>(samples()));
  return growth;
}

} // namespace cnem::machining
