#include "clouds/generate_boundary.hpp"
#include "core/error.hpp"
#include "core/geometry/place_text.hpp"
#include "voronoi/plane/edge_tree.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <numbers>

namespace cnem::clouds {

namespace {

constexpr double clearance = 0.25;   // over h
constexpr double least_sine = 0.087; // of the angle at which a crack may leave the boundary, 5 degrees

struct Segment {
  Vec2 a, b;
};

struct Approach {
  double distance = std::numeric_limits<double>::infinity();
  Vec2 where{0, 0};
};

Approach point_to_segment(const Vec2& x, const Segment& s) {
  const Vec2 along = s.b - s.a;
  const double f = std::clamp((x - s.a).dot(along) / along.squaredNorm(), 0.0, 1.0);
  const Vec2 foot = s.a + f * along;
  return {(x - foot).norm(), foot};
}

Approach segment_to_segment(const Segment& s, const Segment& t) {
  const Vec2 u = s.b - s.a, v = t.b - t.a;
  const double from_s = cross(u, t.a - s.a) * cross(u, t.b - s.a);
  const double from_t = cross(v, s.a - t.a) * cross(v, s.b - t.a);
  if (from_s < 0.0 && from_t < 0.0) return {0.0, s.a + u * (cross(t.a - s.a, v) / cross(u, v))};
  return std::min({point_to_segment(s.a, t), point_to_segment(s.b, t), point_to_segment(t.a, s),
                   point_to_segment(t.b, s)},
                  [](const Approach& a, const Approach& b) { return a.distance < b.distance; });
}

std::vector<Segment> segments(const Crack& crack) {
  std::vector<Segment> result;
  for (std::size_t k = 1; k < crack.path.size(); ++k) result.push_back({crack.path[k - 1], crack.path[k]});
  return result;
}

/// Shortens a segment by one spacing, at most half its length, from its end a.
Segment without_start(const Segment& s, const SpacingField& spacing) {
  const double length = (s.b - s.a).norm();
  return {s.a + (s.b - s.a) * std::min(0.5, spacing.at(s.a) / length), s.b};
}

/// Whether a segment that starts on the straight side of an edge leaves it, at what angle ever: then only the
/// angle tells how far apart they are. Throws where it is below the least.
bool leaves_side(const Crack& crack, const Segment& from, const Segment& edge, const std::string& piece) {
  const Vec2 side = (edge.b - edge.a).normalized();
  constexpr double straight = 1e-3; // of the edge
  if (std::abs(cross(side, from.a - edge.a)) > straight * (edge.b - edge.a).norm()) return false;
  const double sine = std::abs(cross(side, (from.b - from.a).normalized()));
  if (sine < least_sine)
    throw GeometryError(
        fmt::format("crack '{}' leaves the boundary '{}' at {} at {:.3g} degrees; expected 5 degrees or more",
                    crack.name, piece, place_text(from.a), std::asin(sine) * 180.0 / std::numbers::pi));
  return true;
}

void check_against_boundary(const Crack& crack, const std::array<bool, 2>& open, const SpacingField& spacing,
                            const Cloud<2>& outline, const voronoi::EdgeTree& tree) {
  std::vector<Segment> parts = segments(crack);
  const Segment first = parts.front(), last{parts.back().b, parts.back().a};
  if (open[0]) parts.front() = without_start(parts.front(), spacing);
  if (open[1]) {
    const Segment back = without_start({parts.back().b, parts.back().a}, spacing);
    parts.back() = {back.b, back.a};
  }
  for (const Segment& part : parts) {
    for (const Facet<2>& f : outline.facets) {
      const Segment edge{outline.position[std::size_t(f.node[0])], outline.position[std::size_t(f.node[1])]};
      const Approach gap = segment_to_segment(part, edge);
      if (gap.distance >= clearance * spacing.at(gap.where)) continue;
      const std::string& piece = outline.piece_names[f.piece];
      if (open[0] && &part == &parts.front() && leaves_side(crack, first, edge, piece)) continue;
      if (open[1] && &part == &parts.back() && leaves_side(crack, last, edge, piece)) continue;
      throw GeometryError(fmt::format(
          "crack '{}' {} the boundary '{}' at {}; expected it to keep a quarter of the spacing "
          "({:.3g} m) away, or to end exactly on it",
          crack.name, gap.distance > 0.0 ? fmt::format("comes within {:.3g} m of", gap.distance) : "crosses",
          piece, place_text(gap.where), clearance * spacing.at(gap.where)));
    }
    for (const Vec2& x : {part.a, part.b})
      if (!tree.inside(x))
        throw GeometryError(
            fmt::format("crack '{}' leaves the domain: {} is outside", crack.name, place_text(x)));
  }
}

void check_itself(const Crack& crack, const SpacingField& spacing) {
  const std::vector<Segment> parts = segments(crack);
  for (std::size_t i = 0; i < parts.size(); ++i)
    for (std::size_t j = i + 1; j < parts.size(); ++j) {
      const Segment first = j == i + 1 ? Segment{without_start({parts[i].b, parts[i].a}, spacing)} : parts[i];
      const Approach gap = segment_to_segment(first, parts[j]);
      if (gap.distance < clearance * spacing.at(gap.where))
        throw GeometryError(
            fmt::format("crack '{}' touches or nearly touches itself at {}; expected a simple, "
                        "open polyline without sharp turns",
                        crack.name, place_text(gap.where)));
    }
}

} // namespace

void check_holes(const DomainShape& domain) {
  if (domain.holes.empty()) return;
  const SpacingField fine{domain_size(domain) / 1000.0, {}};
  const voronoi::EdgeTree outline(assemble_boundary(discretise_boundary({domain.outer, {}, {}}, fine)));
  for (std::size_t k = 0; k < domain.holes.size(); ++k) {
    const CurvePiece& piece = domain.holes[k].pieces.front();
    if (!outline.inside(piece.from))
      throw GeometryError(fmt::format("hole {} ('{}') is not inside the outline: its point {} is outside",
                                      k + 1, piece.name, place_text(piece.from)));
  }
}

void check_cracks(const DomainShape& domain, const SpacingField& spacing, const Cloud<2>& outline) {
  if (domain.cracks.empty()) return;
  std::vector<std::array<bool, 2>> open(domain.cracks.size(), {false, false});
  for (const Mouth& mouth : find_mouths(domain, 1e-6 * domain_size(domain)))
    open[mouth.crack][mouth.at_end ? 1 : 0] = true;
  const voronoi::EdgeTree tree(outline);
  for (std::size_t c = 0; c < domain.cracks.size(); ++c) {
    const Crack& crack = domain.cracks[c];
    check_against_boundary(crack, open[c], spacing, outline, tree);
    check_itself(crack, spacing);
    for (std::size_t d = 0; d < c; ++d)
      for (const Segment& s : segments(crack))
        for (const Segment& t : segments(domain.cracks[d])) {
          const Approach gap = segment_to_segment(s, t);
          if (gap.distance < clearance * spacing.at(gap.where))
            throw GeometryError(fmt::format(
                "cracks '{}' and '{}' cross, touch or nearly touch at {}; expected separate cracks "
                "(describe branches as notches of the outline)",
                domain.cracks[d].name, crack.name, place_text(gap.where)));
        }
  }
}

} // namespace cnem::clouds
