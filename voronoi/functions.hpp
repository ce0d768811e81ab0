#pragma once
// The shape functions that a Delaunay triangulation gives (paper 004, (66)-(69), (71)).

namespace cnem::voronoi {

/// Sibson: ratios of stolen areas or volumes, C¹ but at nodes. Laplace (non-Sibson): ratios of facet to
/// distance, C⁰. Linear: those of the Delaunay simplex, with the same properties but fewer neighbours.
enum class Functions { sibson, laplace, linear };

} // namespace cnem::voronoi
