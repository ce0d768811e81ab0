#pragma once
// The boundary of the workpiece as contact sees it, and where ridges of tools press on its facets.
#include "contact/tool_shape.hpp"
#include "core/geometry/cloud.hpp"
#include "core/geometry/revolution.hpp"

#include <array>
#include <span>
#include <vector>

namespace cnem::contact {

/// Facets on a list of boundary nodes numbered from 0.
template<int dim> struct Surface {
  std::vector<std::int32_t> node;                    ///< [boundary node] node of the cloud, increasing
  std::vector<std::array<std::int32_t, dim>> facets; ///< boundary nodes
  std::vector<std::int32_t> leaving, entering;       ///< 2D: [boundary node] facet, −1 where there is none
  std::vector<std::vector<std::int32_t>> around;     ///< 3D: [boundary node] facets

  Surface() = default;
  Surface(const std::vector<Facet<dim>>& boundary, std::size_t nodes);

  /// [boundary node] share of the facets around it, m^(dim−1) (m² of revolution).
  std::vector<double> areas(std::span<const Vec<dim>> position, Space space) const;
  /// The same of one boundary node, of those facets alone that face against `normal` within 60 degrees.
  double area_against(std::size_t node, const Vec<dim>& normal, std::span<const Vec<dim>> position,
                      Space space) const;
};

extern template struct Surface<2>;
extern template struct Surface<3>;

/// A ridge that has gone through a facet.
template<int dim> struct RidgeHit {
  std::int32_t ridge = 0;
  std::int32_t facet = 0;
  std::array<double, dim> weight{};   ///< of the facet's nodes
  Vec<dim> normal = Vec<dim>::Zero(); ///< out of the tool
  double gap = 0.0;                   ///< m, < 0, at the end of the step; a chord's sagitta is allowed
  double start = 0.0;                 ///< m, the same at its start
};

/// Ridges of a tool against facets of the surface that face them, over one step in which the nodes go
/// start → end and the tool's displacement `shift_start` → `shift_end`. Facets through which the ridge came
/// in this step, or (start < 0) shallowly penetrated ones. At convex nodes of the workpiece only the facet
/// passed last counts. Tools in space have no ridges yet (contact/tool_shape.hpp).
template<int dim>
void ridge_hits(const Surface<dim>& surface, const ToolShape<dim>& shape, std::span<const Vec<dim>> start,
                std::span<const Vec<dim>> end, const Vec<dim>& shift_start, const Vec<dim>& shift_end,
                std::vector<RidgeHit<dim>>& hits);

/// The middle of a ridge that is inside the workpiece.
template<int dim> struct RidgeDepth {
  std::int32_t node = 0; ///< boundary node nearest to it
  double depth = 0.0;    ///< m, to the nearest facet, less the chord's sagitta
  Vec<dim> position = Vec<dim>::Zero();
};

template<int dim>
std::vector<RidgeDepth<dim>> ridges_inside(const Surface<dim>& surface, const ToolShape<dim>& shape,
                                           std::span<const Vec<dim>> position, const Vec<dim>& shift);

/// Is x inside the region that the facets enclose?
bool encloses(const Surface<2>& surface, std::span<const Vec2> position, const Vec2& x);

} // namespace cnem::contact
