#pragma once
// Linear functions of a mesh of tetrahedra, where faces and cells of its median dual ask for them.
#include "voronoi/space/median_cells.hpp"

#include <Eigen/LU>

#include <algorithm>

namespace cnem::testing {

using Tetrahedra = std::vector<voronoi::Simplex<3>>;

/// Linear functions of the tetrahedra, at points of the faces and of the cells of the median dual.
class LinearFunctions {
public:
  LinearFunctions(const Cloud<3>& cloud, const Tetrahedra& tetrahedra)
      : cloud_(cloud), tetrahedra_(tetrahedra),
        around_(group_by_cell<SimplexIndex>(
            cloud.position.size(),
            tetrahedra.size(), [&](std::size_t t) -> const auto& { return tetrahedra[t]; })) {}

  bool evaluate(const Vec<3>& x, const InnerFace<3>& face) {
    node_ = tetrahedra_[index_of(face.simplex[0])];
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
