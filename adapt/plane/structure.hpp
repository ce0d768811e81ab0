#pragma once
// Cells without shape functions: what insertion and removal look at between two rounds.
#include "core/geometry/revolution.hpp"
#include "core/index.hpp"
#include "voronoi/plane/cells.hpp"
#include "voronoi/plane/circumcircles.hpp"
#include "voronoi/plane/triangulation.hpp"

#include <cstdint>
#include <numbers>
#include <optional>
#include <span>
#include <vector>

namespace cnem::adapt {

/// Triangles, cells and neighbours of one cloud, in the plane or in the meridian plane of a body of
/// revolution.
struct Structure {
  Space space = Space::plane;
  voronoi::Triangulation mesh;
  voronoi::Circumcircles circles;
  voronoi::Cells cells;
  Field radius; ///< [cell] of the centroid, m; of revolution only

  /// m³ per metre of thickness, or m³ of the ring that the cell turns to.
  double volume(NodeIndex cell) const {
    const std::size_t i = index_of(cell);
    return space == Space::plane ? cells.volume[i] : 2.0 * std::numbers::pi * radius[i] * cells.volume[i];
  }
  /// Delaunay neighbours, in increasing order.
  std::span<const NodeIndex> neighbours(NodeIndex node) const { return cells.neighbours.of(node); }
};

/// Throws GeometryError as voronoi::triangulate and voronoi::constrained_cells do.
Structure build_structure(const Cloud<2>& cloud, Space space = Space::plane);
/// Empty where there is none: nodes have passed each other or boundaries cross.
std::optional<Structure> structure_if_valid(const Cloud<2>& cloud, Space space = Space::plane);

/// Mean distance of a node to its neighbours, m.
double spacing_at(const Cloud<2>& cloud, const Structure& structure, NodeIndex node);
/// That of all nodes.
Field spacing_of(const Cloud<2>& cloud, const Structure& structure);

/// The face of two cells, where one of the two nodes is marked: volume of the triangle of that face and the
/// marked node, as Structure::volume: how much of the marked cell lies towards the other.
struct Contribution {
  NodeIndex marked, other;
  double volume;
};
/// All faces between a marked and an unmarked node, by marked node and then by the other.
std::vector<Contribution> contributions(const Cloud<2>& cloud, const Structure& structure,
                                        const IndexedVector<NodeIndex, char>& marked);

/// Distance from x to the segment ab, and where its foot is on the line: 0 at a, 1 at b.
struct Foot {
  double distance, place;
};
Foot foot_on(const Vec2& x, const Vec2& a, const Vec2& b);

} // namespace cnem::adapt
