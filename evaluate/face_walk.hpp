#pragma once
// The outline of a body as a walk by its length, which sheared faces are measured on.
#include "core/index.hpp"
#include "evaluate/sheared_face.hpp"

#include <algorithm>
#include <cmath>

namespace cnem::evaluate {

/// A polyline by its length.
struct FaceWalk {
  std::vector<Vec2> point;
  std::vector<FaceSurface> surface; ///< [segment]
  std::vector<double> at;           ///< [point] m, length from the start
  std::vector<double> aside;        ///< [point] m, how much of it is of other surfaces

  void measure() {
    at.assign(1, 0.0);
    aside.assign(1, 0.0);
    for (std::size_t k = 1; k < point.size(); ++k) {
      const double size = (point[k] - point[k - 1]).norm();
      at.push_back(at.back() + size);
      aside.push_back(aside.back() + (surface[k - 1] == FaceSurface::other ? size : 0.0));
    }
  }
  std::size_t segments() const { return point.empty() ? 0 : point.size() - 1; }
  double length() const { return at.back(); }
  /// The point at which the segment of a length ends.
  std::size_t end_of(double l) const {
    const auto upper = std::upper_bound(at.begin(), at.end(), l) - at.begin();
    return index_of(std::clamp<std::ptrdiff_t>(upper, 1, std::ssize(at) - 1));
  }
  FaceSurface surface_at(double l) const { return surface[end_of(l) - 1]; }
  Vec2 operator()(double l) const {
    const std::size_t k = end_of(l);
    const double size = at[k] - at[k - 1];
    const double s = size > 0.0 ? std::clamp((l - at[k - 1]) / size, 0.0, 1.0) : 0.0;
    return (1.0 - s) * point[k - 1] + s * point[k];
  }
  /// Angle of the chord of this length that begins at l from the cutting direction, > 0 where the face
  /// recedes.
  double lean(double l, double chord) const {
    const Vec2 d = (*this)(std::min(l + chord, length())) - (*this)(l);
    return std::atan2(-d.x(), d.y());
  }
};

/// A vector in the frame of a body that has turned by the angle (rad) from u towards w.
Vec2 turned_back(const Vec2& x, double angle);

/// The outline as a walk along the drawn-in surface, up the face and back on the other side, from its point
/// furthest from the cut; it ends where it passes the limit, and `parted` says that it does not. Outlines
/// that have turned steeply are turned back first.
FaceWalk walk_of(const FaceOutline& outline, const FaceRules& rules, bool& parted);

/// A least-squares line w = a + b u through segments that run towards the cut, by length.
struct Line {
  double length = 0.0, slope = 0.0;
};
template<class Wanted> Line fitted(const FaceWalk& walk, double from, double to, Wanted&& wanted) {
  double length = 0.0, u = 0.0, w = 0.0, uu = 0.0, uw = 0.0;
  for (std::size_t k = 0; k < walk.segments() && walk.at[k + 1] <= to; ++k) {
    const Vec2 &a = walk.point[k], &b = walk.point[k + 1];
    const Vec2 middle = 0.5 * (a + b), d = b - a;
    if (walk.at[k] < from || std::abs(d.y()) > d.x() || !wanted(middle)) continue;
    const double l = d.norm();
    length += l;
    u += l * middle.x();
    w += l * middle.y();
    uu += l * (middle.x() * middle.x() + d.x() * d.x() / 12.0);
    uw += l * (middle.x() * middle.y() + d.x() * d.y() / 12.0);
  }
  const double spread = uu * length - u * u;
  return {length, spread > 0.0 ? (uw * length - u * w) / spread : 0.0};
}

} // namespace cnem::evaluate
