#pragma once
// Tools in space and their surfaces in triangles, to compare with.
#include "contact/placed_shape.hpp"
#include "contact/swept_shape.hpp"
#include "contact/triangle_shape.hpp"
#include "masses.hpp"

#include <Eigen/Geometry>
#include <map>

namespace cnem::contact::testing {

/// A box between two corners, in twelve triangles.
inline TriangleSurface triangle_box(const Vec3& low, const Vec3& high) {
  TriangleSurface box;
  for (int k = 0; k < 8; ++k)
    box.points.push_back(
        {k & 1 ? high.x() : low.x(), k & 2 ? high.y() : low.y(), k & 4 ? high.z() : low.z()});
  for (const auto& [a, b, c, d] : std::vector<std::array<std::int32_t, 4>>{
           {0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}) {
    box.triangles.push_back({a, b, c});
    box.triangles.push_back({a, c, d});
  }
  return box;
}

/// A sphere about the origin: an octahedron whose triangles are divided in four again and again.
inline TriangleSurface triangle_sphere(double radius, int divisions) {
  TriangleSurface ball;
  ball.points = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  ball.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  for (int k = 0; k < divisions; ++k) {
    std::map<std::array<std::int32_t, 2>, std::int32_t> middle;
    const auto between = [&](std::int32_t a, std::int32_t b) {
      const auto [found, is_new] =
          middle.try_emplace({std::min(a, b), std::max(a, b)}, static_cast<std::int32_t>(ball.points.size()));
      if (is_new)
        ball.points.push_back((ball.points[std::size_t(a)] + ball.points[std::size_t(b)]).normalized());
      return found->second;
    };
    std::vector<std::array<std::int32_t, 3>> finer;
    for (const auto& [a, b, c] : ball.triangles) {
      const std::int32_t ab = between(a, b), bc = between(b, c), ca = between(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    ball.triangles = finer;
  }
  for (Vec3& x : ball.points) x *= radius;
  return ball;
}

/// Half a disc about (0, 0), right of the axis.
inline Curve half_disc(double radius) {
  Curve curve;
  curve.pieces = {arc({0, -radius}, {radius, 0}, {0, 0}), arc({radius, 0}, {0, radius}, {0, 0}),
                  segment({0, radius}, {0, -radius})};
  return curve;
}

/// A punch with a rounded edge: radius r, from z = 0 up, edge radius e.
inline Curve punch_section(double r, double height, double e) {
  Curve curve;
  curve.pieces = {segment({0, 0}, {r - e, 0}), arc({r - e, 0}, {r, e}, {r - e, e}),
                  segment({r, e}, {r, height}), segment({r, height}, {0, height}),
                  segment({0, height}, {0, 0})};
  return curve;
}

/// A die right of x = inner, below z = 0, with a rounded edge.
inline Curve die_section(double inner, double outer, double depth, double e) {
  Curve curve;
  curve.pieces = {segment({inner, -depth}, {outer, -depth}), segment({outer, -depth}, {outer, 0}),
                  segment({outer, 0}, {inner + e, 0}), arc({inner + e, 0}, {inner, -e}, {inner + e, -e}),
                  segment({inner, -e}, {inner, -depth})};
  return curve;
}

} // namespace cnem::contact::testing
