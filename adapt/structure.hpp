#pragma once
// Cells without shape functions: what insertion and removal look at between two rounds.
#include "core/index.hpp"
#include "voronoi/cells.hpp"
#include "voronoi/circumcircles.hpp"
#include "voronoi/triangulation.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace cnem::adapt {

/// Triangles, cells and neighbours of one cloud.
struct Structure {
  voronoi::Triangulation mesh;
  voronoi::Circumcircles circles;
  voronoi::Cells cells;

  /// Delaunay neighbours, in increasing order.
  std::span<const NodeIndex> neighbours(NodeIndex node) const { return cells.neighbours.of(node); }
};

/// Throws GeometryError as voronoi::triangulate and voronoi::constrained_cells do.
Structure build_structure(const Cloud<2>& cloud);
/// Empty where there is none: nodes have passed each other or boundaries cross.
std::optional<Structure> structure_if_valid(const Cloud<2>& cloud);

/// Mean distance of a node to its neighbours, m.
double spacing_at(const Cloud<2>& cloud, const Structure& structure, NodeIndex node);
/// That of all nodes.
Field spacing_of(const Cloud<2>& cloud, const Structure& structure);

/// The face of two cells, where one of the two nodes is marked: area of the triangle of that face and the
/// marked node, m²: how much of the marked cell lies towards the other.
struct Contribution {
  NodeIndex marked, other;
  double area;
};
/// All faces between a marked and an unmarked node, by marked node and then by the other.
std::vector<Contribution> contributions(const Cloud<2>& cloud, const CellComplex<2>& cells,
                                        const IndexedVector<NodeIndex, char>& marked);

/// Distance from x to the segment ab, and where its foot is on the line: 0 at a, 1 at b.
struct Foot {
  double distance, place;
};
Foot foot_on(const Vec2& x, const Vec2& a, const Vec2& b);

} // namespace cnem::adapt
