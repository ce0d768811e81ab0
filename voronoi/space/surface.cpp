#include "voronoi/space/surface.hpp"

#include "core/error.hpp"
#include "core/geometry/box.hpp"
#include "core/geometry/facets.hpp"
#include "core/geometry/place_text.hpp"
#include "core/index.hpp"
#include "voronoi/space/exact.hpp"
#include "voronoi/twins.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace cnem::voronoi {

namespace {

constexpr SurfaceEdge no_edge = -1;

void check_lists(const Cloud<3>& cloud) {
  for (const NodeIndex i : cloud.position.indices())
    if (!cloud.position[i].allFinite())
      throw GeometryError(fmt::format("{}: the position is not finite", describe_node(cloud, i)));
  if (cloud.facets.empty())
    throw GeometryError("empty domain: the cloud has no boundary facets, expected a closed surface");
  for (const CloudFacetIndex f : cloud.facets.indices()) {
    const auto& [a, b, c] = cloud.facets[f].node;
    for (const NodeIndex i : {a, b, c}) check_node_index(cloud, i, fmt::format("facet {}", index_of(f)));
    if (a == b || b == c || c == a)
      throw GeometryError(fmt::format("{} has one node twice", describe_facet(cloud, f)));
  }
}

/// Edges as pairs: of each edge, the one that runs the other way. They are found by their lower end.
SurfaceEdges paired_edges(const Cloud<3>& cloud) {
  struct AtLower {
    NodeIndex higher;
    SurfaceEdge edge;
    bool up; ///< from the lower end
  };
  const auto ends = [&](CloudFacetIndex f, std::size_t k) {
    const auto& node = cloud.facets[f].node;
    return std::array{node[k], node[(k + 1) % 3]};
  };
  std::vector<std::uint32_t> begin(cloud.position.size() + 2, 0);
  for (const CloudFacetIndex f : cloud.facets.indices())
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [a, b] = ends(f, k);
      ++begin[index_of(std::min(a, b)) + 2];
    }
  for (std::size_t i = 2; i < begin.size(); ++i) begin[i] += begin[i - 1];
  std::vector<AtLower> entry(3 * cloud.facets.size());
  for (const CloudFacetIndex f : cloud.facets.indices())
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [a, b] = ends(f, k);
      entry[begin[index_of(std::min(a, b)) + 1]++] = {std::max(a, b), edge_at(f, k), a < b};
    }
  SurfaceEdges across(cloud.facets.size(), {no_edge, no_edge, no_edge});
  for (const CloudFacetIndex f : cloud.facets.indices())
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [a, b] = ends(f, k);
      SurfaceEdge found = no_edge;
      const auto edge_text = [&, a = a, b = b] {
        return fmt::format("the edge from {} to {}", describe_node(cloud, a), describe_node(cloud, b));
      };
      const std::size_t lower = index_of(std::min(a, b));
      for (std::uint32_t q = begin[lower]; q < begin[lower + 1]; ++q) {
        const AtLower& other = entry[q];
        if (other.higher != std::max(a, b) || other.edge == edge_at(f, k)) continue;
        if (other.up == (a < b))
          throw GeometryError(fmt::format(
              "{} and facet {} run along {} in the same direction: expected a surface that does not branch, "
              "with all normals outwards (inside out?)",
              describe_facet(cloud, f), index_of(facet_of(other.edge)), edge_text()));
        found = other.edge; // a third one would run as one of the two
      }
      if (found == no_edge)
        throw GeometryError(fmt::format("open surface: {} has no other side at {}, expected a closed surface",
                                        describe_facet(cloud, f), edge_text()));
      across[f][k] = found;
    }
  return across;
}

/// Each node has one fan of facets.
void check_fans(const Cloud<3>& cloud, const SurfaceEdges& across) {
  IndexedVector<NodeIndex, std::int32_t> facets_at(cloud.position.size(), 0);
  IndexedVector<NodeIndex, SurfaceEdge> leaving(cloud.position.size(), no_edge);
  for (const CloudFacetIndex f : cloud.facets.indices())
    for (std::size_t k = 0; k < 3; ++k) {
      ++facets_at[cloud.facets[f].node[k]];
      leaving[cloud.facets[f].node[k]] = edge_at(f, k);
    }
  for (const NodeIndex i : leaving.indices()) {
    if (leaving[i] == no_edge) continue;
    SurfaceEdge e = leaving[i];
    std::int32_t count = 0;
    do {
      const SurfaceEdge back = across[facet_of(e)][place_of(e)];
      e = edge_at(facet_of(back), (place_of(back) + 1) % 3);
      ++count;
    } while (e != leaving[i]);
    if (count != facets_at[i])
      throw GeometryError(fmt::format("the surface touches itself at {}: expected a node of its own for each "
                                      "part, declared as twins",
                                      describe_node(cloud, i)));
  }
}

int side(const Cloud<3>& cloud, const std::array<NodeIndex, 3>& facet, NodeIndex i) {
  return orientation(cloud.position[facet[0]], cloud.position[facet[1]], cloud.position[facet[2]],
                     cloud.position[i]);
}

/// Whether the segment from p to q passes through the inside of the triangle or of one of its edges.
bool pierces(const Cloud<3>& cloud, NodeIndex p, NodeIndex q, const std::array<NodeIndex, 3>& triangle) {
  for (const NodeIndex corner : triangle)
    if (corner == p || corner == q) return false; // it is on the plane
  if (side(cloud, triangle, p) * side(cloud, triangle, q) >= 0) return false;
  int turns[3];
  for (std::size_t k = 0; k < 3; ++k) turns[k] = side(cloud, {p, q, triangle[k]}, triangle[(k + 1) % 3]);
  const int low = std::min({turns[0], turns[1], turns[2]}), high = std::max({turns[0], turns[1], turns[2]});
  return low * high >= 0 && (turns[0] != 0) + (turns[1] != 0) + (turns[2] != 0) > 1;
}

bool cross(const Cloud<3>& cloud, const std::array<NodeIndex, 3>& f, const std::array<NodeIndex, 3>& g) {
  for (std::size_t k = 0; k < 3; ++k)
    if (pierces(cloud, f[k], f[(k + 1) % 3], g) || pierces(cloud, g[k], g[(k + 1) % 3], f)) return true;
  return false;
}

} // namespace

std::string describe_node(const Cloud<3>& cloud, NodeIndex node) {
  return fmt::format("node {} at {} m", index_of(node), place_text(cloud.position[node], 9));
}

std::string describe_facet(const Cloud<3>& cloud, CloudFacetIndex facet) {
  std::string nodes;
  for (const NodeIndex i : cloud.facets[facet].node)
    nodes +=
        fmt::format("{}{} at {}", nodes.empty() ? "" : ", ", index_of(i), place_text(cloud.position[i], 9));
  return fmt::format("facet {} between nodes {} m", index_of(facet), nodes);
}

SurfaceEdges surface_edges(const Cloud<3>& cloud) {
  check_lists(cloud);
  SurfaceEdges across = paired_edges(cloud);
  check_fans(cloud, across);
  return across;
}

IndexedVector<CloudFacetIndex, CloudFacetIndex> facets_behind(const Cloud<3>& cloud) {
  IndexedVector<CloudFacetIndex, CloudFacetIndex> behind(cloud.facets.size(), CloudFacetIndex::none);
  const auto group = twin_groups(cloud);
  if (group.empty()) return behind;
  IndexedVector<NodeIndex, std::uint8_t> paired(group.size(), 0);
  for (const auto& [a, b] : cloud.twins) paired[a] = paired[b] = 1;
  std::vector<std::pair<std::array<NodeIndex, 3>, CloudFacetIndex>> keys;
  for (const CloudFacetIndex f : behind.indices()) {
    const auto& [a, b, c] = cloud.facets[f].node;
    if (!paired[a] && !paired[b] && !paired[c]) continue;
    std::array key{group[a], group[b], group[c]};
    std::sort(key.begin(), key.end());
    keys.push_back({key, f});
  }
  std::sort(keys.begin(), keys.end());
  for (std::size_t n = 0; n + 1 < keys.size(); ++n)
    if (keys[n].first == keys[n + 1].first) {
      behind[keys[n].second] = keys[n + 1].second;
      behind[keys[n + 1].second] = keys[n].second;
    }
  return behind;
}

void refuse_crossings(const Cloud<3>& cloud, const std::vector<CloudFacetIndex>& suspects) {
  IndexedVector<CloudFacetIndex, Box<3>> box;
  for (const auto& facet : cloud.facets) box.push_back(box_of<3>(corners_of<3>(facet, cloud.position)));
  for (const CloudFacetIndex f : suspects) {
    const auto crosses_f = [&](CloudFacetIndex g) {
      return f != g && overlap(box[f], box[g]) && cross(cloud, cloud.facets[f].node, cloud.facets[g].node);
    };
    CloudFacetIndex crossed = CloudFacetIndex::none;
    for (const CloudFacetIndex g : box.indices())
      if (!exists(crossed) && crosses_f(g)) crossed = g;
    if (exists(crossed))
      throw GeometryError(fmt::format("the surface crosses itself: {} crosses {}", describe_facet(cloud, f),
                                      describe_facet(cloud, crossed)));
  }
}

} // namespace cnem::voronoi
