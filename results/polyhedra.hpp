#pragma once
// The cells of the nodes of a body in space as polyhedra, for files.
#include "core/fields/aligned.hpp"
#include "core/geometry/cloud.hpp"
#include "core/operators/discretisation.hpp"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace cnem::results {

/// Polygons on shared points, and which of them bound each cell.
struct Polyhedra {
  std::vector<Vec3> point;              ///< m
  std::vector<std::int32_t> face_begin; ///< [face + 1]
  std::vector<std::int32_t> face_point; ///< of each face in order round it; not plane where cells have moved
  /// Of each cell: face f, its points counter-clockwise as seen from outside, or −1 − f where they run
  /// clockwise.
  std::vector<std::vector<std::int32_t>> cell;

  std::size_t faces() const { return face_begin.empty() ? 0 : face_begin.size() - 1; }
  std::span<const std::int32_t> face(std::size_t f) const {
    return {face_point.data() + face_begin[f], face_point.data() + face_begin[f + 1]};
  }
  /// m³, enclosed by the fans of triangles from the first points of its faces.
  double volume(std::size_t cell) const;
};

/// Nodes of the tetrahedra of cells that are some.
std::vector<std::array<NodeIndex, 4>> tetrahedra_of(const CellGeometry<3>& cells);

/// Cells of the nodes of tetrahedra that tile the body of a cloud: constrained Voronoi cells as smoothing
/// sees them in the reference (voronoi/space/voronoi_cells.hpp), else those of the median dual, moved with
/// the nodes: every point stays where it is in its tetrahedron. Facets that are not plane in the reference
/// are fans of triangles. position: [component][node] m, at present. Σ volume is that of the body at present.
/// Throws GeometryError as voronoi::connected does.
enum class PolyhedraOf { voronoi_cells, median_cells };
Polyhedra polyhedra(PolyhedraOf cells, const Cloud<3>& reference,
                    std::span<const std::array<NodeIndex, 4>> tetrahedra, const Fields<3>& position);

} // namespace cnem::results
