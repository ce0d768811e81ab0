#pragma once
// Measures of the facets of a boundary: edges in the plane, triangles in space.
#include "core/fields/aligned.hpp"
#include "core/geometry/cloud.hpp"
#include "core/geometry/revolution.hpp"
#include "core/index.hpp"

#include <Eigen/Geometry>

namespace cnem {

/// The corners of a facet, m; positions [component][node] or by node.
template<int dim> std::array<Vec<dim>, dim> corners_of(const Facet<dim>& facet, const Fields<dim>& position) {
  std::array<Vec<dim>, dim> corner;
  for (std::size_t a = 0; a < dim; ++a)
    for (std::size_t k = 0; k < dim; ++k)
      corner[a][static_cast<Eigen::Index>(k)] = position[k][index_of(facet.node[a])];
  return corner;
}

template<int dim>
std::array<Vec<dim>, dim> corners_of(const Facet<dim>& facet,
                                     const IndexedVector<NodeIndex, Vec<dim>>& position) {
  std::array<Vec<dim>, dim> corner;
  for (std::size_t a = 0; a < dim; ++a) corner[a] = position[facet.node[a]];
  return corner;
}

/// x_0 + Σ_k t_k (x_(k+1) − x_0), m: the point with the coordinates t (–) of a facet.
template<int dim>
Vec<dim> point_on(const std::array<Vec<dim>, dim>& corner, const std::array<double, dim - 1>& place) {
  Vec<dim> x = corner[0];
  for (std::size_t k = 0; k + 1 < dim; ++k) x += place[k] * (corner[k + 1] - corner[0]);
  return x;
}

/// Normal out of the domain, its length the area of the facet in m^(dim−1) (in the plane per unit thickness).
template<int dim> Vec<dim> area_normal(const std::array<Vec<dim>, dim>& corner) {
  if constexpr (dim == 2)
    return right_normal(corner[1] - corner[0]);
  else
    return 0.5 * (corner[1] - corner[0]).cross(corner[2] - corner[0]);
}

/// Area (m²) or volume (m³) of a simplex; positive for corners that stand as in voronoi::Simplex.
template<int dim> double measure(const std::array<Vec<dim>, dim + 1>& x) {
  if constexpr (dim == 2)
    return 0.5 * cross(x[1] - x[0], x[2] - x[0]);
  else
    return (x[1] - x[0]).cross(x[2] - x[0]).dot(x[3] - x[0]) / 6.0;
}

/// Where no other node should be for a triangle to be a face of Delaunay tetrahedra: the smallest ball with
/// its corners on it. Of a sliver, whose ball would be wider than twice its longest side, the ball over that
/// side, which holds it: else a body would be emptied by one facet.
struct DiametralBall {
  Vec<3> centre; ///< m
  double radius; ///< m
};
inline DiametralBall diametral_ball(const std::array<Vec<3>, 3>& corner) {
  const Vec<3> u = corner[1] - corner[0], v = corner[2] - corner[0], n = u.cross(v);
  const Vec<3> to = (u.squaredNorm() * v.cross(n) + v.squaredNorm() * n.cross(u)) / (2.0 * n.squaredNorm());
  double longest = 0.0;
  Vec<3> middle = corner[0];
  for (std::size_t k = 0; k < 3; ++k)
    if (const double side = (corner[(k + 1) % 3] - corner[k]).norm(); side > longest) {
      longest = side;
      middle = 0.5 * (corner[k] + corner[(k + 1) % 3]);
    }
  if (!(to.norm() <= longest)) return {middle, 0.5 * longest};
  return {corner[0] + to, to.norm()};
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
