#pragma once
// Measures of the facets of a boundary: edges in the plane, triangles in space.
#include "core/aligned.hpp"
#include "core/cloud.hpp"
#include "core/index.hpp"
#include "core/revolution.hpp"

#include <Eigen/Geometry>

namespace cnem {

/// The corners of a facet, m; positions [component][node].
template<int dim> std::array<Vec<dim>, dim> corners_of(const Facet<dim>& facet, const Fields<dim>& position) {
  std::array<Vec<dim>, dim> corner;
  for (std::size_t a = 0; a < dim; ++a)
    for (std::size_t k = 0; k < dim; ++k)
      corner[a][static_cast<Eigen::Index>(k)] = position[k][index_of(facet.node[a])];
  return corner;
}

/// Normal out of the domain, its length the area of the facet in m^(dim−1) (in the plane per unit thickness).
template<int dim> Vec<dim> area_normal(const std::array<Vec<dim>, dim>& corner) {
  if constexpr (dim == 2)
    return right_normal(corner[1] - corner[0]);
  else
    return 0.5 * (corner[1] - corner[0]).cross(corner[2] - corner[0]);
}

/// Shares ∫ φ dΓ of the corners in the area, φ linear on the facet; of revolution m².
template<int dim> std::array<double, dim> corner_areas(Space space, const std::array<Vec<dim>, dim>& corner) {
  if constexpr (dim == 2) {
    return end_areas(space, corner[0], corner[1]);
  } else {
    const double third = area_normal<dim>(corner).norm() / 3.0;
    return {third, third, third};
  }
}

} // namespace cnem
