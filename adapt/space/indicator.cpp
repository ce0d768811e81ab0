#include "adapt/space/indicator.hpp"

#include "voronoi/space/median_cells.hpp"
#include "voronoi/space/natural_neighbours.hpp"
#include "voronoi/space/voronoi_cells.hpp"

#include <Eigen/LU>
#include <algorithm>

namespace cnem::adapt {
namespace {

/// The linear functions of the tetrahedra at points of median cells.
class Linear {
public:
  Linear(const Cloud<3>& cloud, const SpaceStructure& structure) : cloud_(cloud), structure_(structure) {}

  bool evaluate(const Vec3& x, const InnerFace<3>& face) {
    return take(x, structure_.mesh.node[face.simplex[0]]), true;
  }
  bool evaluate(const Vec3& x, std::size_t cell) {
    double best = -1.0;
    std::array<double, 4> value{};
    std::array<NodeIndex, 4> node{};
    for (const SimplexIndex t : structure_.tetrahedra.of(cell)) {
      take(x, structure_.mesh.node[t]);
      const double least = *std::min_element(value_.begin(), value_.end());
      if (least <= best) continue;
      best = least;
      value = value_;
      node = node_;
    }
    value_ = value;
    node_ = node;
    constexpr double outside = -1e-6; // a point of the boundary, to rounding in flat tetrahedra
    return best > outside;
  }
  std::span<const NodeIndex> nodes() const { return node_; }
  std::span<const double> values() const { return value_; }

private:
  void take(const Vec3& x, const std::array<NodeIndex, 4>& node) {
    const Vec3& origin = cloud_.position[node[0]];
    Mat<3> edges;
    for (int k = 0; k < 3; ++k) edges.col(k) = cloud_.position[node[index_of(k + 1)]] - origin;
    const Vec3 place = edges.inverse() * (x - origin);
    node_ = node;
    value_ = {1.0 - place.sum(), place[0], place[1], place[2]};
  }

  const Cloud<3>& cloud_;
  const SpaceStructure& structure_;
  std::array<NodeIndex, 4> node_{};
  std::array<double, 4> value_{};
};

/// Sibson's functions at points of Voronoi cells.
struct Sibson {
  const voronoi::Tetrahedra& mesh;
  voronoi::NaturalNeighbours3 functions;

  bool evaluate(const Vec3& x, const InnerFace<3>& face) {
    for (const SimplexIndex hint : face.simplex)
      if (exists(hint)) return functions.evaluate(voronoi::Functions::sibson, x, hint), true;
    return false;
  }
  bool evaluate(const Vec3& x, std::size_t cell) {
    return functions.evaluate(voronoi::Functions::sibson, x, mesh.of_node[cell]), true;
  }
  std::span<const NodeIndex> nodes() const { return functions.nodes(); }
  std::span<const double> values() const { return functions.values(); }
};

} // namespace

Indicator indicator(const Cloud<3>& cloud, const SpaceStructure& structure, scni::CellKind cells,
                    const Field& value) {
  const voronoi::Tetrahedra& mesh = structure.mesh;
  if (cells == scni::CellKind::median)
    return indicator<3>(cloud, voronoi::median_cells(cloud, mesh.node), value,
                        [&] { return Linear(cloud, structure); });
  const voronoi::Circumspheres spheres = voronoi::circumspheres(cloud, mesh);
  const voronoi::FunctionMesh functions(cloud, mesh, spheres);
  return indicator<3>(cloud, voronoi::cell_complex(cloud, mesh, voronoi::voronoi_cells(cloud, mesh, spheres)),
                      value, [&] {
                        return Sibson{mesh, voronoi::NaturalNeighbours3(cloud, mesh, functions)};
                      });
}

} // namespace cnem::adapt
