#include "contact/body_contact.hpp"

#include "core/geometry/winding_number.hpp"
#include "core/index.hpp"

#include <algorithm>
#include <boost/geometry/geometries/box.hpp>
#include <boost/geometry/geometries/point.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <cmath>
#include <limits>
#include <utility>

namespace cnem::contact {
namespace {

namespace bg = boost::geometry;
using TreePoint = bg::model::point<double, 2, bg::cs::cartesian>;
using TreeBox = bg::model::box<TreePoint>;
using Tree = bg::index::rtree<std::pair<TreeBox, FacetIndex>, bg::index::quadratic<16>>;

constexpr double skin_of_facets = 0.5; ///< skin over the mean length of facets
constexpr double clearance = 1e-6;     ///< of a facet's length: what stays between bodies that touch
constexpr double rounding = 1e-9;      ///< of a facet's length: a gap of nothing
constexpr double overhang = 1e-6;      ///< of a facet's length, by which crossings beside its ends count

TreeBox box_around(const Vec2& low, const Vec2& high, double margin) {
  return {TreePoint(low.x() - margin, low.y() - margin), TreePoint(high.x() + margin, high.y() + margin)};
}

/// A facet at one time.
struct FacetView {
  Vec2 a, edge, normal;
  double length;

  FacetView(const Surface<2>& surface, FacetIndex facet, PlacesOnBoundary<2> position)
      : a(position[surface.facets[facet][0]]), edge(position[surface.facets[facet][1]] - a),
        length(edge.norm()) {
    normal = right_normal(edge) / length;
  }
  double gap(const Vec2& x) const { return normal.dot(x - a); }
  double place(const Vec2& x) const { return edge.dot(x - a) / (length * length); }
  Vec2 nearest(const Vec2& x) const { return a + std::clamp(place(x), 0.0, 1.0) * edge; }
};

/// Cosine between normals below which two facets face each other. A node counts where one of its facets does,
/// or at a tip a direction between both: else a body that slides on another would be stopped by the nodes
/// ahead of the dent it makes.
constexpr double facing = -0.25;

bool faces(const Surface<2>& surface, BoundaryNodeIndex node, const Vec2& normal,
           PlacesOnBoundary<2> position) {
  const auto against = [&](FacetIndex facet) {
    return exists(facet) && FacetView(surface, facet, position).normal.dot(normal) < facing;
  };
  const FacetIndex in = surface.entering[node], out = surface.leaving[node];
  if (against(in) || against(out)) return true;
  if (!exists(in) || !exists(out)) return false;
  // a tip may face what neither of its facets faces
  const Vec2 from = FacetView(surface, in, position).normal, to = FacetView(surface, out, position).normal;
  return cross(from, to) > 0.0 && cross(normal, from) > 0.0 && cross(to, normal) > 0.0;
}

/// How often the boundary runs round x: the number of bodies there.
int winding_number(const Surface<2>& surface, PlacesOnBoundary<2> position, const Vec2& x) {
  int turns = 0;
  for (const auto& facet : surface.facets)
    turns += winding_of_edge(position[facet[0]], position[facet[1]], x);
  return turns;
}

/// Whether a node and a facet are on the two faces of a cohesive interface.
bool were_bonded(const Bonds& bonds, const Surface<2>& surface, BoundaryNodeIndex node, FacetIndex facet) {
  if (bonds.empty()) return false;
  const auto face = [&](FacetIndex f) {
    return exists(f) ? bonds.face[as<CloudFacetIndex>(index_of(f))] : -1;
  };
  const std::int32_t other = face(facet) < 0 ? -2 : face(facet) ^ 1;
  return face(surface.entering[node]) == other || face(surface.leaving[node]) == other;
}

/// A hit with when it happened, to choose between facets that meet.
struct Candidate {
  FacetHit<2> hit;
  double when; ///< share of the step at which the node crossed
};

/// Of two facets that meet at a convex corner of their body, a node came in through the one it passed last.
void keep_last_passed(const Surface<2>& surface, PlacesOnBoundary<2> position,
                      std::vector<Candidate>& of_node) {
  const auto beaten = [&](const Candidate& c) {
    return std::any_of(of_node.begin(), of_node.end(), [&](const Candidate& other) {
      const auto &f = surface.facets[c.hit.facet], &g = surface.facets[other.hit.facet];
      const bool before = f[1] == g[0], after = f[0] == g[1];
      if (c.hit.facet == other.hit.facet || (!before && !after)) return false;
      const Vec2 e = FacetView(surface, c.hit.facet, position).edge,
                 n = FacetView(surface, other.hit.facet, position).edge;
      if ((before ? cross(e, n) : cross(n, e)) <= 0.0) return false;
      return other.when > c.when || (other.when == c.when && other.hit.facet < c.hit.facet);
    });
  };
  std::vector<Candidate> kept;
  for (const Candidate& c : of_node)
    if (!beaten(c)) kept.push_back(c);
  of_node = std::move(kept);
}

} // namespace

template<int dim>
void BodyContact<dim>::set_boundary(const Surface<dim>& surface,
                                    IndexedSpan<NodeIndex, const std::int32_t> group) {
  group_.assign(surface.node.size(), -1);
  if (!group.empty())
    for (const BoundaryNodeIndex b : group_.indices()) group_[b] = group[surface.node[b]];
  side_.clear();
  if (!repetition_.empty())
    for (const PieceIndex piece : surface.piece)
      side_.push_back(std::ranges::find(repetition_.sides, piece) != repetition_.sides.end());
  bonds_ = {};
  listed_.clear();
}

template<int dim> bool BodyContact<dim>::tied(const Surface<dim>& surface, FacetIndex facet) const {
  if (!exists(facet)) return true;
  if (!side_.empty()) return side_[facet] != 0;
  const auto& ends = surface.facets[facet];
  return std::all_of(ends.begin(), ends.end(), [&](BoundaryNodeIndex b) { return group_[b] >= 0; });
}

/// Whether two nodes, the other shifted, are one point of the body.
template<int dim>
bool BodyContact<dim>::same(BoundaryNodeIndex one, BoundaryNodeIndex other, const Vec<dim>& shift) const {
  if (repetition_.empty()) return other == one || (group_[one] >= 0 && group_[other] == group_[one]);
  if (other == one) return shift.isZero(0.0);
  if (group_[one] < 0 || group_[other] != group_[one]) return false;
  return (listed_[other] + shift - listed_[one]).norm() < 0.5 * skin_; // periods are longer
}

template<int dim>
bool BodyContact<dim>::related(const Surface<dim>& surface, BoundaryNodeIndex node, FacetIndex facet,
                               const Vec<dim>& shift) const {
  if (bonds_.joins(surface.node[node], as<CloudFacetIndex>(index_of(facet)))) return true;
  return std::any_of(surface.facets[facet].begin(), surface.facets[facet].end(),
                     [&](BoundaryNodeIndex end) { return same(node, end, shift); });
}

template<> void BodyContact<2>::list(const Surface<2>& surface) {
  pairs_.clear();
  ++listings_;
  Vec2 low = listed_.front(), high = low;
  for (const Vec2& x : listed_) low = low.cwiseMin(x), high = high.cwiseMax(x);
  size_ = (high - low).norm();
  std::vector<std::pair<TreeBox, FacetIndex>> boxes;
  double total = 0.0;
  for (const FacetIndex f : surface.facets.indices()) {
    const auto& ends = surface.facets[f];
    const Vec2 &a = listed_[ends[0]], &b = listed_[ends[1]];
    total += (b - a).norm();
    if (!tied(surface, f)) boxes.emplace_back(box_around(a.cwiseMin(b), a.cwiseMax(b), 0.0), f);
  }
  skin_ = skin_of_facets * total / static_cast<double>(std::max<std::size_t>(surface.facets.size(), 1));
  const Tree tree(boxes);
  std::vector<std::pair<TreeBox, FacetIndex>> near;
  for (const BoundaryNodeIndex b : listed_.indices()) {
    if (tied(surface, surface.entering[b]) && tied(surface, surface.leaving[b])) continue;
    near.clear();
    const double pressed = bonds_.empty() ? 0.0 : bonds_.pressed[surface.node[b]];
    tree.query(bg::index::intersects(box_around(listed_[b], listed_[b], skin_ + pressed)),
               std::back_inserter(near));
    std::sort(near.begin(), near.end(), [](const auto& p, const auto& q) { return p.second < q.second; });
    for (const auto& [box, f] : near) {
      if (related(surface, b, f, Vec2::Zero())) continue;
      const FacetView facet(surface, f, listed_);
      const Vec2 foot = facet.nearest(listed_[b]);
      const double reach = skin_ + (were_bonded(bonds_, surface, b, f) ? pressed : 0.0);
      if ((foot - listed_[b]).norm() > reach) continue;
      if (facet.gap(listed_[b]) < -rounding * facet.length) {
        constexpr double inwards = 1e-6; // off the side that the node may share with the facet
        const Vec2 between = 0.5 * (foot + listed_[b]) + inwards * (facet.a + 0.5 * facet.edge - foot);
        const int bodies = winding_number(surface, listed_, between);
        const double place = facet.place(listed_[b]);
        const bool round_a_corner = bodies == 0 && (place < 0.0 || place > 1.0);
        if (bodies < 2 && !round_a_corner) continue;
      }
      pairs_.push_back({b, f, Vec2::Zero()});
    }
  }
}

template<int dim>
void BodyContact<dim>::look(const Surface<dim>& surface, PlacesOnBoundary<dim> start,
                            PlacesOnBoundary<dim> end) {
  if (start.empty()) return;
  const auto farthest = [&](PlacesOnBoundary<dim> from) { // m, from where nodes were to where they go
    double moved = 0.0;
    for (const BoundaryNodeIndex b : end.indices()) moved = std::max(moved, (end[b] - from[b]).squaredNorm());
    return std::sqrt(moved);
  };
  const bool listed = !listed_.empty() && 2.0 * farthest(listed_) <= skin_;
  if (!listed) {
    listed_.assign(start.begin(), start.end());
    list(surface);
  }
  if constexpr (dim == 3) {
    // contacts move nodes no farther than the step has
    const double way = farthest(start);
    if (!listed || 2.0 * (farthest(narrowed_) + way) > narrow_) {
      narrowed_.assign(start.begin(), start.end());
      narrow(surface);
    }
    wide_ = 4.0 * way > narrow_;
  }
}

template<>
void BodyContact<2>::find(const Surface<2>& surface, PlacesOnBoundary<2> start, PlacesOnBoundary<2> end,
                          std::vector<FacetHit<2>>& hits) const {
  std::vector<Candidate> crossed;
  for (std::size_t first = 0; first < pairs_.size();) {
    const BoundaryNodeIndex b = pairs_[first].node;
    crossed.clear();
    FacetHit<2> inside;
    double depth = std::numeric_limits<double>::infinity();
    for (; first < pairs_.size() && pairs_[first].node == b; ++first) {
      const FacetIndex f = pairs_[first].facet;
      const FacetView now(surface, f, end);
      const double kept = clearance * now.length, gap = now.gap(end[b]) - kept;
      if (gap >= 0.0) continue;
      const FacetView before(surface, f, start);
      if (!faces(surface, b, before.normal, start)) continue;
      const double gap_before = before.gap(start[b]) - kept, place = now.place(end[b]);
      const double s = std::clamp(place, 0.0, 1.0);
      FacetHit<2> hit{b, f, {1.0 - s, s}, now.normal, std::min(gap_before, 0.0), kept};
      if (were_bonded(bonds_, surface, b, f)) { // what compressed the bond stays: to push it out takes work
        const double stays = std::min(-hit.start, bonds_.pressed[surface.node[b]]);
        hit.clearance -= stays;
        hit.start += stays;
      }
      if (gap_before >= -kept - rounding * before.length) {
        const double when = gap_before > 0.0 ? gap_before / (gap_before - gap) : 0.0;
        const double there = (1.0 - when) * before.place(start[b]) + when * place;
        if (there >= -overhang && there <= 1.0 + overhang) crossed.push_back({hit, when});
      } else if (const double deep = hit.clearance - now.gap(end[b]); // besides what stays
                 place >= 0.0 && place <= 1.0 && deep < std::min(depth, skin_)) {
        depth = deep;
        inside = hit;
      }
    }
    keep_last_passed(surface, end, crossed);
    for (const Candidate& c : crossed) hits.push_back(c.hit);
    if (crossed.empty() && depth < std::numeric_limits<double>::infinity()) hits.push_back(inside);
  }
}

template<>
void BodyContact<2>::find_closed(const Surface<2>& surface, PlacesOnBoundary<2> position, double closed,
                                 std::vector<FacetHit<2>>& hits) const {
  append_nearest(
      [&](const Pair& pair, FacetHit<2>& hit) {
        const FacetView facet(surface, pair.facet, position);
        const double gap = facet.gap(position[pair.node]), place = facet.place(position[pair.node]);
        if (gap > closed * facet.length || place < -overhang || place > 1.0 + overhang) return none;
        if (!faces(surface, pair.node, facet.normal, position)) return none;
        const double s = std::clamp(place, 0.0, 1.0);
        hit = {pair.node, pair.facet, {1.0 - s, s}, facet.normal};
        return gap;
      },
      hits);
}

template<int dim> void BodyContact<dim>::archive(Archive& archive, const Surface<dim>& surface) {
  const auto carry = [&](const char* name, IndexedVector<BoundaryNodeIndex, Vec<dim>>& places) {
    std::vector<double> flat;
    for (const Vec<dim>& x : places) flat.insert(flat.end(), x.data(), x.data() + dim);
    archive.list(name, "m", flat);
    if (!archive.loading()) return;
    places.clear();
    for (std::size_t i = 0; i + dim <= flat.size(); i += dim)
      places.push_back(Eigen::Map<const Vec<dim>>(flat.data() + i));
    if (places.size() != surface.node.size()) places.clear();
  };
  carry("solver/body_contact/listed", listed_);
  if constexpr (dim == 3) carry("solver/body_contact/narrowed", narrowed_);
  if (!archive.loading()) return;
  if (dim == 3 && narrowed_.empty()) listed_.clear();
  if (listed_.empty()) return;
  list(surface);
  if constexpr (dim == 3) narrow(surface);
}

template class BodyContact<2>;
template class BodyContact<3>;

} // namespace cnem::contact
