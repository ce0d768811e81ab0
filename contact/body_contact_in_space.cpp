// Bodies on bodies in space: nodes against facets, and edges against edges, which cross between nodes.
#include "contact/body_contact.hpp"
#include "core/geometry/box_tree.hpp"
#include "core/index.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace cnem::contact {
namespace {

constexpr double skin_of_facets = 0.5;   ///< skin over the mean length of edges
constexpr double narrow_skin = 0.125;    ///< of the skin, between edges that are looked at in each step
constexpr double clearance = 1e-6;       ///< of a facet's size: what stays between bodies that touch
constexpr double rounding = 1e-9;        ///< of a facet's size: a gap of nothing
constexpr double overhang = 1e-6;        ///< of a facet's size, by which crossings beside it count
constexpr double facing = -0.25;         ///< cosine between normals below which two facets face each other
constexpr double least_crossing = 0.005; ///< sine of the angle between edges that cross

/// A facet at one time.
struct FacetView {
  Vec3 a, e, f, normal;
  double area2, size; ///< m², twice the area; m

  FacetView(const Surface<3>& surface, FacetIndex facet, PlacesOnBoundary<3> position)
      : a(position[surface.facets[facet][0]]), e(position[surface.facets[facet][1]] - a),
        f(position[surface.facets[facet][2]] - a), normal(e.cross(f)), area2(normal.norm()),
        size(std::sqrt(area2)) {
    normal /= area2;
  }
  double gap(const Vec3& x) const { return normal.dot(x - a); }
  std::array<double, 3> weights(const Vec3& x) const {
    const double s = (x - a).cross(f).dot(normal) / area2, t = e.cross(x - a).dot(normal) / area2;
    return {1.0 - s - t, s, t};
  }
  Vec3 at(const std::array<double, 3>& w) const { return a + w[1] * e + w[2] * f; }
  Vec3 middle() const { return a + (e + f) / 3.0; }
  /// The nearest point, by projection on the plane and the three sides.
  Vec3 nearest(const Vec3& x) const {
    const auto w = weights(x);
    if (std::min({w[0], w[1], w[2]}) >= 0.0) return at(w);
    Vec3 best = a;
    double least = std::numeric_limits<double>::infinity();
    const std::array<Vec3, 3> corner{a, a + e, a + f};
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 side = corner[(k + 1) % 3] - corner[k];
      const Vec3 p = corner[k] + std::clamp(side.dot(x - corner[k]) / side.squaredNorm(), 0.0, 1.0) * side;
      if (const double d = (x - p).squaredNorm(); d < least) least = d, best = p;
    }
    return best;
  }
};

bool inside(const std::array<double, 3>& w, double over) { return std::min({w[0], w[1], w[2]}) >= -over; }

std::array<double, 3> clamped(std::array<double, 3> w) {
  double sum = 0.0;
  for (double& share : w) sum += share = std::max(share, 0.0);
  for (double& share : w) share /= sum;
  return w;
}

/// [facet] whether matter goes on behind it, at a period; empty: behind none.
using Sides = IndexedVector<FacetIndex, char>;

bool is_side(const Sides& sides, FacetIndex facet) { return !sides.empty() && sides[facet] != 0; }

bool faces(const Surface<3>& surface, const Sides& sides, BoundaryNodeIndex node, const Vec3& normal,
           PlacesOnBoundary<3> position) {
  return std::any_of(surface.around[node].begin(), surface.around[node].end(), [&](FacetIndex f) {
    return !is_side(sides, f) && FacetView(surface, f, position).normal.dot(normal) < facing;
  });
}

/// How often the boundary encloses x: the facets through which a ray upwards goes out, less those through
/// which it comes in. Of a ray through an edge or a node the neighbour at (ε, ε²) decides. facets: tree of
/// their boxes. O(log F) and what is above.
int winding_number(const Surface<3>& surface, PlacesOnBoundary<3> position, const BoxTree& facets,
                   const Vec3& x) {
  // of the line through two nodes as seen from above, from the lower to the higher one: to rounding the same
  // for both facets there
  const auto side = [&](BoundaryNodeIndex p, BoundaryNodeIndex q) {
    const bool turned = q < p;
    if (turned) std::swap(p, q);
    const Vec3 to = position[q] - position[p], at = x - position[p];
    double left = to.x() * at.y() - to.y() * at.x();
    if (left == 0.0) left = to.y() != 0.0 ? -to.y() : to.x();
    return (left > 0.0) != turned ? 1 : -1;
  };
  Box<3> ray{x, x};
  ray.high.z() = std::numeric_limits<double>::infinity();
  int count = 0;
  facets.overlapping(ray, [&](std::int32_t i) {
    const auto& [p, q, r] = surface.facets[as<FacetIndex>(i)];
    const int up = side(p, q);
    if (side(q, r) != up || side(r, p) != up) return;
    const Vec3 a = position[p] - x, b = position[q] - x, c = position[r] - x;
    if (up * a.dot(b.cross(c)) > 0.0) count += up;
  });
  return count;
}

/// How many bodies, and images of them, are at x.
int bodies_at(const Surface<3>& surface, PlacesOnBoundary<3> position, const BoxTree& facets,
              std::span<const Vec3> shifts, const Vec3& x) {
  int bodies = 0;
  for (const Vec3& shift : shifts) bodies += winding_number(surface, position, facets, x - shift);
  return bodies;
}

/// Of things that are shifted those in a box, in increasing order.
void find_near(const BoxTree& things, Box<3> box, const Vec3& shift, std::vector<std::int32_t>& near) {
  near.clear();
  box.low -= shift;
  box.high -= shift;
  things.overlapping(box, [&](std::int32_t i) { near.push_back(i); });
  std::sort(near.begin(), near.end());
}

Box<3> box_of(PlacesOnBoundary<3> position, std::span<const BoundaryNodeIndex> nodes, double margin) {
  Box<3> box = cnem::box_of<3>(nodes, [&](BoundaryNodeIndex b) -> const Vec3& { return position[b]; });
  box.low.array() -= margin;
  box.high.array() += margin;
  return box;
}

/// A hit with when it happened, to choose between facets that meet.
struct Candidate {
  FacetHit<3> hit;
  double when;
};

/// Of two facets that meet at a convex edge or corner of their body, a node came in through the one it passed
/// last. same(node, other, shift of the other): whether they are one point.
template<class Same>
void keep_last_passed(const Surface<3>& surface, PlacesOnBoundary<3> position, Same&& same,
                      std::vector<Candidate>& of_node) {
  const auto beaten = [&](const Candidate& c) {
    return std::any_of(of_node.begin(), of_node.end(), [&](const Candidate& other) {
      const auto &f = surface.facets[c.hit.facet], &g = surface.facets[other.hit.facet];
      const Vec3 shift = other.hit.shift - c.hit.shift;
      const auto shared = [&](BoundaryNodeIndex p, BoundaryNodeIndex q) { return same(p, q, shift); };
      if (&c == &other || std::find_first_of(f.begin(), f.end(), g.begin(), g.end(), shared) == f.end())
        return false;
      const FacetView mine(surface, c.hit.facet, position), theirs(surface, other.hit.facet, position);
      if (mine.gap(theirs.middle() + shift) >= -rounding * mine.size) return false; // flat or hollow
      return other.when > c.when || (other.when == c.when && other.hit.facet < c.hit.facet);
    });
  };
  std::vector<Candidate> kept;
  for (const Candidate& c : of_node)
    if (!beaten(c)) kept.push_back(c);
  of_node = std::move(kept);
}

/// Two edges at one time: the gap along the normal common to both, out of the body of the second.
struct Crossing {
  Vec3 normal{0, 0, 0};
  double s = 0.0, t = 0.0; ///< on the first and on the second
  double gap = 0.0, length = 0.0;

  bool between(double over) const { return s >= -over && s <= 1.0 + over && t >= -over && t <= 1.0 + over; }
};

Vec3 outwards(const Surface<3>& surface, const Sides& sides, const SurfaceEdge& edge,
              PlacesOnBoundary<3> position) {
  Vec3 sum = Vec3::Zero();
  for (const FacetIndex f : edge.facet)
    if (exists(f) && !is_side(sides, f)) sum += FacetView(surface, f, position).normal;
  return sum;
}

/// m, of the nearest points of two edges, the other shifted (Ericson 2005, 5.1.9).
double distance_of_edges(const SurfaceEdge& one, const SurfaceEdge& other, const Vec3& shift,
                         PlacesOnBoundary<3> position) {
  const Vec3 x = position[one.node[0]], e = position[one.node[1]] - x;
  const Vec3 y = position[other.node[0]], f = position[other.node[1]] - y, r = x - y - shift;
  const double ee = e.squaredNorm(), ff = f.squaredNorm(), ef = e.dot(f), er = e.dot(r), fr = f.dot(r);
  const double det = ee * ff - ef * ef;
  double s = det > 0.0 ? std::clamp((ef * fr - er * ff) / det, 0.0, 1.0) : 0.0, t = (ef * s + fr) / ff;
  if (t < 0.0 || t > 1.0) {
    t = std::clamp(t, 0.0, 1.0);
    s = std::clamp((ef * t - er) / ee, 0.0, 1.0);
  }
  return (r + s * e - t * f).norm();
}

std::optional<Crossing> crossing(const Surface<3>& surface, const Sides& sides, const EdgePair& pair,
                                 PlacesOnBoundary<3> position) {
  const SurfaceEdge &one = surface.edges[pair.one], &other = surface.edges[pair.other];
  const Vec3 x = position[one.node[0]], e = position[one.node[1]] - x;
  const Vec3 y = position[other.node[0]], f = position[other.node[1]] - y;
  const double ee = e.squaredNorm(), ff = f.squaredNorm(), ef = e.dot(f), det = ee * ff - ef * ef;
  if (det < least_crossing * least_crossing * ee * ff) return {};
  const Vec3 r = y + pair.shift - x;
  Crossing at;
  at.s = (e.dot(r) * ff - f.dot(r) * ef) / det;
  at.t = (e.dot(r) * ef - f.dot(r) * ee) / det;
  if (!at.between(0.1)) return {};
  at.length = std::sqrt(std::min(ee, ff));
  at.normal = e.cross(f).normalized();
  const Vec3 out_one = outwards(surface, sides, one, position),
             out_other = outwards(surface, sides, other, position);
  if (at.normal.dot(out_other - out_one) < 0.0) at.normal = -at.normal;
  if (at.normal.dot(out_other) < 0.25 * out_other.norm() || at.normal.dot(out_one) > -0.25 * out_one.norm())
    return {}; // they do not face each other
  at.gap = at.normal.dot(x + at.s * e - y - pair.shift - at.t * f);
  return at;
}

} // namespace

template<> void BodyContact<3>::list(const Surface<3>& surface) {
  pairs_.clear();
  edge_pairs_.clear();
  ++listings_;
  Vec3 low = listed_.front(), high = low;
  for (const Vec3& x : listed_) low = low.cwiseMin(x), high = high.cwiseMax(x);
  size_ = (high - low).norm();
  double total = 0.0;
  for (const auto& nodes : surface.facets) total += (listed_[nodes[1]] - listed_[nodes[0]]).norm();
  skin_ = skin_of_facets * total / static_cast<double>(std::max<std::size_t>(surface.facets.size(), 1));
  std::vector<Box<3>> boxes;
  for (const auto& nodes : surface.facets) boxes.push_back(box_of(listed_, nodes, 0.0));
  const BoxTree facets(std::move(boxes));
  const std::vector<Vec3> shifts = images(repetition_.period, high - low, 2.0 * skin_);
  std::vector<std::int32_t> near;
  // what lies behind a facet does so in another body, or may come round a corner
  const auto may_meet = [&](double gap, double size, const Vec3& middle, bool beside) {
    if (gap >= -rounding * size) return true;
    const int bodies = bodies_at(surface, listed_, facets, shifts, middle);
    return bodies > 1 || (bodies < 1 && beside);
  };
  for (const BoundaryNodeIndex b : listed_.indices()) {
    const auto& around = surface.around[b];
    if (std::all_of(around.begin(), around.end(), [&](FacetIndex f) { return tied(surface, f); })) continue;
    const Box<3> box = box_of(listed_, std::array{b}, skin_);
    for (const Vec3& shift : shifts) {
      find_near(facets, box, shift, near);
      const Vec3 x = listed_[b] - shift;
      for (const std::int32_t i : near) {
        const auto f = as<FacetIndex>(i);
        if (tied(surface, f) || related(surface, b, f, shift)) continue;
        const FacetView facet(surface, f, listed_);
        const Vec3 foot = facet.nearest(x);
        if ((foot - x).norm() > skin_) continue;
        constexpr double inwards = 1e-6; // off planes of symmetry, which bound the bodies
        const Vec3 middle = 0.5 * (foot + x) + inwards * (facet.middle() - foot);
        if (may_meet(facet.gap(x), facet.size, middle, !inside(facet.weights(x), 0.0)))
          pairs_.push_back({b, f, shift});
      }
    }
  }
  list_edges(surface, facets, shifts);
}

template<>
void BodyContact<3>::list_edges(const Surface<3>& surface, const BoxTree& facets,
                                std::span<const Vec3> shifts) {
  std::vector<Box<3>> boxes;
  for (const SurfaceEdge& edge : surface.edges)
    boxes.push_back(box_of(listed_, std::span(edge.node).first(2), 0.0));
  const BoxTree edges(std::move(boxes));
  const auto edge_tied = [&](const SurfaceEdge& edge) {
    return tied(surface, edge.facet[0]) && tied(surface, edge.facet[1]);
  };
  std::vector<std::int32_t> near;
  for (const SurfaceEdgeIndex e : surface.edges.indices()) {
    const SurfaceEdge& one = surface.edges[e];
    if (edge_tied(one)) continue;
    const Box<3> box = box_of(listed_, std::span(one.node).first(2), skin_);
    // by the first shift, none, each pair is met twice; of the others the second of two opposite ones is
    for (std::size_t image = 0; image < shifts.size(); image += image == 0 ? 1 : 2) {
      const Vec3& shift = shifts[image];
      find_near(edges, box, shift, near);
      for (const std::int32_t i : near) {
        const auto o = as<SurfaceEdgeIndex>(i);
        if ((image == 0 && o <= e) || edge_tied(surface.edges[o])) continue;
        const SurfaceEdge& other = surface.edges[o];
        const auto meet = [&](std::size_t p, std::size_t q) {
          return same(one.node[p], other.node[q], shift);
        };
        if (meet(0, 0) || meet(0, 1) || meet(1, 0) || meet(1, 1)) continue;
        if (distance_of_edges(one, other, shift, listed_) > skin_) continue;
        EdgePair pair{e, o, shift};
        const auto at = crossing(surface, side_, pair, listed_);
        pair.overlaps = at && at->gap < -rounding * at->length;
        if (pair.overlaps) { // or edges of two facets that see each other from behind
          const Vec3 x = (1.0 - at->s) * listed_[one.node[0]] + at->s * listed_[one.node[1]];
          if (bodies_at(surface, listed_, facets, shifts, x - 0.5 * at->gap * at->normal) < 2) continue;
        }
        edge_pairs_.push_back(pair);
      }
    }
  }
}

template<> void BodyContact<3>::narrow(const Surface<3>& surface) {
  narrow_ = narrow_skin * skin_;
  near_edges_.clear();
  for (const EdgePair& pair : edge_pairs_) {
    const SurfaceEdge &one = surface.edges[pair.one], &other = surface.edges[pair.other];
    if (pair.overlaps || distance_of_edges(one, other, pair.shift, narrowed_) <= narrow_)
      near_edges_.push_back(pair);
  }
}

template<>
void BodyContact<3>::find(const Surface<3>& surface, PlacesOnBoundary<3> start, PlacesOnBoundary<3> end,
                          std::vector<FacetHit<3>>& hits) const {
  std::vector<Candidate> crossed;
  for (std::size_t first = 0; first < pairs_.size();) {
    const BoundaryNodeIndex b = pairs_[first].node;
    crossed.clear();
    FacetHit<3> within;
    double depth = std::numeric_limits<double>::infinity();
    for (; first < pairs_.size() && pairs_[first].node == b; ++first) {
      const auto& [node, f, shift] = pairs_[first];
      const Vec3 from = start[b] - shift, to = end[b] - shift;
      const FacetView now(surface, f, end);
      const double kept = clearance * now.size, gap = now.gap(to) - kept;
      if (gap >= 0.0 || gap < -2.0 * skin_) continue;
      const FacetView before(surface, f, start);
      const double gap_before = before.gap(from) - kept;
      const auto place = now.weights(to);
      FacetHit<3> hit{b, f, clamped(place), now.normal, std::min(gap_before, 0.0), kept, shift};
      if (gap_before >= -kept - rounding * before.size) {
        const double when = gap_before > 0.0 ? gap_before / (gap_before - gap) : 0.0;
        std::array<double, 3> there = before.weights(from);
        for (std::size_t k = 0; k < 3; ++k) there[k] = (1.0 - when) * there[k] + when * place[k];
        if (inside(there, overhang) && faces(surface, side_, b, before.normal, start))
          crossed.push_back({hit, when});
      } else if (inside(place, 0.0) && -gap < std::min(depth, skin_) &&
                 faces(surface, side_, b, before.normal, start)) {
        depth = -gap;
        within = hit;
      }
    }
    keep_last_passed(
        surface, end,
        [&](BoundaryNodeIndex p, BoundaryNodeIndex q, const Vec3& shift) { return same(p, q, shift); },
        crossed);
    for (const Candidate& c : crossed) hits.push_back(c.hit);
    if (crossed.empty() && depth < std::numeric_limits<double>::infinity()) hits.push_back(within);
  }
}

template<>
void BodyContact<3>::find_closed(const Surface<3>& surface, PlacesOnBoundary<3> position, double closed,
                                 std::vector<FacetHit<3>>& hits) const {
  append_nearest(
      [&](const Pair& pair, FacetHit<3>& hit) {
        const FacetView facet(surface, pair.facet, position);
        const Vec3 x = position[pair.node] - pair.shift;
        const double gap = facet.gap(x);
        if (gap > closed * facet.size) return none;
        const auto place = facet.weights(x);
        if (!inside(place, overhang) || !faces(surface, side_, pair.node, facet.normal, position))
          return none;
        hit = {pair.node, pair.facet, clamped(place), facet.normal};
        return gap;
      },
      hits);
}

template<>
void BodyContact<3>::find_edges(const Surface<3>& surface, PlacesOnBoundary<3> start, PlacesOnBoundary<3> end,
                                std::vector<EdgeHit>& hits) const {
  for (const EdgePair& pair : wide_ ? edge_pairs_ : near_edges_) {
    const auto now = crossing(surface, side_, pair, end);
    if (!now) continue;
    const double kept = clearance * now->length, gap = now->gap - kept;
    if (gap >= 0.0 || gap < -skin_ || !now->between(overhang)) continue;
    const auto before = crossing(surface, side_, pair, start);
    if (!before || before->normal.dot(now->normal) < 0.0) continue;
    if (!pair.overlaps && before->gap < -rounding * before->length) continue; // through a wall, from behind
    const double gap_before = before->gap - kept, s = std::clamp(now->s, 0.0, 1.0),
                 t = std::clamp(now->t, 0.0, 1.0);
    hits.push_back({pair, {1.0 - s, s}, {1.0 - t, t}, now->normal, std::min(gap_before, 0.0), kept});
  }
}

} // namespace cnem::contact
