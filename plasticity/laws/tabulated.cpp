#include "plasticity/laws/tabulated.hpp"

#include "core/error.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <span>
#include <vector>

namespace cnem::plasticity {
namespace {

/// Slope at an end from the two secants next to it, without overshoot (Fritsch and Butland, as in PCHIP's
/// PCHIM): h, d of the end's interval, h2, d2 of the next.
double end_slope(double h, double d, double h2, double d2) {
  const double slope = ((2.0 * h + h2) * d - h * d2) / (h + h2);
  if (slope * d <= 0.0) return 0.0;
  return d * d2 <= 0.0 && std::abs(slope) > 3.0 * std::abs(d) ? 3.0 * d : slope;
}

/// Slope between two intervals: their secants' weighted harmonic mean, 0 at peaks.
double inner_slope(double h, double d, double h2, double d2) {
  if (d * d2 <= 0.0) return 0.0;
  const double w = 2.0 * h2 + h, w2 = h2 + 2.0 * h;
  return (w + w2) / (w / d + w2 / d2);
}

} // namespace

void Tabulated::complete() {
  const int n = strain.size;
  if (n != stress.size || n < 2)
    throw InputError(fmt::format("a flow curve needs as many strains as stresses and at least two, found {} "
                                 "strains and {} stresses, expected as many",
                                 strain.size, stress.size));
  if (strain.value[0] != 0.0)
    throw InputError(
        fmt::format("a flow curve begins at no plastic strain, found {:g}, expected 0", strain.value[0]));
  std::vector<double> h, d; // widths and secants of the intervals
  for (int i = 1; i < n; ++i) {
    if (!(strain.value[i] > strain.value[i - 1]))
      throw InputError(
          fmt::format("the strains of a flow curve must increase, found {:g} after {:g}, expected "
                      "a larger one",
                      strain.value[i], strain.value[i - 1]));
    h.push_back(strain.value[i] - strain.value[i - 1]);
    d.push_back((stress.value[i] - stress.value[i - 1]) / h.back());
  }
  std::vector<double> slope(h.size() + 1, d.front());
  if (n > 2) {
    slope.front() = end_slope(h[0], d[0], h[1], d[1]);
    for (std::size_t i = 1; i < h.size(); ++i) slope[i] = inner_slope(h[i - 1], d[i - 1], h[i], d[i]);
    const std::size_t last = h.size() - 1;
    slope.back() = end_slope(h[last], d[last], h[last - 1], d[last - 1]);
  }
  for (std::span<double> row : coefficient) std::fill(row.begin(), row.end(), 0.0);
  for (std::size_t i = 0; i < h.size(); ++i) {
    coefficient[1][i] = slope[i];
    coefficient[2][i] = (3.0 * d[i] - 2.0 * slope[i] - slope[i + 1]) / h[i];
    coefficient[3][i] = (slope[i] + slope[i + 1] - 2.0 * d[i]) / (h[i] * h[i]);
  }
  std::copy(stress.value, stress.value + n, coefficient[0]);
}

} // namespace cnem::plasticity
