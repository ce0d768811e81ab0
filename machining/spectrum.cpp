#include "machining/spectrum.hpp"

#include <unsupported/Eigen/FFT>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <complex>
#include <numbers>
#include <numeric>

namespace cnem::machining {

Spectrum spectrum_of(std::span<const double> signal, double dt) {
  const std::size_t n = signal.size();
  assert(n >= 4 && dt > 0.0);
  const double mean = std::accumulate(signal.begin(), signal.end(), 0.0) / static_cast<double>(n);
  std::vector<double> windowed(n);
  for (std::size_t k = 0; k < n; ++k)
    windowed[k] = (signal[k] - mean) *
                  (1.0 - std::cos(2.0 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(n)));
  std::vector<std::complex<double>> lines;
  Eigen::FFT<double> transform;
  transform.fwd(lines, windowed);
  Spectrum spectrum{.step = 1.0 / (dt * static_cast<double>(n)), .amplitude = {}};
  for (std::size_t k = 0; k <= n / 2; ++k)
    spectrum.amplitude.push_back(2.0 * std::abs(lines[k]) / static_cast<double>(n));
  return spectrum;
}

std::optional<SpectralPeak> strongest_beside(const Spectrum& spectrum, double base) {
  const std::vector<double>& a = spectrum.amplitude;
  constexpr double width = 2.0; // steps
  std::size_t top = 0;
  for (std::size_t k = 3; k + 1 < a.size(); ++k) {
    const double multiple = spectrum.frequency(k) / base;
    if (std::abs(multiple - std::round(multiple)) * base <= (width + 1e-6) * spectrum.step) continue;
    if (top == 0 || a[k] > a[top]) top = k;
  }
  if (top == 0) return std::nullopt;
  // Of a sine at top + d, neighbours are as (1 + d)/(2 − d) and (1 − d)/(2 + d) of the top.
  const bool above = a[top + 1] > a[top - 1];
  const double ratio = a[top] > 0.0 ? (above ? a[top + 1] : a[top - 1]) / a[top] : 0.0;
  const double beside = std::clamp((2.0 * ratio - 1.0) / (1.0 + ratio), 0.0, 0.5),
               shift = above ? beside : -beside;
  const double x = std::numbers::pi * shift;
  const double share = std::abs(x) < 1e-6 ? 1.0 : std::sin(x) / x / (1.0 - shift * shift);
  return SpectralPeak{.frequency = spectrum.step * (static_cast<double>(top) + shift),
                      .amplitude = a[top] / share};
}

} // namespace cnem::machining
