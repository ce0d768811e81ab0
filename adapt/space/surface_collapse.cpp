// Edges of a surface in space that are collapsed.
#include "adapt/space/working_surface.hpp"
#include "core/geometry/facets.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace cnem::adapt {

using voronoi::next_edge;

/// What does not depend on where the nodes are, but for creases.
Refusal WorkingSurface::may_collapse(Edge e, double spacing, Collapse kind) const {
  if (!alive(e)) return Refusal::absent;
  const NodeIndex gone = start(e), stays = end(e);
  if (held(gone)) return Refusal::held;
  constexpr double one = 0.1; // h: folds so near to each other are one
  const bool folds_meet = length(e) < one * spacing && of_folds(gone);
  if (kind != Collapse::in_shape) {
    if (!holds_less(gone, spacing, kind)) return Refusal::corner;
    if (!of_folds(gone) && piece(e) == piece(across(e)))
      return Refusal::crease; // images are along the border
  } else if (corner(gone)) {
    if (!folds_meet || !corner(stays)) return Refusal::corner;
  } else if (on_crease(gone) && !crease(e) && !(folds_meet && on_crease(stays))) {
    return Refusal::crease;
  }
  std::vector<NodeIndex> near;
  around(gone, [&](Edge k) { near.push_back(end(k)); });
  int common = 0;
  around(stays, [&](Edge k) { common += std::find(near.begin(), near.end(), end(k)) != near.end() ? 1 : 0; });
  if (common != 2 || valence(apex(e)) < 4 || valence(apex(across(e))) < 4) return Refusal::link;
  return Refusal::none;
}

/// Volume (m³) that a body loses as a node goes into one beside it.
double WorkingSurface::volume_towards(NodeIndex gone, NodeIndex stays) const {
  double volume = 0.0;
  const Vec3& base = at(stays);
  around(gone,
         [&](Edge k) { volume += (at(end(k)) - base).cross(at(apex(k)) - base).dot(at(gone) - base) / 6.0; });
  return volume;
}

bool WorkingSurface::is_tip(NodeIndex i, double spacing) const {
  return on_surface(i) && corner(i) && holds_less(i, spacing, Collapse::of_tip);
}

bool WorkingSurface::holds_less(NodeIndex i, double spacing, Collapse kind) const {
  if (!on_surface(i) || held(i)) return false;
  const bool at_border = kind == Collapse::of_light && still(i) && pieces_meet(i) == 2;
  if (!at_border && (still(i) || !of_folds(i))) return false;
  const double most = kind == Collapse::of_tip ? rules_.tip : rules_.volume;
  bool less = true;
  around(i, [&](Edge e) {
    if (at_border && piece(e) == piece(across(e))) return; // no way that it may go
    less = less && std::abs(volume_towards(i, end(e))) < most * spacing * spacing * spacing;
  });
  return less;
}

/// Whether what is left where a tip goes looks the way the tip did as a whole.
bool WorkingSurface::may_cap(Edge e) const {
  const NodeIndex gone = start(e), stays = end(e);
  Vec3 sum = Vec3::Zero();
  around(gone, [&](Edge k) { sum += normal(k); });
  bool all = true;
  around(gone, [&](Edge k) {
    if (k / 3 == e / 3 || k / 3 == across(e) / 3) return;
    Corners after = corners(index_of(k / 3));
    after[index_of(k % 3)] = at(stays);
    all = all && area_normal<3>(after).dot(sum) > 0.0;
  });
  return all;
}

SurfaceChange WorkingSurface::try_collapse(Edge e, double spacing, Vec3& to, Collapse kind) const {
  if (const Refusal refusal = may_collapse(e, spacing, kind); refusal != Refusal::none) return {refusal};
  const Edge back = across(e);
  const NodeIndex gone = start(e), stays = end(e);
  const std::size_t f = index_of(e / 3), g = index_of(back / 3);
  const Vec3 from = at(stays);
  if (kind != Collapse::in_shape) {
    if (!may_cap(e)) return {Refusal::normals};
    to = from;
    return {Refusal::none, -volume_towards(gone, stays)};
  }
  // the volume is linear in the place of the node that stays: V(x) = gradient · (x − from) − lost
  Vec3 gradient = Vec3::Zero();
  double lost = 0.0;
  const auto each_facet = [&](const auto& visit) { // of those that are left
    for (const NodeIndex i : {gone, stays})
      around(i, [&](Edge k) {
        const std::size_t facet = index_of(k / 3);
        if (facet != f && facet != g) visit(i, k, corners(facet));
      });
  };
  each_facet([&](NodeIndex i, Edge k, const Corners&) {
    const Vec3 area = (at(end(k)) - from).cross(at(apex(k)) - from) / 6.0;
    gradient += area;
    if (i == gone) lost += area.dot(at(gone) - from);
  });
  const double limit = rules_.volume * spacing * spacing * spacing;
  const bool repeated = is_still(piece(e)) && !crease(e); // its image takes as much as it adds
  if (!repeated && std::abs(lost) > limit) return {Refusal::volume};
  constexpr double rounding = 1e-9, farthest = 0.1;
  to = from;
  if (std::abs(lost) > rounding * limit) {
    Vec3 way = gradient;
    keep_on_faces(stays, way);
    const double step = lost / way.squaredNorm();
    if (way.norm() > 0.1 * gradient.norm() && std::abs(step) * way.norm() < farthest * spacing)
      to += step * way;
  }
  const auto fits = [&](const Vec3& x) {
    bool all = true;
    each_facet([&](NodeIndex i, Edge k, const Corners& before) {
      if (i == stays && x == from) return;
      Corners after = before;
      after[index_of(k % 3)] = x;
      all = all && may_become(before, after);
    });
    return all;
  };
  if (!fits(to)) {
    if (to == from || !fits(from)) return {Refusal::normals};
    to = from;
  }
  return {Refusal::none, to == from ? -lost : gradient.dot(to - from) - lost};
}

SurfaceChange WorkingSurface::collapse(Edge e, double spacing, Collapse kind) {
  Vec3 to;
  const SurfaceChange change = try_collapse(e, spacing, to, kind);
  if (!change.done()) return change;
  const Edge back = across(e);
  const NodeIndex gone = start(e), stays = end(e);
  const std::size_t f = index_of(e / 3), g = index_of(back / 3);
  std::vector<Edge> fan;
  around(gone, [&](Edge k) { fan.push_back(k); });
  const Edge to_apex = across(last_edge(e)), at_apex = across(next_edge(e));
  const Edge at_other = across(next_edge(back)), from_other = across(last_edge(back));
  const NodeIndex c = apex(e), d = apex(back);
  for (const Edge k : fan) facet_[index_of(k / 3)].node[index_of(k % 3)] = stays;
  join(to_apex, at_apex);
  join(at_other, from_other);
  for (const std::size_t facet : {f, g})
    facet_[facet].node = {NodeIndex::none, NodeIndex::none, NodeIndex::none};
  leaving_[gone] = no_edge;
  leaving_[stays] = to_apex;
  leaving_[c] = at_apex;
  leaving_[d] = at_other;
  position_[stays] = to;
  return change;
}

} // namespace cnem::adapt
