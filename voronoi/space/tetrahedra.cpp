#include "voronoi/space/tetrahedra.hpp"

#include "core/error.hpp"
#include "core/geometry/place_text.hpp"
#include "core/index.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <string_view>
#include <tuple>
#include <vector>

namespace cnem::voronoi {
namespace {

using Corners = std::array<NodeIndex, 3>;

/// A face of a tetrahedron, or a facet of the boundary, under its nodes in increasing order.
struct FaceOrFacet {
  Corners key;
  SimplexIndex tetrahedron; ///< none: a facet
  std::int32_t place;       ///< corner it is opposite to, or number of the facet
};

Corners in_order(Corners corner) {
  std::sort(corner.begin(), corner.end());
  return corner;
}

[[noreturn]] void refuse(const Cloud<3>& cloud, const Corners& corner, std::string_view what) {
  std::string nodes;
  for (const NodeIndex i : corner)
    nodes += fmt::format("{}{} at {}", nodes.empty() ? "" : ", ", index_of(i), place_text(cloud.position[i]));
  throw GeometryError(fmt::format("the face between nodes {} m {}", nodes, what));
}

/// All faces of tetrahedra, and after those of the same nodes the facet there.
std::vector<FaceOrFacet> sides_of(const Cloud<3>& cloud,
                                  std::span<const std::array<NodeIndex, 4>> tetrahedra) {
  std::vector<FaceOrFacet> sides;
  sides.reserve(4 * tetrahedra.size() + cloud.facets.size());
  for (std::size_t t = 0; t < tetrahedra.size(); ++t)
    for (std::size_t k = 0; k < 4; ++k) {
      const auto& face = face_of_tetrahedron[k];
      sides.push_back({in_order({tetrahedra[t][face[0]], tetrahedra[t][face[1]], tetrahedra[t][face[2]]}),
                       as<SimplexIndex>(t), static_cast<std::int32_t>(k)});
    }
  for (const CloudFacetIndex f : cloud.facets.indices())
    sides.push_back({in_order(cloud.facets[f].node), SimplexIndex::none, static_cast<std::int32_t>(f)});
  std::sort(sides.begin(), sides.end(), [](const FaceOrFacet& a, const FaceOrFacet& b) {
    const bool facet_a = !exists(a.tetrahedron), facet_b = !exists(b.tetrahedron);
    return std::tie(a.key, facet_a, a.tetrahedron, a.place) <
           std::tie(b.key, facet_b, b.tetrahedron, b.place);
  });
  return sides;
}

} // namespace

Tetrahedra connected(const Cloud<3>& cloud, std::span<const std::array<NodeIndex, 4>> tetrahedra) {
  Tetrahedra mesh;
  mesh.node.assign(tetrahedra.begin(), tetrahedra.end());
  constexpr SimplexIndex no_tetrahedron = SimplexIndex::none;
  constexpr CloudFacetIndex no_facet = CloudFacetIndex::none;
  mesh.neighbour.assign(tetrahedra.size(), {no_tetrahedron, no_tetrahedron, no_tetrahedron, no_tetrahedron});
  mesh.facet.assign(tetrahedra.size(), {no_facet, no_facet, no_facet, no_facet});
  mesh.of_node.assign(cloud.position.size(), SimplexIndex::none);
  for (const SimplexIndex t : mesh.node.indices())
    for (const NodeIndex i : mesh.node[t])
      if (!exists(mesh.of_node[i])) mesh.of_node[i] = t;
  for (const NodeIndex i : cloud.position.indices())
    if (!exists(mesh.of_node[i]))
      throw GeometryError(fmt::format("node {} at {} m belongs to no tetrahedron", index_of(i),
                                      place_text(cloud.position[i])));

  const std::vector<FaceOrFacet> sides = sides_of(cloud, tetrahedra);
  for (std::size_t first = 0, last = 0; first < sides.size(); first = last) {
    while (last < sides.size() && sides[last].key == sides[first].key) ++last;
    const FaceOrFacet& a = sides[first];
    const std::size_t count = last - first;
    if (count > 2) refuse(cloud, a.key, "belongs to more than two tetrahedra or facets");
    if (!exists(a.tetrahedron))
      refuse(cloud, a.key, "is a facet of the boundary and belongs to no tetrahedron");
    if (count == 1) refuse(cloud, a.key, "belongs to one tetrahedron alone and is no facet of the boundary");
    const FaceOrFacet& b = sides[first + 1];
    if (exists(b.tetrahedron)) {
      mesh.neighbour[a.tetrahedron][index_of(a.place)] = b.tetrahedron;
      mesh.neighbour[b.tetrahedron][index_of(b.place)] = a.tetrahedron;
    } else {
      mesh.facet[a.tetrahedron][index_of(a.place)] = static_cast<CloudFacetIndex>(b.place);
    }
  }
  return mesh;
}

} // namespace cnem::voronoi
