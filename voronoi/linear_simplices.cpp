#include "voronoi/linear_simplices.hpp"

#include "core/error.hpp"
#include "core/geometry/facets.hpp"
#include "core/index.hpp"
#include "core/operators/leading_simplices.hpp"
#include "core/operators/operator_checks.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <numbers>
#include <numeric>

namespace cnem::voronoi {
namespace {

template<int dim> using Corners = std::array<Vec<dim>, dim + 1>;

template<int dim> [[noreturn]] void throw_flat(const Cloud<dim>& cloud, const Simplex<dim>& simplex) {
  std::string places;
  for (const NodeIndex i : simplex) {
    const Vec<dim>& x = cloud.position[i];
    places += fmt::format(" ({:g})", fmt::join(x.begin(), x.end(), ", "));
  }
  if constexpr (dim == 2)
    throw GeometryError(
        fmt::format("the Delaunay triangle{} has no area: the nodes on this part of the boundary "
                    "have to leave room for a node or an edge across it",
                    places));
  else
    throw GeometryError(fmt::format("the tetrahedron{} has no volume", places));
}

/// Starts at the lowest node without turning the simplex over, so that the result does not depend on where
/// the list of corners begins.
template<int dim> Simplex<dim> from_lowest(Simplex<dim> corner) {
  const auto lowest = std::min_element(corner.begin(), corner.end());
  if constexpr (dim == 2) {
    std::rotate(corner.begin(), lowest, corner.end());
  } else if (lowest != corner.begin()) {
    std::iter_swap(corner.begin(), lowest);
    // one exchange has turned it over, another one turns it back
    const auto other = index_of(lowest - corner.begin());
    std::swap(corner[other % 3 + 1], corner[(other + 1) % 3 + 1]);
  }
  return corner;
}

/// Corners of the facet opposite to corner k, whose area normal points out of the simplex.
template<int dim> std::array<Vec<dim>, dim> opposite(const Corners<dim>& x, std::size_t k) {
  if constexpr (dim == 2) {
    return {x[(k + 1) % 3], x[(k + 2) % 3]};
  } else {
    constexpr std::size_t outwards[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
    return {x[outwards[k][0]], x[outwards[k][1]], x[outwards[k][2]]};
  }
}

} // namespace

template<int dim>
DiscreteOperators<dim> linear_simplices(const Cloud<dim>& cloud, std::span<const Simplex<dim>> simplices,
                                        Space space) {
  constexpr std::size_t corners = dim + 1;
  const std::size_t count = simplices.size();
  assert(space == Space::plane || dim == 2);
  DiscreteOperators<dim> op;
  op.points = static_cast<int>(count);
  op.nodes = cloud.nodes();
  op.volume.resize(count);
  op.row_begin.resize(count + 1);
  op.node.resize(corners * count);
  for (Field& f : op.gradient) f.resize(corners * count);
  op.value.assign(corners * count, 1.0 / static_cast<double>(corners));
  op.row_begin[count] = static_cast<std::int32_t>(corners * count);

#pragma omp parallel for schedule(static)
  for (std::size_t t = 0; t < count; ++t) {
    const Simplex<dim> corner = from_lowest<dim>(simplices[t]);
    Corners<dim> x;
    for (std::size_t k = 0; k < corners; ++k) x[k] = cloud.position[corner[k]];
    op.volume[t] = measure<dim>(x);
    op.row_begin[t] = static_cast<std::int32_t>(corners * t);
    for (std::size_t k = 0; k < corners; ++k) {
      const Vec<dim> b = -area_normal<dim>(opposite<dim>(x, k)) / (dim * op.volume[t]);
      const auto place =
          index_of(std::count_if(corner.begin(), corner.end(), [&](NodeIndex i) { return i < corner[k]; }));
      const std::size_t e = corners * t + place;
      op.node[e] = corner[k];
      for (std::size_t c = 0; c < dim; ++c) op.gradient[c][e] = b[static_cast<Eigen::Index>(c)];
    }
  }
  for (std::size_t t = 0; t < count; ++t)
    if (!(op.volume[t] > 0.0)) throw_flat<dim>(cloud, simplices[t]);

  if (space == Space::revolution) {
    op.radius.resize(count);
    op.hoop.resize(corners * count);
    for (std::size_t t = 0; t < count; ++t) {
      double sum = 0.0;
      for (const NodeIndex i : simplices[t]) sum += cloud.position[i].x();
      op.radius[t] = sum / 3.0;
      op.volume[t] *= 2.0 * std::numbers::pi * op.radius[t];
      for (std::size_t e = corners * t; e < corners * (t + 1); ++e) op.hoop[e] = op.value[e] / op.radius[t];
    }
  }
  op.build_transpose();
  assert(rows_are_complete(op) && reproduces_linear_fields(op, cloud.position));
  return op;
}

void keep_pattern(DiscreteOperators<3>& op) {
  assert(!op.nodal && !op.of_revolution());
  for (Field* field : {&op.value, &op.weighted_value}) *field = Field();
  op.weighted_gradient = Fields<3>();
  op.point = std::vector<PointIndex>();
  const auto unread = static_cast<std::ptrdiff_t>(4 * leading_simplices(op));
  for (Field& gradient : op.gradient) gradient = Field(gradient.begin() + unread, gradient.end());
  op.node.shrink_to_fit();
}

template<int dim>
CellGeometry<dim> simplex_geometry(const Cloud<dim>& cloud, std::span<const Simplex<dim>> simplices) {
  CellGeometry<dim> cells;
  cells.vertex = cloud.position;
  cells.begin.reserve(simplices.size() + 1);
  cells.index.reserve((dim + 1) * simplices.size());
  cells.begin.push_back(0);
  for (const auto& corner : simplices) {
    for (const NodeIndex i : corner) cells.index.push_back(as<std::int32_t>(i));
    cells.begin.push_back(static_cast<std::int32_t>(cells.index.size()));
  }
  cells.vertex_begin.resize(cloud.position.size() + 1);
  std::iota(cells.vertex_begin.begin(), cells.vertex_begin.end(), 0);
  cells.vertex_node.reserve(cloud.position.size());
  for (const NodeIndex i : cloud.position.indices()) cells.vertex_node.push_back(i);
  cells.vertex_weight.assign(cloud.position.size(), 1.0);
  return cells;
}

template CellGeometry<2> simplex_geometry(const Cloud<2>&, std::span<const Simplex<2>>);
template CellGeometry<3> simplex_geometry(const Cloud<3>&, std::span<const Simplex<3>>);
template DiscreteOperators<2> linear_simplices(const Cloud<2>&, std::span<const Simplex<2>>, Space);
template DiscreteOperators<3> linear_simplices(const Cloud<3>&, std::span<const Simplex<3>>, Space);

} // namespace cnem::voronoi
