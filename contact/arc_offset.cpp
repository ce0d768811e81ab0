#include "contact/arc_offset.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace cnem::contact {
namespace {

/// A chord from one node to the next of the boundary, as the tool sees it.
struct ArcChord {
  Vec2 a, along; ///< m; –, unit
  double length; ///< m

  ArcChord(const Vec2& from, const Vec2& to)
      : a(from), along((to - from).normalized()), length((to - from).norm()) {}
};

/// The part of a chord that faces the arc of a ridge; empty where to ≤ from.
struct ArcPart {
  double from = 0.0, to = 0.0; ///< m, from the chord's first end
};

ArcPart part_on(const ArcChord& chord, const Ridge<2>& ridge) {
  if (ridge.angle >= 2.0 * std::numbers::pi) return {0.0, chord.length};
  const Vec2 normal = left_normal(chord.along);
  double turn = std::atan2(cross(ridge.first, normal), ridge.first.dot(normal));
  if (turn < 0.5 * ridge.angle - std::numbers::pi) turn += 2.0 * std::numbers::pi;
  const double middle = chord.along.dot(ridge.centre - chord.a); // where the arc is parallel to the chord
  return {std::max(0.0, middle - ridge.radius * (ridge.angle - turn)),
          std::min(chord.length, middle + ridge.radius * turn)};
}

/// m², ∫ x (l − x)/2r (1 − x/l) dx: of the area, the first end's share.
double first_share(double l, double r, const ArcPart& part) {
  const auto below = [&](double x) { return x * x * (0.5 * l * l - x * (2.0 / 3.0 * l - 0.25 * x)); };
  return (below(part.to) - below(part.from)) / (2.0 * r * l);
}

} // namespace

template<>
Vec2 arc_offset<2>(const Surface<2>& surface, const ToolShape<2>& shape, BoundaryNodeIndex node,
                   PlacesOnBoundary<2> position, const Vec2& shift) {
  const Vec2 x = position[node] - shift;
  double area = 0.0, width = 0.0;
  for (const bool leaving : {false, true}) {
    const FacetIndex facet = leaving ? surface.leaving[node] : surface.entering[node];
    if (!exists(facet)) continue;
    const Vec2 other = position[surface.facets[facet][leaving ? 1 : 0]] - shift;
    const ArcChord chord = leaving ? ArcChord(x, other) : ArcChord(other, x);
    const double l = chord.length;
    width += 0.5 * l;
    for (const Ridge<2>& ridge : shape.ridges()) {
      const double r = ridge.radius;
      if (r == 0.0 || (x - ridge.centre).norm() > r + 2.0 * l) continue;
      const ArcPart part = part_on(chord, ridge);
      if (part.to <= part.from) continue;
      const double off = std::max(shape.closest(x).distance, shape.closest(other).distance);
      const double touching = smooth_step(4.0 / 3.0 - off / (0.5 * l * l / r));
      const ArcPart mine = leaving ? part : ArcPart{l - part.to, l - part.from};
      area += touching * (1.0 - ridge.sharpness(l)) * first_share(l, r, mine);
    }
  }
  return area > 0.0 ? Vec2(-area / width * shape.closest(x).normal) : Vec2(Vec2::Zero());
}

template<>
Vec3 arc_offset<3>(const Surface<3>&, const ToolShape<3>&, BoundaryNodeIndex, PlacesOnBoundary<3>,
                   const Vec3&) {
  return Vec3::Zero();
}

} // namespace cnem::contact
