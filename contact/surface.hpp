#pragma once
// The boundary of the workpiece as contact sees it, and where ridges of tools press on its facets.
#include "contact/tool_shape.hpp"
#include "core/geometry/cloud.hpp"
#include "core/geometry/revolution.hpp"
#include "core/indexed.hpp"

#include <array>
#include <span>
#include <type_traits>
#include <vector>

namespace cnem::contact {

/// [boundary node] positions, m.
template<int dim> using PlacesOnBoundary = IndexedSpan<BoundaryNodeIndex, const Vec<dim>>;

/// An edge of a surface in space, between two facets.
struct SurfaceEdge {
  std::array<BoundaryNodeIndex, 3> node{}; ///< its ends, and the corner of facet[0] across from it
  std::array<FacetIndex, 2> facet{FacetIndex::none, FacetIndex::none}; ///< none: the surface is open there
};

/// Facets on a list of boundary nodes numbered from 0.
template<int dim> struct Surface {
  IndexedVector<BoundaryNodeIndex, NodeIndex> node;                     ///< in increasing order
  IndexedVector<FacetIndex, std::array<BoundaryNodeIndex, dim>> facets; ///< in the order of the cloud
  IndexedVector<FacetIndex, PieceIndex> piece;
  IndexedVector<BoundaryNodeIndex, FacetIndex> leaving, entering;   ///< 2D: none where there is none
  IndexedVector<BoundaryNodeIndex, std::vector<FacetIndex>> around; ///< 3D
  IndexedVector<SurfaceEdgeIndex, SurfaceEdge> edges; ///< 3D: in the order of their first facets

  Surface() = default;
  Surface(const std::vector<Facet<dim>>& boundary, std::size_t nodes);

  /// Share of a boundary node in the facets around it, m^(dim−1) (m² of revolution).
  double area(BoundaryNodeIndex node, PlacesOnBoundary<dim> position, Space space) const;
  /// The same of those facets alone that face against `normal` within 60 degrees.
  double area_against(BoundaryNodeIndex node, const Vec<dim>& normal, PlacesOnBoundary<dim> position,
                      Space space) const;

private:
  template<class Counts>
  double area_of(BoundaryNodeIndex node, PlacesOnBoundary<dim> position, Space space, Counts&& counts) const;
};

extern template struct Surface<2>;
extern template struct Surface<3>;

/// A ridge that has gone through a facet.
template<int dim> struct RidgeHit {
  std::int32_t ridge = 0;
  FacetIndex facet{};
  std::array<BoundaryNodeIndex, dim> node{}; ///< of the facet; first the ends of an edge that is pressed on
  std::array<double, dim> weight{};          ///< of these nodes
  Vec<dim> normal = Vec<dim>::Zero();        ///< out of the tool
  double gap = 0.0;                          ///< m, < 0, at the end of the step; a chord's sagitta is allowed
  double start = 0.0;                        ///< m, the same at its start
};

/// m, how far the centre of a ridge may be from the first end of a facet that it presses on; size: |x| + |y|
/// of the facet's edge.
inline double ridge_reach(const Ridge<2>& ridge, double size) { return ridge.radius + 1.5 * size; }

/// A ridge in space and what it may meet: an edge, or where the ridge is a point a facet.
struct RidgePair {
  std::int32_t ridge = 0;
  SurfaceEdgeIndex edge = SurfaceEdgeIndex::none;
  FacetIndex facet = FacetIndex::none;
};

/// What of a surface ridges may meet: in the plane facets, each with all ridges.
template<int dim> using RidgeCandidate = std::conditional_t<dim == 2, FacetIndex, RidgePair>;

/// Ridges of a tool against those of the candidates that face them, over one step in which the nodes go
/// start → end and the tool's displacement `shift_start` → `shift_end`. Facets through which the ridge came
/// in this step, or (start < 0) shallowly penetrated ones. At convex nodes of the workpiece only the facet
/// passed last counts.
///
/// In space a ridge crosses edges, between the ends (1 − s, s), along the normal that is common to both
/// lines; seen along the ridge that is the plane's case. Where the line is curved its tangent at the crossing
/// counts. Corners, and balls at tips, meet facets. Edges nearly parallel to a ridge leave it to those that
/// cross it.
template<int dim>
void ridge_hits(const Surface<dim>& surface, std::span<const RidgeCandidate<dim>> candidates,
                const ToolShape<dim>& shape, PlacesOnBoundary<dim> start, PlacesOnBoundary<dim> end,
                const Vec<dim>& shift_start, const Vec<dim>& shift_end, std::vector<RidgeHit<dim>>& hits);

/// The middle of a ridge that is inside the workpiece.
template<int dim> struct RidgeDepth {
  BoundaryNodeIndex node{}; ///< nearest to it
  double depth = 0.0;       ///< m, to the nearest facet, less the chord's sagitta
  Vec<dim> position = Vec<dim>::Zero();
};

template<int dim>
std::vector<RidgeDepth<dim>> ridges_inside(const Surface<dim>& surface, const ToolShape<dim>& shape,
                                           PlacesOnBoundary<dim> position, const Vec<dim>& shift);

/// Is x inside the region that the facets enclose?
bool encloses(const Surface<2>& surface, PlacesOnBoundary<2> position, const Vec2& x);

} // namespace cnem::contact
