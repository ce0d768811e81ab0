#include "clouds/generate_boundary.hpp"
#include "clouds/space/patches.hpp"
#include "core/error.hpp"
#include "core/index.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace cnem::clouds {

namespace {

double radius_of(const CurvePiece& piece) { return piece.is_arc() ? piece.radius : straight; }

/// Spacing in the plane of a face that is unrolled without change of lengths.
SpacingField unrolled(const SpaceSpacing& spacing, double radius, std::function<Vec3(const Vec2&)> place) {
  SpacingField result{curved_spacing(spacing.spacing, radius), {}};
  if (!spacing.uniform())
    result.mapped = {[&spacing, radius, place = std::move(place)](const Vec2& x) {
                       return curved_spacing(spacing.at(place(x)), radius);
                     },
                     curved_spacing(spacing.finest(), radius), spacing.growth()};
  return result;
}

/// One curve of the outline with its nodes.
struct Ring {
  struct Edge {
    Polyline vertex;        ///< ends among them
    std::vector<double> at; ///< [vertex] fraction of the piece
  };
  std::array<std::vector<Edge>, 2> edges; ///< [end][piece]
  std::vector<Edge> posts;                ///< [piece] from the low to the high end, where it starts
};

Ring make_ring(SurfaceBuilder& surface, const Curve& curve, const std::array<double, 2>& z) {
  Ring ring;
  const std::size_t count = curve.pieces.size();
  const auto point = [](const Vec2& x, double height) { return Vec3(x.x(), x.y(), height); };
  std::array<Polyline, 2> corner;
  for (std::size_t end = 0; end < 2; ++end)
    for (const CurvePiece& piece : curve.pieces)
      corner[end].push_back(surface.add(point(piece.from, z[end])));
  const auto make = [&](const auto& place, double length, double radius, double turn, std::int32_t first,
                        std::int32_t last) {
    Ring::Edge edge{{first}, surface.divide(place, length, radius, turn)};
    for (std::size_t k = 1; k + 1 < edge.at.size(); ++k)
      edge.vertex.push_back(surface.add(place(edge.at[k])));
    edge.vertex.push_back(last);
    return edge;
  };
  for (std::size_t p = 0; p < count; ++p) {
    const CurvePiece& piece = curve.pieces[p];
    for (std::size_t end = 0; end < 2; ++end)
      ring.edges[end].push_back(make([&](double s) { return point(piece.point(s), z[end]); }, piece.length(),
                                     radius_of(piece), piece.sweep(), corner[end][p],
                                     corner[end][(p + 1) % count]));
    ring.posts.push_back(make([&](double s) { return point(piece.from, z[0] + s * (z[1] - z[0])); },
                              z[1] - z[0],
                              std::min(radius_of(piece), radius_of(curve.pieces[(p + count - 1) % count])),
                              0.0, corner[0][p], corner[1][p]));
  }
  return ring;
}

void add_sides(SurfaceBuilder& surface, const Curve& curve, const Ring& ring,
               const std::array<double, 2>& z) {
  for (std::size_t p = 0; p < curve.pieces.size(); ++p) {
    const CurvePiece& piece = curve.pieces[p];
    const double length = piece.length(), height = z[1] - z[0];
    const Ring::Edge &right = ring.posts[(p + 1) % curve.pieces.size()], &left = ring.posts[p];
    PatchLoop loop;
    const auto add = [&](const Ring::Edge& edge, bool back, const auto& place) {
      const std::size_t n = edge.vertex.size();
      for (std::size_t k = 0; k + 1 < n; ++k) {
        const std::size_t i = back ? n - 1 - k : k;
        loop.add(edge.vertex[i], place(edge.at[i]));
      }
    };
    add(ring.edges[0][p], false, [&](double s) { return Vec2(s * length, 0.0); });
    add(right, false, [&](double s) { return Vec2(length, s * height); });
    add(ring.edges[1][p], true, [&](double s) { return Vec2(s * length, height); });
    add(left, true, [&](double s) { return Vec2(0.0, s * height); });
    const auto place = [&piece, length, low = z[0]](const Vec2& x) {
      const Vec2 at = piece.point(x.x() / length);
      return Vec3(at.x(), at.y(), low + x.y());
    };
    surface.add_patch({{std::move(loop)},
                       unrolled(surface.spacing(), radius_of(piece), place),
                       place,
                       false,
                       surface.piece(piece.name)});
  }
}

} // namespace

Cloud<3> extruded_surface(const Extrusion& shape, const SpaceSpacing& spacing) {
  const std::array<double, 2> z{shape.from, shape.to};
  if (!(z[1] > z[0]) || !std::isfinite(z[1] - z[0]))
    throw GeometryError(fmt::format(
        "an outline drawn from z = {:g} to {:g} m has no volume; expected from < to", z[0], z[1]));
  if (!shape.outline.cracks.empty())
    throw GeometryError("an outline with cracks is not extruded; expected none");
  const DomainShape outline = checked_and_oriented(shape.outline);
  check_holes(outline);
  SurfaceBuilder surface(spacing);
  std::array<Patch, 2> ends;
  for (std::size_t end = 0; end < 2; ++end) {
    const auto place = [height = z[end]](const Vec2& x) { return Vec3(x.x(), x.y(), height); };
    ends[end] = {{},
                 unrolled(spacing, straight, place),
                 place,
                 end == 0,
                 surface.piece(end == 0 ? shape.low : shape.high)};
  }
  for (std::size_t c = 0; c <= outline.holes.size(); ++c) {
    const Curve& curve = c == 0 ? outline.outer : outline.holes[c - 1];
    const Ring ring = make_ring(surface, curve, z);
    for (std::size_t end = 0; end < 2; ++end) {
      PatchLoop loop;
      for (const Ring::Edge& edge : ring.edges[end])
        for (std::size_t k = 0; k + 1 < edge.vertex.size(); ++k)
          loop.add(edge.vertex[k], surface.at(edge.vertex[k]).head<2>());
      ends[end].loops.push_back(std::move(loop));
    }
    add_sides(surface, curve, ring, z);
  }
  for (const Patch& end : ends) surface.add_patch(end);
  return surface.take();
}

} // namespace cnem::clouds
