#pragma once
// A cell complex in space: the median dual of a mesh of tetrahedra, and the linear functions on it.
#include "core/geometry/cell_complex.hpp"
#include "voronoi/linear_simplices.hpp"

#include <Eigen/LU>

#include <algorithm>

namespace cnem::testing {

using Tetrahedra = std::vector<voronoi::Simplex<3>>;

/// In each tetrahedron the cell of a corner is where its barycentric coordinate is the largest: a quarter of
/// the volume, bounded by quadrilaterals from the middle of each edge over the centroids of its two faces to
/// that of the tetrahedron.
inline CellComplex<3> median_dual(const Cloud<3>& cloud, const Tetrahedra& tetrahedra) {
  using V = Vec<3>;
  // An edge and the two corners beside it, in even order.
  constexpr std::size_t orders[6][4] = {{0, 1, 2, 3}, {0, 2, 3, 1}, {0, 3, 1, 2},
                                        {1, 2, 0, 3}, {1, 3, 2, 0}, {2, 3, 0, 1}};
  CellComplex<3> cells;
  cells.volume.assign(cloud.position.size(), 0.0);
  std::vector<std::array<NodeIndex, 2>> edges;
  for (std::size_t t = 0; t < tetrahedra.size(); ++t) {
    std::array<V, 4> x;
    for (std::size_t k = 0; k < 4; ++k) x[k] = cloud.position[tetrahedra[t][k]];
    for (const NodeIndex i : tetrahedra[t]) cells.volume[index_of(i)] += 0.25 * measure<3>(x);
    const V centre = (x[0] + x[1] + x[2] + x[3]) / 4.0;
    for (const auto& [a, b, c, d] : orders) {
      const V middle = (x[a] + x[b]) / 2.0, one = (x[a] + x[b] + x[c]) / 3.0,
              other = (x[a] + x[b] + x[d]) / 3.0;
      const std::array<NodeIndex, 2> edge{tetrahedra[t][a], tetrahedra[t][b]};
      const auto in = as<SimplexIndex>(t);
      cells.interior.push_back({edge, {in, in}, {middle, one, centre}});
      cells.interior.push_back({edge, {in, in}, {middle, centre, other}});
      edges.push_back({std::min(edge[0], edge[1]), std::max(edge[0], edge[1])});
    }
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  cells.neighbours = other_ends(cloud.position.size(), edges);

  using Place = std::array<double, 2>;
  constexpr Place corner[3] = {{0, 0}, {1, 0}, {0, 1}}, centre{1.0 / 3.0, 1.0 / 3.0};
  const auto between = [](const Place& a, const Place& b) {
    return Place{0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])};
  };
  for (const CloudFacetIndex f : cloud.facets.indices())
    for (std::size_t a = 0; a < 3; ++a) {
      const Place next = between(corner[a], corner[(a + 1) % 3]),
                  last = between(corner[a], corner[(a + 2) % 3]);
      cells.boundary.push_back({cloud.facets[f].node[a], f, {corner[a], next, centre}});
      cells.boundary.push_back({cloud.facets[f].node[a], f, {corner[a], centre, last}});
    }
  return cells;
}

/// Linear functions of the tetrahedra, at points of the faces and of the cells of the median dual.
class LinearFunctions {
public:
  LinearFunctions(const Cloud<3>& cloud, const Tetrahedra& tetrahedra)
      : cloud_(cloud), tetrahedra_(tetrahedra),
        around_(group_by_cell<SimplexIndex>(
            cloud.position.size(),
            tetrahedra.size(), [&](std::size_t t) -> const auto& { return tetrahedra[t]; })) {}

  bool evaluate(const Vec<3>& x, const std::array<SimplexIndex, 2>& simplex) {
    node_ = tetrahedra_[index_of(simplex[0])];
    value_ = barycentric(x, node_);
    return true;
  }
  bool evaluate(const Vec<3>& x, std::size_t cell) {
    double best = -1.0;
    for (const SimplexIndex t : around_.of(cell)) {
      const auto value = barycentric(x, tetrahedra_[index_of(t)]);
      const double least = *std::min_element(value.begin(), value.end());
      if (least <= best) continue;
      best = least;
      node_ = tetrahedra_[index_of(t)];
      value_ = value;
    }
    return best > -1e-9;
  }
  std::span<const NodeIndex> nodes() const { return node_; }
  std::span<const double> values() const { return value_; }

private:
  std::array<double, 4> barycentric(const Vec<3>& x, const voronoi::Simplex<3>& corner) const {
    const Vec<3>& origin = cloud_.position[corner[0]];
    Mat<3> edges;
    for (int k = 0; k < 3; ++k) edges.col(k) = cloud_.position[corner[index_of(k + 1)]] - origin;
    const Vec<3> place = edges.inverse() * (x - origin);
    return {1.0 - place.sum(), place[0], place[1], place[2]};
  }

  const Cloud<3>& cloud_;
  const Tetrahedra& tetrahedra_;
  CellLists<SimplexIndex> around_;
  voronoi::Simplex<3> node_{};
  std::array<double, 4> value_{};
};

} // namespace cnem::testing
