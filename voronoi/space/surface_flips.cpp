#include "voronoi/space/surface_flips.hpp"

#include "core/index.hpp"
#include "voronoi/space/exact.hpp"
#include "voronoi/space/surface.hpp"

#include <Eigen/Geometry>
#include <cassert>
#include <cmath>

namespace cnem::voronoi {

namespace {

class Flips {
public:
  Flips(Cloud<3>& cloud, double flat_angle)
      : cloud_(cloud), across_(surface_edges(cloud)), behind_(facets_behind(cloud)),
        flat_cosine_(std::cos(flat_angle)) {}

  int run() {
    std::vector<SurfaceEdge> stack;
    for (const CloudFacetIndex f : cloud_.facets.indices())
      for (std::size_t k = 0; k < 3; ++k)
        if (edge_at(f, k) < across_[f][k]) stack.push_back(edge_at(f, k));
    std::size_t left = 50 * cloud_.facets.size();
    int flips = 0;
    for (; !stack.empty() && left > 0; --left) {
      const SurfaceEdge e = stack.back();
      stack.pop_back();
      if (!wants_flip(e)) continue;
      const CloudFacetIndex f = facet_of(e), g = facet_of(across(e));
      const CloudFacetIndex other_f = behind_[f], other_g = behind_[g];
      if (exists(other_f) != exists(other_g)) continue;
      if (exists(other_f)) {
        const SurfaceEdge other = edge_between(other_f, other_g);
        if (other < 0 || !may_flip(other)) continue;
        flip(other);
        behind_[other_f] = g, behind_[other_g] = f;
        behind_[f] = other_g, behind_[g] = other_f;
      }
      flip(e);
      ++flips;
      for (const CloudFacetIndex h : {f, g})
        for (std::size_t k = 0; k < 3; ++k) stack.push_back(edge_at(h, k));
    }
    return flips;
  }

private:
  SurfaceEdge across(SurfaceEdge e) const { return across_[facet_of(e)][place_of(e)]; }
  NodeIndex start(SurfaceEdge e) const { return cloud_.facets[facet_of(e)].node[place_of(e)]; }
  NodeIndex apex(SurfaceEdge e) const { return cloud_.facets[facet_of(e)].node[(place_of(e) + 2) % 3]; }
  const Vec3& at(NodeIndex i) const { return cloud_.position[i]; }

  /// The edge of f at which g is across; −1: there is none.
  SurfaceEdge edge_between(CloudFacetIndex f, CloudFacetIndex g) const {
    for (std::size_t k = 0; k < 3; ++k)
      if (facet_of(across_[f][k]) == g) return edge_at(f, k);
    return -1;
  }

  bool joined(NodeIndex node, SurfaceEdge leaving, NodeIndex other) const {
    SurfaceEdge e = leaving;
    do {
      if (start(next_edge(e)) == other) return true;
      e = next_edge(across(e));
    } while (e != leaving);
    assert(start(leaving) == node);
    return false;
  }

  /// Whether the facets are of one piece, nearly on one plane, stay unfolded and the other diagonal is free.
  bool may_flip(SurfaceEdge e) const {
    const SurfaceEdge back = across(e);
    if (cloud_.facets[facet_of(e)].piece != cloud_.facets[facet_of(back)].piece) return false;
    const NodeIndex c = apex(e), d = apex(back);
    const Vec3 &xa = at(start(e)), &xb = at(start(back)), &xc = at(c), &xd = at(d);
    const Vec3 one = (xb - xa).cross(xc - xa), other = (xd - xa).cross(xb - xa);
    if (one.dot(other) < flat_cosine_ * one.norm() * other.norm()) return false;
    const Vec3 normal = one + other;
    const Vec3 left = (xa - xc).cross(xd - xc), right = (xd - xc).cross(xb - xc);
    const double least = 1e-10 * normal.squaredNorm();
    if (left.dot(normal) <= least || right.dot(normal) <= least) return false;
    if (left.dot(right) < flat_cosine_ * left.norm() * right.norm()) return false;
    return !joined(c, next_edge(next_edge(e)), d);
  }

  bool wants_flip(SurfaceEdge e) const {
    const Vec3 &a = at(start(e)), &b = at(start(across(e))), &c = at(apex(e)), &d = at(apex(across(e)));
    if (orientation(a, b, c, d) == 0) return in_coplanar_circle(a, b, c, d) && may_flip(e);
    const double dot_c = (a - c).dot(b - c), dot_d = (a - d).dot(b - d);
    const double sine_c = (a - c).cross(b - c).norm(), sine_d = (a - d).cross(b - d).norm();
    return dot_c * sine_d + sine_c * dot_d < -1e-12 * (sine_c * sine_d) && may_flip(e);
  }

  void flip(SurfaceEdge e) {
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

  void join(SurfaceEdge one, SurfaceEdge other) {
    across_[facet_of(one)][place_of(one)] = other;
    across_[facet_of(other)][place_of(other)] = one;
  }

private:
  Cloud<3>& cloud_;
  SurfaceEdges across_;
  IndexedVector<CloudFacetIndex, CloudFacetIndex> behind_; ///< the facet of the other face of a slit
  double flat_cosine_;
};

} // namespace

int flip_surface(Cloud<3>& cloud, double flat_angle) { return Flips(cloud, flat_angle).run(); }

} // namespace cnem::voronoi
