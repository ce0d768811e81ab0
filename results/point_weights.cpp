#include "results/point_weights.hpp"

#include "core/error.hpp"
#include "voronoi/plane/natural_neighbours.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <fmt/format.h>
#include <limits>

namespace cnem::results {

template<> struct PointLocator<2>::Structure {
  voronoi::Triangulation mesh;
  voronoi::Circumcircles circles;
  voronoi::NaturalNeighbours functions;

  explicit Structure(const Cloud<2>& cloud)
      : mesh(voronoi::triangulate(cloud)), circles(voronoi::circumcircles(cloud, mesh)),
        functions(cloud, mesh, circles) {}
};

template<> struct PointLocator<3>::Structure {
  const CellGeometry<3>& cells;

  explicit Structure(const CellGeometry<3>& of) : cells(of) {}
};

template<>
PointLocator<2>::PointLocator(const Cloud<2>& cloud, const CellGeometry<2>&)
    : cloud_(cloud), structure_(std::make_unique<Structure>(cloud)) {}

template<>
PointLocator<3>::PointLocator(const Cloud<3>& cloud, const CellGeometry<3>& cells)
    : cloud_(cloud), structure_(std::make_unique<Structure>(cells)) {}

template<int dim> PointLocator<dim>::~PointLocator() = default;

template<> PointWeights PointLocator<2>::weights(const Vec2& x) const {
  voronoi::NaturalNeighbours& functions = structure_->functions;
  functions.evaluate(voronoi::Functions::sibson, x);
  return {{functions.nodes().begin(), functions.nodes().end()},
          {functions.values().begin(), functions.values().end()}};
}

template<> PointWeights PointLocator<3>::weights(const Vec3& x) const {
  constexpr double outside = -0.05;
  const CellGeometry<3>& cells = structure_->cells;
  // weights above `outside` that sum to 1 lead out of the box of the corners by a share of it
  constexpr double beyond = -4.0 * outside;
  const auto near = [&](const std::array<NodeIndex, 4>& corner) {
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      double low = cloud_.position[corner[0]][axis], high = low;
      for (std::size_t k = 1; k < 4; ++k) {
        low = std::min(low, cloud_.position[corner[k]][axis]);
        high = std::max(high, cloud_.position[corner[k]][axis]);
      }
      const double margin = beyond * (high - low);
      if (x[axis] < low - margin || x[axis] > high + margin) return false;
    }
    return true;
  };
  PointWeights best{std::vector<NodeIndex>(4), std::vector<double>(4)};
  double depth = -std::numeric_limits<double>::infinity();
  for (std::size_t c = 0; c + 1 < cells.begin.size(); ++c) {
    std::array<NodeIndex, 4> corner;
    for (std::size_t k = 0; k < 4; ++k)
      corner[k] = cells.vertex_node[index_of(cells.index[index_of(cells.begin[c]) + k])];
    if (!near(corner)) continue;
    const Vec3& first = cloud_.position[corner[0]];
    Mat<3> edges;
    for (std::size_t k = 1; k < 4; ++k)
      edges.col(static_cast<Eigen::Index>(k) - 1) = cloud_.position[corner[k]] - first;
    const Vec3 share = edges.inverse() * (x - first);
    const double least = std::min(share.minCoeff(), 1.0 - share.sum());
    if (!(least > depth)) continue;
    depth = least;
    best.node.assign(corner.begin(), corner.end());
    best.weight = {1.0 - share.sum(), share.x(), share.y(), share.z()};
  }
  if (!(depth >= outside))
    throw GeometryError(
        fmt::format("the point ({:g}, {:g}, {:g}) m lies outside of the cloud", x.x(), x.y(), x.z()));
  return best;
}

template<int dim> PointWeights PointLocator<dim>::nearest_node(const Vec<dim>& x) const {
  std::size_t nearest = 0;
  for (std::size_t i = 1; i < cloud_.position.size(); ++i)
    if ((cloud_.position[i] - x).squaredNorm() < (cloud_.position[nearest] - x).squaredNorm()) nearest = i;
  return {{as<NodeIndex>(nearest)}, {1.0}};
}

template<int dim>
void follow(const Resampling<dim>& change, const PointLocator<dim>& locator, PointWeights& point) {
  Vec<dim> at = Vec<dim>::Zero();
  for (std::size_t k = 0; k < point.node.size(); ++k)
    at += point.weight[k] * change.old_position[index_of(point.node[k])];
  try {
    point = locator.weights(at);
  } catch (const GeometryError&) { point = locator.nearest_node(at); }
}

template void follow(const Resampling<2>&, const PointLocator<2>&, PointWeights&);
template void follow(const Resampling<3>&, const PointLocator<3>&, PointWeights&);
template class PointLocator<2>;
template class PointLocator<3>;

} // namespace cnem::results
