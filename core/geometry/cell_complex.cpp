#include "core/geometry/cell_complex.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace cnem {

namespace {

/// ∮ ½ (ρ_x² n_x, ρ_y² n_y) ds over a segment, ρ from `origin`, n ds the right normal of the segment: its
/// share of the first moments of area.
Vec2 first_moment(const Vec2& origin, const std::array<Vec2, 2>& end) {
  const Vec2 a = end[0] - origin, b = end[1] - origin;
  const Vec2 mean_square = (a.cwiseProduct(a) + a.cwiseProduct(b) + b.cwiseProduct(b)) / 3.0;
  return 0.5 * mean_square.cwiseProduct(right_normal(end[1] - end[0]));
}

} // namespace

template<int dim> std::array<double, dim> BoundaryPart<dim>::shares() const {
  std::array<double, dim> share;
  double area = 0.0; // over that of the facet
  if constexpr (dim == 2)
    area = place[1][0] - place[0][0];
  else
    area = (place[1][0] - place[0][0]) * (place[2][1] - place[0][1]) -
           (place[1][1] - place[0][1]) * (place[2][0] - place[0][0]);
  double rest = 1.0;
  for (std::size_t k = 0; k + 1 < dim; ++k) {
    double mean = place[0][k];
    for (std::size_t a = 1; a < dim; ++a) mean += place[a][k];
    mean /= dim;
    share[k + 1] = mean * area;
    rest -= mean;
  }
  share[0] = rest * area;
  return share;
}

template<> std::span<const FacePoint<2>> face_rule<2>(int points) {
  static constexpr FacePoint<2> one[]{{{0.5}, 1.0}};
  static constexpr FacePoint<2> two[]{{{0.21132486540518712}, 0.5}, {{0.78867513459481288}, 0.5}};
  static constexpr FacePoint<2> three[]{
      {{0.11270166537925831}, 5.0 / 18.0}, {{0.5}, 8.0 / 18.0}, {{0.88729833462074169}, 5.0 / 18.0}};
  assert(points >= 1 && points <= 3);
  if (points == 1) return one;
  if (points == 2) return two;
  return three;
}

template<> std::span<const FacePoint<3>> face_rule<3>(int points) {
  constexpr double third = 1.0 / 3.0, sixth = 1.0 / 6.0;
  static constexpr FacePoint<3> one[]{{{third, third}, 1.0}};
  static constexpr FacePoint<3> three[]{
      {{sixth, sixth}, third}, {{2.0 * third, sixth}, third}, {{sixth, 2.0 * third}, third}};
  assert(points >= 1 && points <= 3);
  if (points == 1) return one;
  return three;
}

CellLists<NodeIndex> other_ends(std::size_t cells, std::span<const std::array<NodeIndex, 2>> edges) {
  CellLists<NodeIndex> lists = group_by_cell(
      cells, edges.size(), [&](std::size_t e) -> const auto& { return edges[e]; },
      [&](std::size_t e, NodeIndex i) { return edges[e][edges[e][0] == i ? 1 : 0]; });
#pragma omp parallel for schedule(static)
  for (std::size_t i = 0; i < cells; ++i)
    std::sort(lists.item.begin() + lists.begin[i], lists.item.begin() + lists.begin[i + 1]);
  return lists;
}

std::vector<Vec2> centroids(const Cloud<2>& cloud, const CellComplex<2>& cells) {
  std::vector<Vec2> moment(cloud.position.size(), Vec2::Zero());
  for (const InnerFace<2>& face : cells.interior) {
    const std::size_t i = index_of(face.cell[0]), j = index_of(face.cell[1]);
    moment[i] += first_moment(cloud.position[i], face.corner);
    moment[j] -= first_moment(cloud.position[j], face.corner);
  }
  for (const BoundaryPart<2>& part : cells.boundary) {
    const std::size_t i = index_of(part.cell);
    moment[i] +=
        first_moment(cloud.position[i], part.on(corners_of<2>(cloud.facets[part.facet], cloud.position)));
  }
  for (std::size_t i = 0; i < moment.size(); ++i) moment[i] = cloud.position[i] + moment[i] / cells.volume[i];
  return moment;
}

template<int dim> bool is_closed(const Cloud<dim>& cloud, const CellComplex<dim>& complex) {
  struct Sums {
    Vec<dim> normal = Vec<dim>::Zero();
    double volume = 0.0, size = 0.0, reach = 0.0; ///< m: largest coordinate, largest distance to the node
  };
  IndexedVector<NodeIndex, Sums> sums(complex.cells());
  const auto add = [&](NodeIndex cell, const std::array<Vec<dim>, dim>& corner, double sign) {
    Sums& sum = sums[cell];
    const Vec<dim>& node = cloud.position[cell];
    const Vec<dim> normal = sign * area_normal<dim>(corner);
    sum.normal += normal;
    sum.volume += normal.dot(corner[0] - node) / dim;
    for (const Vec<dim>& x : corner) {
      sum.size = std::max(sum.size, x.cwiseAbs().maxCoeff());
      sum.reach = std::max(sum.reach, (x - node).norm());
    }
  };
  for (const InnerFace<dim>& face : complex.interior) {
    add(face.cell[0], face.corner, 1.0);
    add(face.cell[1], face.corner, -1.0);
  }
  for (const BoundaryPart<dim>& part : complex.boundary)
    add(part.cell, part.on(corners_of<dim>(cloud.facets[part.facet], cloud.position)), 1.0);
  for (std::size_t i = 0; i < sums.size(); ++i) {
    const double rounding = 1e-13 * std::pow(sums[i].reach, dim - 2) * sums[i].size;
    if (!(sums[i].normal.norm() <= rounding)) return false;
    if (!(std::abs(sums[i].volume - complex.volume[i]) <= rounding * sums[i].reach)) return false;
  }
  return true;
}

template struct BoundaryPart<2>;
template struct BoundaryPart<3>;
template bool is_closed(const Cloud<2>&, const CellComplex<2>&);
template bool is_closed(const Cloud<3>&, const CellComplex<3>&);

} // namespace cnem
