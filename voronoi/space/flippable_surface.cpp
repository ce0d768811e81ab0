#include "voronoi/space/flippable_surface.hpp"

#include "voronoi/space/exact.hpp"

#include <Eigen/Geometry>

namespace cnem::voronoi {

FlippableSurface::FlippableSurface(Cloud<3>& cloud, const FixedNodes& fixed)
    : cloud_(cloud), fixed_(fixed), across_(surface_edges(cloud)), behind_(facets_behind(cloud)) {}

/// The edge of f at which g is across; −1: there is none.
SurfaceEdge FlippableSurface::edge_between(CloudFacetIndex f, CloudFacetIndex g) const {
  for (std::size_t k = 0; k < 3; ++k)
    if (facet_of(across_[f][k]) == g) return edge_at(f, k);
  return -1;
}

/// Whether an edge joins the node that an edge leaves with another.
bool FlippableSurface::joined(SurfaceEdge leaving, NodeIndex other) const {
  SurfaceEdge e = leaving;
  do {
    if (start(next_edge(e)) == other) return true;
    e = next_edge(across(e));
  } while (e != leaving);
  return false;
}

bool FlippableSurface::may_flip(SurfaceEdge e, double least_cosine) const {
  const SurfaceEdge back = across(e);
  if (cloud_.facets[facet_of(e)].piece != cloud_.facets[facet_of(back)].piece) return false;
  const auto at = [&](NodeIndex i) -> const Vec3& { return cloud_.position[i]; };
  const NodeIndex c = apex(e), d = apex(back);
  const Vec3 &xa = at(start(e)), &xb = at(start(back)), &xc = at(c), &xd = at(d);
  const auto fixed = [&](NodeIndex i) { return !fixed_.empty() && fixed_[i]; };
  if ((fixed(start(e)) || fixed(start(back)) || fixed(c) || fixed(d)) && orientation(xa, xb, xc, xd) != 0)
    return false;
  const Vec3 one = (xb - xa).cross(xc - xa), other = (xd - xa).cross(xb - xa);
  if (one.dot(other) < least_cosine * one.norm() * other.norm()) return false;
  const Vec3 normal = one + other, left = (xa - xc).cross(xd - xc), right = (xd - xc).cross(xb - xc);
  const double least = 1e-10 * normal.squaredNorm();
  if (left.dot(normal) <= least || right.dot(normal) <= least) return false;
  if (left.dot(right) < least_cosine * left.norm() * right.norm()) return false;
  return !joined(next_edge(next_edge(e)), d);
}

bool FlippableSurface::flip(SurfaceEdge e, double least_cosine) {
  if (!may_flip(e, least_cosine)) return false;
  const CloudFacetIndex f = facet_of(e), g = facet_of(across(e));
  const CloudFacetIndex other_f = behind_[f], other_g = behind_[g];
  if (exists(other_f) != exists(other_g)) return false;
  if (exists(other_f)) {
    const SurfaceEdge other = edge_between(other_f, other_g);
    if (other < 0 || !may_flip(other, least_cosine)) return false;
    if (apex(e) == apex(other) && apex(across(e)) == apex(across(other)))
      return false; // one edge of four facets
    turn(other);
    behind_[other_f] = g, behind_[other_g] = f;
    behind_[f] = other_g, behind_[g] = other_f;
  }
  turn(e);
  return true;
}

void FlippableSurface::turn(SurfaceEdge e) {
  const SurfaceEdge back = across(e);
  const CloudFacetIndex f = facet_of(e), g = facet_of(back);
  const NodeIndex a = start(e), b = start(back), c = apex(e), d = apex(back);
  const SurfaceEdge at_ca = across(next_edge(next_edge(e))), at_ad = across(next_edge(back));
  const SurfaceEdge at_db = across(next_edge(next_edge(back))), at_bc = across(next_edge(e));
  cloud_.facets[f].node = {c, a, d};
  cloud_.facets[g].node = {d, b, c};
  join(edge_at(f, 0), at_ca), join(edge_at(f, 1), at_ad), join(edge_at(f, 2), edge_at(g, 2));
  join(edge_at(g, 0), at_db), join(edge_at(g, 1), at_bc);
}

void FlippableSurface::join(SurfaceEdge one, SurfaceEdge other) {
  across_[facet_of(one)][place_of(one)] = other;
  across_[facet_of(other)][place_of(other)] = one;
}

} // namespace cnem::voronoi
