#include "app/forecast/shear_plane.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace cnem::app {

double foretold_chip_ratio(double rake, double friction, double hardening) {
  constexpr double pi = std::numbers::pi;
  const double turned = std::atan(friction) - rake, n = std::clamp(hardening, 0.0, 0.25);
  const auto excess = [&](double phi) { // grows with φ
    return std::tan(phi + turned) - (1.0 + 2.0 * (0.25 * pi - phi) - 5.9 * n);
  };
  double low = 0.05, high = std::min(1.4, 0.5 * pi - 1e-3 - turned);
  for (int k = 0; k < 60 && low < high; ++k) {
    const double phi = 0.5 * (low + high);
    (excess(phi) > 0.0 ? high : low) = phi;
  }
  return std::clamp(std::cos(low - rake) / std::sin(low), 1.0, 4.0);
}

} // namespace cnem::app
