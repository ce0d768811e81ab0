#pragma once
// A body in space as a picture shows it: its surface lit from above, or a plane cut through its cells.
#include "core/geometry/cloud.hpp"
#include "core/geometry/triangle_surface.hpp"
#include "core/operators/discretisation.hpp"
#include "report/picture.hpp"

#include <array>
#include <span>
#include <vector>

namespace cnem::report {

/// Parallel projection: what is seen from far away along `eye`.
struct BodyView {
  Vec3 eye = Vec3(1.0, -1.6, 1.0); ///< from the body towards the eye, of any length; not zero

  /// Rows: to the right, upwards (as far as it goes z, else y), towards the eye; orthonormal.
  Mat<3> axes() const;
};

/// Polygons in the plane of a picture, whatever field colours them.
struct Scene {
  CellGeometry<2> cells;
  Fields<2> position;          ///< [component][vertex] m
  std::vector<NodeIndex> node; ///< [polygon] whose value it shows
  std::vector<float> darkness; ///< [polygon] 0 to 1; empty: 0
  Field depth;                 ///< [vertex] m, towards the eye; empty: no polygon lies before another

  Field values(std::span<const double> at_nodes) const; ///< [polygon]
};

/// The facets that face the eye, in the parts of their nodes. Lit from above the eye's left. position:
/// [component][node] m.
Scene surface_scene(std::span<const std::array<NodeIndex, 3>> facets, const Fields<3>& position,
                    const BodyView& view);

/// What of a closed surface is on the side of planes that their normals come from, as the same eye sees it;
/// where a plane has cut it open it is filled.
void add_solid(SolidFaces& faces, const TriangleSurface& surface, std::span<const KeptSide> sides,
               const BodyView& view);

/// The faces of tetrahedra that are of one alone, outwards.
std::vector<std::array<NodeIndex, 3>> boundary_of(std::span<const std::array<NodeIndex, 4>> tetrahedra);

/// The plane of the places x with normal · (x − at) = 0 through tetrahedra, seen from where the normal
/// points: in each the parts nearest to its nodes by barycentric coordinates (median cells), or by distance,
/// nodes of its neighbours among them (Voronoi cells). tetrahedra: corners, right-handed.
enum class SectionCells { median, voronoi };
Scene section_scene(std::span<const std::array<NodeIndex, 4>> tetrahedra, const Fields<3>& position,
                    const Vec3& at, const Vec3& normal, SectionCells cells);

} // namespace cnem::report
