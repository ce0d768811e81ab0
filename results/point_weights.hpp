#pragma once
// Material points between nodes, for probes and lines.
#include "core/geometry/cloud.hpp"
#include "core/operators/discretisation.hpp"
#include "core/operators/resampling.hpp"

#include <cstdint>
#include <memory>
#include <vector>

namespace cnem::results {

/// A point as a weighted mean of nodes; weights sum to 1 and reproduce its position.
struct PointWeights {
  std::vector<NodeIndex> node;
  std::vector<double> weight; ///< –
};

/// Finds the weights of points in a cloud: Sibson's in the plane, linear ones in the tetrahedra of space.
/// Keeps references to cloud and cells.
template<int dim> class PointLocator {
public:
  /// cells: used in space alone.
  PointLocator(const Cloud<dim>& cloud, const CellGeometry<dim>& cells);
  ~PointLocator();

  /// x: m. Throws GeometryError for a point outside. In space points outside by less than a twentieth of the
  /// tetrahedron belong to it: flat faces stand for a round side.
  PointWeights weights(const Vec<dim>& x) const;
  PointWeights nearest_node(const Vec<dim>& x) const;

private:
  struct Structure; ///< what is searched
  const Cloud<dim>& cloud_;
  std::unique_ptr<Structure> structure_;
};

/// Keeps a point where it is in the matter of a changed cloud, which `locator` knows; when it was cut off
/// with a corner of the boundary, the nearest node goes on for it.
template<int dim>
void follow(const Resampling<dim>& change, const PointLocator<dim>& locator, PointWeights& point);

} // namespace cnem::results
