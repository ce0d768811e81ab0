#include "adapt/space/crossing_facets.hpp"

#include "core/geometry/facets.hpp"
#include "core/index.hpp"

#include <Eigen/Geometry>
#include <algorithm>

namespace cnem::adapt {

Vec3 CrossingFacets::normal(CloudFacetIndex f) const {
  return area_normal<3>(corners_of<3>(cloud_.facets[f], cloud_.position));
}

bool CrossingFacets::share_a_node(const Pair& pair) const {
  for (const NodeIndex i : cloud_.facets[pair[0]].node)
    for (const NodeIndex k : cloud_.facets[pair[1]].node)
      if (i == k) return true;
  return false;
}

double CrossingFacets::reach(CloudFacetIndex f, CloudFacetIndex g, double sign) const {
  const Vec3 n = sign * normal(g).normalized();
  double farthest = 0.0;
  for (const NodeIndex i : cloud_.facets[f].node)
    farthest = std::max(farthest, n.dot(cloud_.position[i] - cloud_.position[cloud_.facets[g].node[0]]));
  return farthest;
}

/// Where edges of either go through the other one.
std::vector<Vec3> CrossingFacets::common_points(const Pair& pair) const {
  std::vector<Vec3> points;
  const auto pierce = [&](CloudFacetIndex f, CloudFacetIndex g) {
    const auto x = corners_of<3>(cloud_.facets[g], cloud_.position);
    const Vec3 n = area_normal<3>(x);
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 &a = cloud_.position[cloud_.facets[f].node[k]],
                 &b = cloud_.position[cloud_.facets[f].node[(k + 1) % 3]];
      const double from = n.dot(a - x[0]), to = n.dot(b - x[0]);
      if (from * to > 0.0 || from == to) continue;
      const Vec3 at = a + from / (from - to) * (b - a);
      bool inside = true;
      for (std::size_t m = 0; m < 3; ++m)
        inside = inside && (x[(m + 1) % 3] - x[m]).cross(at - x[m]).dot(n) >= -1e-9 * n.squaredNorm();
      if (inside) points.push_back(at);
    }
  };
  pierce(pair[0], pair[1]);
  pierce(pair[1], pair[0]);
  return points;
}

/// Of what they have in common.
Vec3 CrossingFacets::middle(const Pair& pair) const {
  const std::vector<Vec3> points = common_points(pair);
  if (points.empty()) return cloud_.position[cloud_.facets[pair[0]].node[0]];
  Vec3 sum = Vec3::Zero();
  for (const Vec3& x : points) sum += x;
  return sum / static_cast<double>(points.size());
}

bool CrossingFacets::were_back_to_back(const Pair& pair, const voronoi::Winding& winding) const {
  constexpr double little = 1e-6; // h
  const Vec3 up = normal(pair[0]).normalized() + normal(pair[1]).normalized();
  const double h = size_[index_of(cloud_.facets[pair[0]].node[0])];
  return winding(middle(pair) + little * h * up.normalized()) < 0;
}

CrossingFacets::Overlap CrossingFacets::overlap(const Pair& pair, const voronoi::Winding& winding) const {
  const auto [f, g] = pair;
  const double above = were_back_to_back(pair, winding) ? 1.0 : -1.0;
  const double over_g = reach(f, g, above), over_f = reach(g, f, above);
  return {std::min(over_g, over_f),
          -above * (over_g < over_f ? normal(g).normalized() : Vec3(-normal(f).normalized()))};
}

double CrossingFacets::common_length(const Pair& pair) const {
  double longest = 0.0;
  const std::vector<Vec3> points = common_points(pair);
  for (const Vec3& a : points)
    for (const Vec3& b : points) longest = std::max(longest, (a - b).norm());
  return longest;
}

bool CrossingFacets::facing(const Pair& pair) const {
  return !share_a_node(pair) && normal(pair[0]).dot(normal(pair[1])) < 0.0;
}

} // namespace cnem::adapt
