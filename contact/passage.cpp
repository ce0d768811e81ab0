#include "contact/passage.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cnem::contact {
namespace {

constexpr double least_step = 1e-4; ///< of the path

bool look_away(const Vec3& entered, const Vec3& left) { return entered.dot(left) < -0.4; }

} // namespace

double passed_by_tracing(const ToolShape<3>& shape, const Vec3& from, const Vec3& to) {
  const double length = (to - from).norm();
  if (!(length > 0.0)) return 0.0;
  SurfacePoint<3> now = shape.closest(from);
  bool inside = now.distance < 0.0;
  Vec3 entered_by = now.normal;
  double at = 0.0, entered = 0.0, most = 0.0;
  while (at < length) {
    at = std::min(length, at + std::max(std::abs(now.distance), least_step * length));
    now = shape.closest(from + at / length * (to - from));
    if ((now.distance < 0.0) == inside) continue;
    inside = !inside;
    if (inside)
      entered = at, entered_by = now.normal;
    else if (look_away(entered_by, now.normal))
      most = std::max(most, at - entered);
  }
  return most;
}

double thickness_by_tracing(const ToolShape<3>& shape, std::span<const Vec3> surface, const Vec3& direction) {
  double least = std::numeric_limits<double>::infinity();
  const Box<3> box = shape.bounds();
  const double size = (box.high - box.low).norm();
  for (const Vec3& x : surface) {
    const double facing = shape.closest(x).normal.dot(direction);
    if (facing == 0.0) continue;
    const Vec3 inwards = facing < 0.0 ? direction : Vec3(-direction);
    for (const double length : {1e-6, 1e-3, 1.0}) { // steps along a long path pass foils
      const double thickness =
          passed_by_tracing(shape, x - 1e-9 * size * inwards, x + length * size * inwards);
      if (thickness == 0.0) continue;
      least = std::min(least, thickness);
      break;
    }
  }
  return least;
}

} // namespace cnem::contact
