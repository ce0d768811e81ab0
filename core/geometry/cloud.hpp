#pragma once
// The cloud of nodes with its boundary: all that a discretisation is built from.
#include "core/geometry/revolution.hpp"
#include "core/indexed.hpp"
#include "core/vec.hpp"

#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace cnem {

/// A piece of boundary between `dim` nodes. In 2D a directed edge node[0] → node[1] with the domain on its
/// left; in 3D a triangle whose normal points outwards.
template<int dim> struct Facet {
  std::array<NodeIndex, dim> node;
  PieceIndex piece{};
};

/// Nodes, boundary and named boundary pieces. Positions in m.
///
/// In 2D the facets form closed loops: each boundary node has exactly one facet that leaves it and one that
/// enters it; the outer loop runs counter-clockwise, holes clockwise. A crack is a loop of zero area
/// (embedded) or a detour of a loop (open to the boundary), whose two faces are duplicated nodes at the same
/// positions, declared in `twins`; the nodes at its tips are single. Coincident nodes that are not declared
/// are an error.
template<int dim> struct Cloud {
  IndexedVector<NodeIndex, Vec<dim>> position;        ///< m
  IndexedVector<CloudFacetIndex, Facet<dim>> facets;  ///< the whole boundary, loop after loop
  IndexedVector<PieceIndex, std::string> piece_names; ///< of the boundary
  std::vector<std::array<NodeIndex, 2>> twins;        ///< pairs of nodes that coincide on purpose
  /// [facet] the facet of the other face at the same place or a period away, which runs the other way:
  /// resampling divides and joins both alike (core/geometry/mates.hpp). none: it has none; empty: none has.
  IndexedVector<CloudFacetIndex, CloudFacetIndex> mates{};
  /// [simplex] nodes, right-handed. In the plane they filled the domain when nodes were about where they are:
  /// triangulating begins with them. In space it came to them, with nodes and facets as they are now: who
  /// changes these drops them. What comes of it does not depend on them. Empty: it begins with nothing.
  IndexedVector<SimplexIndex, std::array<NodeIndex, dim + 1>> simplices{};
  /// [simplex][k] the one across from its node k; none: not known, or a facet. Empty: none is known.
  IndexedVector<SimplexIndex, std::array<SimplexIndex, dim + 1>> across{};
  /// [node] the body that it is of. Bodies share no nodes, and one may lie in another: where
  /// faces press on each other they overlap by what compliance asks for, which is no business of the matter
  /// on either side. Empty: nothing may overlap.
  IndexedVector<NodeIndex, std::int32_t> body{};

  bool one_body(NodeIndex a, NodeIndex b) const { return body.empty() || body[a] == body[b]; }

  int nodes() const { return static_cast<int>(position.size()); }
};

/// Area (m²) or volume (m³; of revolution that of the whole body) that a boundary encloses, with
/// position(node) for the places of its nodes.
template<int dim, class Position>
double enclosed_measure(const std::vector<Facet<dim>>& facets, const Position& position,
                        Space space = Space::plane) {
  double sum = 0.0;
  for (const Facet<dim>& facet : facets) {
    const auto& [a, b] = std::pair<Vec<dim>, Vec<dim>>(position(facet.node[0]), position(facet.node[1]));
    if constexpr (dim == 2) {
      sum += space == Space::plane ? cross(a, b) : 2.0 * revolved_volume(a, b);
    } else {
      const Vec<dim> c = position(facet.node[2]);
      sum += a.x() * (b.y() * c.z() - b.z() * c.y()) + a.y() * (b.z() * c.x() - b.x() * c.z()) +
             a.z() * (b.x() * c.y() - b.y() * c.x());
    }
  }
  return dim == 2 ? 0.5 * sum : sum / 6.0;
}
template<int dim> double enclosed_measure(const Cloud<dim>& cloud, Space space = Space::plane) {
  const auto position = [&](NodeIndex i) -> const Vec<dim>& { return cloud.position[i]; };
  return enclosed_measure(cloud.facets, position, space);
}

} // namespace cnem
