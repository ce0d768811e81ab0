#pragma once
// The cloud of nodes with its boundary: all that a discretisation is built from.
#include "core/index.hpp"
#include "core/vec.hpp"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace cnem {

/// A piece of boundary between `dim` nodes. In 2D a directed edge node[0] → node[1] with the domain on its
/// left; in 3D a triangle whose normal points outwards.
template<int dim> struct Facet {
  std::array<std::int32_t, dim> node;
  std::int32_t piece = 0; ///< index into Cloud::piece_names
};

/// Nodes, boundary and named boundary pieces. Positions in m.
///
/// In 2D the facets form closed loops: each boundary node has exactly one facet that leaves it and one that
/// enters it; the outer loop runs counter-clockwise, holes clockwise. A crack is a loop of zero area
/// (embedded) or a detour of a loop (open to the boundary), whose two faces are duplicated nodes at the same
/// positions, declared in `twins`; the nodes at its tips are single. Coincident nodes that are not declared
/// are an error.
template<int dim> struct Cloud {
  std::vector<Vec<dim>> position;                 ///< [node], m
  std::vector<Facet<dim>> facets;                 ///< the whole boundary, loop after loop
  std::vector<std::string> piece_names;           ///< names of boundary pieces
  std::vector<std::array<std::int32_t, 2>> twins; ///< pairs of nodes that coincide on purpose

  int nodes() const { return static_cast<int>(position.size()); }
};

/// Area that a boundary in the plane encloses, m², with position(node) for the places of its nodes.
template<class Position> double enclosed_area(const std::vector<Facet<2>>& facets, const Position& position) {
  double twice = 0.0;
  for (const Facet<2>& facet : facets) twice += cross(position(facet.node[0]), position(facet.node[1]));
  return 0.5 * twice;
}
inline double enclosed_area(const Cloud<2>& cloud) {
  return enclosed_area(cloud.facets,
                       [&](std::int32_t i) -> const Vec2& { return cloud.position[index_of(i)]; });
}

} // namespace cnem
