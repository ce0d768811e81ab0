#include "voronoi/plane/boundary_checks.hpp"

#include "core/error.hpp"
#include "core/geometry/place_text.hpp"
#include "core/index.hpp"
#include "voronoi/twins.hpp"

#include <cmath>
#include <fmt/format.h>

namespace cnem::voronoi {

namespace {

std::string describe_point(const Vec2& x) { return place_text(x, 9) + " m"; }

const Vec2& at(const Cloud<2>& cloud, NodeIndex node) { return cloud.position[node]; }

} // namespace

std::string describe_node(const Cloud<2>& cloud, NodeIndex node) {
  return fmt::format("node {} at {}", index_of(node), describe_point(at(cloud, node)));
}

std::string describe_facet(const Cloud<2>& cloud, CloudFacetIndex facet) {
  const auto& [a, b] = cloud.facets[facet].node;
  return fmt::format("facet {} from {} to {}", index_of(facet), describe_point(at(cloud, a)),
                     describe_point(at(cloud, b)));
}

IndexedVector<NodeIndex, CloudFacetIndex> outgoing_facets(const Cloud<2>& cloud) {
  for (const NodeIndex i : cloud.position.indices())
    if (!at(cloud, i).allFinite())
      throw GeometryError(fmt::format("{}: the position is not finite", describe_node(cloud, i)));
  if (cloud.facets.empty())
    throw GeometryError("empty domain: the cloud has no boundary facets, expected at least one closed loop");

  const auto n = index_of(cloud.nodes());
  IndexedVector<NodeIndex, CloudFacetIndex> leaving(n, CloudFacetIndex::none),
      arriving(n, CloudFacetIndex::none);
  const auto claim = [&](IndexedVector<NodeIndex, CloudFacetIndex>& of_node, NodeIndex node,
                         CloudFacetIndex facet, const char* verb) {
    auto& slot = of_node[node];
    if (exists(slot))
      throw GeometryError(
          fmt::format("boundary branches at {}: facets {} and {} both {} it, expected one (loops that touch "
                      "need a node of their own each, declared as twins)",
                      describe_node(cloud, node), index_of(slot), index_of(facet), verb));
    slot = facet;
  };
  for (const CloudFacetIndex facet : cloud.facets.indices()) {
    const auto& [a, b] = cloud.facets[facet].node;
    check_node_index(cloud, a, fmt::format("facet {}", index_of(facet)));
    check_node_index(cloud, b, fmt::format("facet {}", index_of(facet)));
    if (at(cloud, a) == at(cloud, b))
      throw GeometryError(fmt::format("{} has zero length (nodes {} and {})", describe_facet(cloud, facet),
                                      index_of(a), index_of(b)));
    claim(leaving, a, facet, "leave");
    claim(arriving, b, facet, "arrive at");
  }
  for (const NodeIndex i : cloud.position.indices()) {
    const bool leaves = exists(leaving[i]);
    if (leaves != exists(arriving[i]))
      throw GeometryError(fmt::format("open boundary: at {} a facet {} but none {}, expected closed loops",
                                      describe_node(cloud, i), leaves ? "leaves" : "arrives",
                                      leaves ? "arrives" : "leaves"));
  }
  return leaving;
}

void throw_crossing(const Cloud<2>& cloud) {
  for (const CloudFacetIndex f : cloud.facets.indices())
    for (const CloudFacetIndex g : cloud.facets.indices()) {
      if (g <= f || !cloud.one_body(cloud.facets[f].node[0], cloud.facets[g].node[0])) continue;
      const Vec2 &a = at(cloud, cloud.facets[f].node[0]), &b = at(cloud, cloud.facets[f].node[1]);
      const Vec2 &c = at(cloud, cloud.facets[g].node[0]), &d = at(cloud, cloud.facets[g].node[1]);
      const double side_c = cross(b - a, c - a), side_d = cross(b - a, d - a);
      const double side_a = cross(d - c, a - c), side_b = cross(d - c, b - c);
      if (!(side_c * side_d < 0.0 && side_a * side_b < 0.0)) continue;
      const Vec2 x = a + (b - a) * (side_a / (side_a - side_b));
      throw GeometryError(fmt::format("the boundary crosses itself at {}: {} crosses {}", describe_point(x),
                                      describe_facet(cloud, f), describe_facet(cloud, g)));
    }
  throw GeometryError("the boundary crosses itself (facets overlap to within rounding)");
}

void throw_node_on_facet(const Cloud<2>& cloud, CloudFacetIndex facet) {
  const auto& [a, b] = cloud.facets[facet].node;
  const Vec2 along = at(cloud, b) - at(cloud, a);
  NodeIndex nearest = NodeIndex::none;
  double best = 0.0;
  for (const NodeIndex i : cloud.position.indices()) {
    if (!cloud.one_body(a, i)) continue;
    const Vec2 r = at(cloud, i) - at(cloud, a);
    const double s = r.dot(along) / along.squaredNorm();
    if (s <= 0.0 || s >= 1.0 || r == along) continue;
    const double distance = std::abs(cross(along, r));
    if (!exists(nearest) || distance < best) nearest = i, best = distance;
  }
  if (!exists(nearest))
    throw GeometryError(fmt::format("{} overlaps another facet", describe_facet(cloud, facet)));
  throw GeometryError(fmt::format("{} lies on {}, which is not its own: expected the facet to be split there "
                                  "or the node moved",
                                  describe_node(cloud, nearest), describe_facet(cloud, facet)));
}

} // namespace cnem::voronoi
