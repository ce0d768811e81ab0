#include "machining/cutter.hpp"

#include <algorithm>
#include <cmath>

namespace cnem::machining {

double Cutter::lag(double z) const {
  return edge ? edge->lag(z) - edge->lag(0.0) : z * std::tan(helix) / radius();
}

double Cutter::behind(std::size_t tooth) const {
  double angle = 0.0;
  for (std::size_t j = 0; j < tooth; ++j) angle += pitch[j];
  return angle;
}

double Cutter::radius_of(std::size_t tooth) const {
  return radius() + run_out * std::cos(run_out_angle + behind(tooth));
}

std::size_t Cutter::pattern() const {
  const std::size_t n = teeth();
  constexpr double same = 1e-12;
  for (std::size_t k = 1; k < n; ++k) {
    bool repeats = n % k == 0;
    for (std::size_t j = 0; repeats && j < n; ++j) repeats = std::abs(pitch[j] - pitch[(j + k) % n]) < same;
    if (repeats) return k;
  }
  return n;
}

double Cutter::period(bool told_apart) const {
  return told_apart && run_out > 0.0 ? full_turn : behind(pattern());
}

double Cutter::mean_radius(double from, double to) const {
  if (edge) return edge->mean_radius(from, to);
  if (!(corner > 0.0)) return radius();
  // ∫ √(c² − (c − z)²) dz up to a height within the corner.
  const auto rounded = [&](double z) {
    const double a = arc(z);
    return 0.5 * corner * corner * (a - std::sin(a) * std::cos(a));
  };
  const double low = std::max(0.0, from), high = std::max(0.0, to);
  if (!(low < high)) return radius() - corner;
  const double within = std::min(high, corner) - std::min(low, corner);
  return (rounded(high) - rounded(low) + (radius() - corner) * within + radius() * (high - low - within)) /
         (high - low);
}

double Cutter::radius_at(double z) const {
  if (edge) return edge->mean_radius(z, z);
  return corner > 0.0 ? radius() - corner + corner * std::sin(arc(z)) : radius();
}

double Cutter::profile(double from, double to) const {
  if (edge) return edge->length(from, to);
  if (!(corner > 0.0)) return to - from;
  return corner * (arc(to) - arc(from)) + std::max(to, corner) - std::max(from, corner);
}

double Cutter::lead(double from, double to) const {
  constexpr double quarter = 0.5 * std::numbers::pi;
  if (edge) return edge->lead(from, to);
  if (!(corner > 0.0)) return quarter;
  return std::min(quarter, arc(from) + 0.5 * profile(from, to) / corner);
}

std::vector<double> equal_pitch(std::size_t teeth) {
  return std::vector<double>(teeth, 2.0 * std::numbers::pi / static_cast<double>(teeth));
}

double Engagement::side_cosine(const Cutter& cutter, double radius) const {
  const double beyond = cutter.radius() - radial_depth; // m, of the side from the axis
  if (beyond == 0.0) return 0.0;                        // also at the tip of a ball
  return radius > std::abs(beyond) ? beyond / radius : std::copysign(1.0, beyond);
}

double Engagement::entry(const Cutter& cutter, double radius) const {
  return side == Side::up ? 0.0 : std::acos(-side_cosine(cutter, radius));
}

double Engagement::exit(const Cutter& cutter, double radius) const {
  return side == Side::up ? std::acos(side_cosine(cutter, radius)) : std::numbers::pi;
}

} // namespace cnem::machining
