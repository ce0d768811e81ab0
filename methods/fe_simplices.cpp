#include "methods/fe_simplices.hpp"

#include "core/error.hpp"
#include "voronoi/plane/overlaps.hpp"
#include "voronoi/plane/triangulation.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <span>

namespace cnem::methods {
namespace {

/// The triangles whose rows these are.
std::vector<voronoi::Simplex<2>> triangles_of(const DiscreteOperators<2>& op) {
  std::vector<voronoi::Simplex<2>> triangles(index_of(op.points));
  for (std::size_t t = 0; t < triangles.size(); ++t)
    std::copy_n(op.node.begin() + op.row_begin[t], 3, triangles[t].begin());
  return triangles;
}

} // namespace

template<int dim>
FeSimplices<dim>::FeSimplices(std::vector<voronoi::Simplex<dim>> simplices) requires(dim == 3)
    : simplices_(std::move(simplices)) {
  if (simplices_.empty()) throw InputError("found no tetrahedra, expected a mesh that tiles the domain");
}

template<int dim> Approximation<dim> FeSimplices<dim>::rebuild(const Cloud<dim>& cloud) {
  std::vector<voronoi::Simplex<dim>> triangles;
  if constexpr (dim == 2) triangles = voronoi::triangulate(cloud).node;
  const std::span<const voronoi::Simplex<dim>> simplices = dim == 2 ? triangles : simplices_;
  Approximation<dim> result;
  result.mechanics = voronoi::linear_simplices<dim>(cloud, simplices, space_);
  result.conduction = result.mechanics;
  if constexpr (dim == 3) voronoi::keep_pattern(result.conduction);
  result.node_volume = result.mechanics.node_volume();
  for (std::size_t i = 0; i < result.node_volume.size(); ++i)
    if (!(result.node_volume[i] > 0.0))
      throw GeometryError(fmt::format("the node at ({:g}) m belongs to no {}",
                                      fmt::join(cloud.position[i].begin(), cloud.position[i].end(), ", "),
                                      dim == 2 ? "triangle" : "tetrahedron"));
  result.links.begin.assign(cloud.position.size() + 1, 0);
  result.cells = voronoi::simplex_geometry<dim>(cloud, simplices);
  return result;
}

template<int dim>
std::optional<PointRows> FeSimplices<dim>::point_parcels(const DiscreteOperators<dim>& old,
                                                         const DiscreteOperators<dim>& now,
                                                         const Cloud<dim>& cloud) const {
  if constexpr (dim == 2) {
    auto parts = voronoi::overlaps(cloud.position, triangles_of(old), triangles_of(now), space_);
    PointRows rows{std::move(parts.begin), {}, std::move(parts.weight)};
    rows.from.reserve(parts.from.size());
    for (const SimplexIndex t : parts.from) rows.from.push_back(as<PointIndex>(index_of(t)));
    return rows;
  } else {
    return Discretisation<dim>::point_parcels(old, now, cloud); // the mesh stays: there is no better one
  }
}

template class FeSimplices<2>;
template class FeSimplices<3>;

} // namespace cnem::methods
