#pragma once
// Tetrahedra and the volumes of nodes in space: what a pass looks at between two rounds.
#include "cnem/space.hpp"
#include "core/geometry/cell_complex.hpp"
#include "voronoi/space/tetrahedra.hpp"

#include <array>
#include <span>

namespace cnem::adapt {

struct SpaceStructure {
  voronoi::Tetrahedra mesh;
  CellLists<SimplexIndex> tetrahedra; ///< of each node
  CellLists<NodeIndex> linked;        ///< ends of the edges of each node
  Field cell;                         ///< [node] m³
  bool flipped = false;               ///< as of voronoi::RecoveredBoundary

  double volume(NodeIndex i) const { return cell[index_of(i)]; }
  std::span<const NodeIndex> neighbours(NodeIndex i) const { return linked.of(i); }
};

/// m³, of a right-handed tetrahedron.
double volume_of(const Cloud<3>& cloud, const std::array<NodeIndex, 4>& node);

/// The tetrahedra of each of so many nodes.
CellLists<SimplexIndex> tetrahedra_of_nodes(std::size_t nodes, const voronoi::Tetrahedra& mesh);

/// With the volumes of median cells, a quarter of each tetrahedron, or those of Voronoi cells. O(N).
SpaceStructure structure_of(const Cloud<3>& cloud, voronoi::Tetrahedra mesh,
                            scni::CellKind cells = scni::CellKind::median);

/// m, [node] edge of the cube that holds what a node would have inside of a lattice: (6 V)^⅓ with the mean
/// volume V of its tetrahedra.
Field spacing_of(const Cloud<3>& cloud, const SpaceStructure& structure);

} // namespace cnem::adapt
