// Ridges of tools in space against edges and facets of the workpiece.
#include "contact/surface.hpp"
#include "core/index.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

namespace cnem::contact {
namespace {

constexpr double rounding = 1e-9;       ///< of the length of an edge
constexpr double least_crossing = 0.05; ///< sine of the angle between an edge and a ridge that crosses it
constexpr double most_overhang = 0.1;   ///< of the length of an edge
constexpr double half_reach = 0.5 + most_overhang;

/// Normals of facets are normals of an edge between them, and those a sixth of a turn beyond.
const double beyond = std::numbers::pi / 6.0;

Vec3 normal_of(const Surface<3>& surface, FacetIndex facet, PlacesOnBoundary<3> position) {
  const auto& [a, b, c] = surface.facets[facet];
  return (position[b] - position[a]).cross(position[c] - position[a]).normalized();
}

/// Where an edge and a ridge come closest to each other.
struct Crossing {
  Vec3 normal{0, 0, 0}; ///< –, unit, out of the tool, normal to both
  double on_edge = 0.0; ///< from 0 to 1 between its ends
  double gap = 0.0;     ///< m, along the normal, with the chord's sagitta
};

class EdgeAt {
public:
  EdgeAt(const Surface<3>& surface, SurfaceEdgeIndex edge, PlacesOnBoundary<3> position, const Vec3& shift)
      : surface_(surface), edge_(surface.edges[edge]), position_(position),
        a_(position[edge_.node[0]] - shift), along_(position[edge_.node[1]] - position[edge_.node[0]]),
        length_(along_.norm()) {}

  double length() const { return length_; }

  /// None where they are nearly parallel, off each other's ends or by more than half the edge, or where the
  /// normal does not face both.
  std::optional<Crossing> crossing(const Ridge<3>& ridge) const {
    if (ridge.path == Ridge<3>::Path::straight) return crossing_at(ridge, ridge.at(0.0));
    // Newton's way to where the edge is over the circle: from tangent to tangent
    Ridge<3>::Place place = ridge.facing(a_ + 0.5 * along_);
    for (int step = 0; step < 10; ++step) {
      const auto s = place_on_edge(place);
      if (!s) return {};
      const Ridge<3>::Place next = ridge.facing(a_ + std::clamp(*s, -0.5, 1.5) * along_);
      const double change = (next.u - place.u).norm();
      place = next;
      if (change * ridge.section.centre.x() <= rounding * length_) return crossing_at(ridge, place);
    }
    return {};
  }

  /// Whether no point of it, with its overhang, is as near to the path as a crossing that counts.
  bool beyond_reach(const Ridge<3>& ridge) const {
    const Vec2 middle = ridge.across(a_ + 0.5 * along_);
    const double far = (middle - ridge.section.centre).norm();
    if (far > ridge.reach(length_)) return true;
    if (ridge.path != Ridge<3>::Path::circular || middle.x() < 2.0 * half_reach * length_) return false;
    // Seen along the circle it is nearly straight: radii bend by less than this.
    const double bent =
        0.5 * half_reach * half_reach * length_ * length_ / (middle.x() - half_reach * length_);
    const Vec2 first = ridge.across(a_ - most_overhang * along_) - ridge.section.centre,
               chord = ridge.across(a_ + (1.0 + most_overhang) * along_) - ridge.section.centre - first;
    const double square = chord.squaredNorm(),
                 s = square > 0.0 ? std::clamp(-first.dot(chord) / square, 0.0, 1.0) : 0.0;
    const double least = (first + s * chord).norm() - bent;
    return least > (1.0 + rounding) * std::max(ridge.section.radius, 0.5 * length_);
  }

private:
  /// Where it is closest to the tangent.
  std::optional<double> place_on_edge(const Ridge<3>::Place& place) const {
    const double across = along_.dot(place.tangent), det = length_ * length_ - across * across;
    if (det < least_crossing * least_crossing * length_ * length_) return {};
    const Vec3 from = place.centre - a_;
    return (along_.dot(from) - across * place.tangent.dot(from)) / det;
  }

  /// Whether a normal looks into the workpiece, between the normals of the facets or nearly so.
  bool faced_by(const Vec3& normal, const Vec3& one, const Vec3& other) const {
    const Vec3 outwards = (one + other).stableNormalized();
    const double half = std::acos(std::clamp(one.dot(outwards), -1.0, 1.0));
    return -normal.dot(outwards) >= std::max(0.0, std::cos(half + beyond));
  }

  std::optional<Crossing> crossing_at(const Ridge<3>& ridge, const Ridge<3>::Place& place) const {
    const auto s = place_on_edge(place);
    if (!s || *s < -most_overhang || *s > 1.0 + most_overhang) return {};
    Crossing at;
    at.on_edge = *s;
    const Vec3 x = a_ + *s * along_, off = x - place.centre;
    if (!on_path(ridge, place, off)) return {};
    at.normal = along_.cross(place.tangent).normalized();
    if (std::abs(at.normal.dot(off)) > length_ + ridge.section.radius) return {};
    const Vec3 one = normal_of(surface_, edge_.facet[0], position_);
    const Vec3 other = exists(edge_.facet[1]) ? normal_of(surface_, edge_.facet[1], position_) : one;
    if (at.normal.dot(one + other) > 0.0) at.normal = -at.normal;
    if (!ridge.faces(at.normal, place) || !faced_by(at.normal, one, other)) return {};
    const double parallel = along_.dot(place.tangent), across2 = length_ * length_ - parallel * parallel;
    // a ridge round a circle is curved along its path too: of a ball as much as across
    double round = 0.0;
    if (ridge.path == Ridge<3>::Path::circular) {
      const double out = ridge.section.radius * at.normal.dot(place.u);
      if (out > 0.0) round = out / (ridge.section.centre.x() + out);
    }
    at.gap = at.normal.dot(off) - ridge.section.radius +
             ridge.section.sagitta(std::sqrt(across2 + round * parallel * parallel));
    return at;
  }

  /// Whether the ridge is there at all; off: from the place to the crossing.
  bool on_path(const Ridge<3>& ridge, const Ridge<3>::Place& place, const Vec3& off) const {
    const double tolerance = rounding * length_;
    if (ridge.path == Ridge<3>::Path::straight) {
      const double at = place.tangent.dot(off);
      return at >= -tolerance && at <= ridge.length + tolerance;
    }
    if (ridge.length >= full_turn) return true;
    const double angle = tolerance / ridge.section.centre.x(), at = ridge.turn_towards(place.centre);
    return at <= ridge.length + angle || at >= full_turn - angle;
  }

  const Surface<3>& surface_;
  const SurfaceEdge& edge_;
  PlacesOnBoundary<3> position_;
  Vec3 a_, along_;
  double length_;
};

/// By how much of the edge's length a crossing beside its end counts: where the surface is hollow the next
/// edge may not be crossed either. No more than the ridge is deep.
double overhang(double gap, double length) {
  return rounding + std::min(most_overhang, 2.0 * std::abs(gap) / length);
}

std::optional<RidgeHit<3>> on_edge(const Surface<3>& surface, const Ridge<3>& ridge, SurfaceEdgeIndex e,
                                   PlacesOnBoundary<3> start, PlacesOnBoundary<3> end,
                                   const Vec3& shift_start, const Vec3& shift_end) {
  const EdgeAt now(surface, e, end, shift_end);
  if (now.beyond_reach(ridge)) return {};
  const auto crossing = now.crossing(ridge);
  if (!crossing || crossing->gap >= 0.0 || crossing->gap < -0.5 * now.length()) return {};
  const double over = overhang(crossing->gap, now.length());
  if (crossing->on_edge < -over || crossing->on_edge > 1.0 + over) return {};
  const auto before = EdgeAt(surface, e, start, shift_start).crossing(ridge);
  if (!before) return {};
  const double s = std::clamp(crossing->on_edge, 0.0, 1.0);
  const double passed = before->gap < -rounding * now.length() ? before->gap : std::max(before->gap, 0.0);
  const SurfaceEdge& edge = surface.edges[e];
  return RidgeHit<3>{0, edge.facet[0], edge.node, {1.0 - s, s, 0.0}, crossing->normal, crossing->gap, passed};
}

/// A facet as a point of a tool sees it.
struct FacetAt {
  Vec3 a, e, f, inwards;
  double area2; ///< m², twice its area

  FacetAt(const Surface<3>& surface, FacetIndex facet, PlacesOnBoundary<3> position, const Vec3& shift)
      : a(position[surface.facets[facet][0]] - shift),
        e(position[surface.facets[facet][1]] - position[surface.facets[facet][0]]),
        f(position[surface.facets[facet][2]] - position[surface.facets[facet][0]]), inwards(f.cross(e)),
        area2(inwards.norm()) {
    inwards /= area2;
  }
  double size() const { return std::sqrt(area2); }
  /// The chord of a ball through its corners: twice the radius of the circle round it.
  double chord() const { return e.norm() * f.norm() * (f - e).norm() / area2; }
  /// The centre of the ridge where it is met: of an arc towards the facet, in the middle where that is no
  /// way.
  Vec3 centre(const Ridge<3>& ridge) const {
    if (ridge.is_point()) return ridge.point();
    constexpr double level = 0.1; // of the tilt against the arc's plane
    const Vec3 towards = inwards - inwards.dot(ridge.v) * ridge.v + level * ridge.at(0.5 * ridge.length).u;
    double turn = ridge.turn_towards(ridge.origin + towards);
    if (turn > ridge.length) turn = turn < 0.5 * (ridge.length + full_turn) ? ridge.length : 0.0;
    return ridge.at(turn).centre;
  }
  double gap(const Ridge<3>& ridge, const Vec3& centre) const {
    double gap = inwards.dot(a - centre) - ridge.section.radius + ridge.section.sagitta(chord());
    if (!ridge.is_point()) {
      const Ridge<2> arc = ridge.arc();
      gap += (1.0 - arc.sharpness(chord())) * arc.sagitta(chord());
    }
    return gap;
  }
  std::array<double, 3> weights(const Vec3& x) const {
    const double s = (x - a).cross(f).dot(-inwards) / area2, t = e.cross(x - a).dot(-inwards) / area2;
    return {1.0 - s - t, s, t};
  }
};

std::optional<RidgeHit<3>> on_facet(const Surface<3>& surface, const Ridge<3>& ridge, FacetIndex facet,
                                    PlacesOnBoundary<3> start, PlacesOnBoundary<3> end,
                                    const Vec3& shift_start, const Vec3& shift_end) {
  const FacetAt now(surface, facet, end, shift_end);
  if (!ridge.is_point() && ridge.arc().sharpness(now.chord()) == 0.0) return {};
  const Vec3 centre = now.centre(ridge);
  const double gap = now.gap(ridge, centre);
  if (!(gap < 0.0) || gap < -0.5 * now.size() || !ridge.faces(now.inwards)) return {};
  std::array<double, 3> weight = now.weights(centre + ridge.section.radius * now.inwards);
  const double over = overhang(gap, now.size());
  double sum = 0.0;
  for (double& w : weight) {
    if (w < -over) return {};
    sum += w = std::max(w, 0.0);
  }
  for (double& w : weight) w /= sum;
  const FacetAt was(surface, facet, start, shift_start);
  const double before = was.gap(ridge, was.centre(ridge));
  const double passed = before < -rounding * now.size() ? before : std::max(before, 0.0);
  return RidgeHit<3>{0, facet, surface.facets[facet], weight, now.inwards, gap, passed};
}

/// What was well inside already and is pushed out another way than what it shares a node with, which is less
/// deep, came in through that. Little depth stays: a ridge may press on both sides of an edge of the
/// workpiece.
void drop_seen_from_behind(PlacesOnBoundary<3> position, std::vector<RidgeHit<3>>& hits, std::size_t first) {
  constexpr double deep = 0.05; // of the length of an edge
  const auto is_deep = [&](const RidgeHit<3>& hit) {
    return -hit.start > deep * (position[hit.node[1]] - position[hit.node[0]]).norm();
  };
  if (std::none_of(hits.begin() + static_cast<std::ptrdiff_t>(first), hits.end(), is_deep)) return;
  const auto share_node = [](const RidgeHit<3>& one, const RidgeHit<3>& other) {
    for (std::size_t a = 0; a < 3; ++a)
      for (std::size_t b = 0; b < 3; ++b)
        if (one.weight[a] > 0.0 && other.weight[b] > 0.0 && one.node[a] == other.node[b]) return true;
    return false;
  };
  const std::vector<RidgeHit<3>> all(hits.begin() + static_cast<std::ptrdiff_t>(first), hits.end());
  hits.resize(first);
  for (const RidgeHit<3>& hit : all)
    if (!is_deep(hit) || std::none_of(all.begin(), all.end(), [&](const RidgeHit<3>& other) {
          return other.start > hit.start && other.normal.dot(hit.normal) < 0.5 && share_node(hit, other);
        }))
      hits.push_back(hit);
}

} // namespace

template<>
void ridge_hits<3>(const Surface<3>& surface, std::span<const RidgePair> candidates,
                   const ToolShape<3>& shape, PlacesOnBoundary<3> start, PlacesOnBoundary<3> end,
                   const Vec3& shift_start, const Vec3& shift_end, std::vector<RidgeHit<3>>& hits) {
  const std::vector<Ridge<3>>& ridges = shape.ridges();
  const std::size_t first = hits.size();
  for (const RidgePair& pair : candidates) {
    const Ridge<3>& ridge = ridges[index_of(pair.ridge)];
    auto hit = exists(pair.edge) ? on_edge(surface, ridge, pair.edge, start, end, shift_start, shift_end)
                                 : on_facet(surface, ridge, pair.facet, start, end, shift_start, shift_end);
    if (!hit) continue;
    hit->ridge = pair.ridge;
    hits.push_back(*hit);
  }
  drop_seen_from_behind(end, hits, first);
}

/// Corners and tips alone: along an edge that has entered the workpiece the nodes beside it tell.
template<>
std::vector<RidgeDepth<3>> ridges_inside<3>(const Surface<3>& surface, const ToolShape<3>& shape,
                                            PlacesOnBoundary<3> position, const Vec3& shift) {
  std::vector<RidgeDepth<3>> found;
  for (const Ridge<3>& ridge : shape.ridges()) {
    if (!ridge.is_point()) continue;
    const Vec3 tip = ridge.point() + shift;
    double angle = 0.0, least = std::numeric_limits<double>::infinity();
    RidgeDepth<3> inside{{}, 0.0, tip};
    for (const auto& nodes :
         surface.facets) { // winding number: the solid angles (van Oosterom, Strackee 1983)
      const Vec3 a = position[nodes[0]] - tip, b = position[nodes[1]] - tip, c = position[nodes[2]] - tip;
      const double la = a.norm(), lb = b.norm(), lc = c.norm();
      angle +=
          2.0 * std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
      const Vec3 n = (b - a).cross(c - a).normalized();
      const Vec3 foot = n.dot(a) * n;
      const bool above = (b - a).cross(foot - a).dot(n) >= 0.0 && (c - b).cross(foot - b).dot(n) >= 0.0 &&
                         (a - c).cross(foot - c).dot(n) >= 0.0;
      const double distance = above ? std::abs(n.dot(a)) : std::min({la, lb, lc});
      if (distance >= least) continue;
      least = distance;
      inside.node = nodes[la <= lb && la <= lc ? 0 : lb <= lc ? 1 : 2];
    }
    if (angle < full_turn) continue;
    inside.depth = least;
    found.push_back(inside);
  }
  return found;
}

} // namespace cnem::contact
