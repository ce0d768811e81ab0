// Cells as polyhedra: they close, fill the body, and are those of the operators.
#include "results/polyhedra.hpp"

#include "clouds/tetrahedral_block.hpp"
#include "cnem/space.hpp"
#include "core/index.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <gtest/gtest.h>
#include <map>

namespace cnem::results {
namespace {

struct Block {
  clouds::TetrahedralBlock made = clouds::tetrahedral_block({2, 1, 1}, {4, 3, 3});
  Fields<3> moved;

  /// Inner nodes a little out of line, so that nothing is regular.
  Block() {
    auto& position = made.cloud.position;
    resize_all(moved, position.size());
    for (const NodeIndex i : position.indices()) {
      Vec3& x = position[i];
      const Vec3 room(x.x() * (2 - x.x()), x.y() * (1 - x.y()), x.z() * (1 - x.z()));
      const auto n = static_cast<double>(index_of(i));
      x += 0.15 * Vec3(room.x() * std::sin(3 * n), room.y() * std::sin(5 * n), room.z() * std::sin(7 * n));
      const Vec3 to(x.x() + 0.3 * x.y(), x.y() * (1 + 0.2 * x.x()), x.z() - 0.1 * x.x() * x.z());
      for (std::size_t k = 0; k < 3; ++k) moved[k][index_of(i)] = to[static_cast<Eigen::Index>(k)];
    }
  }
  Fields<3> reference() const {
    Fields<3> fields;
    for (const Vec3& x : made.cloud.position)
      for (std::size_t k = 0; k < 3; ++k) fields[k].push_back(x[static_cast<Eigen::Index>(k)]);
    return fields;
  }
  double volume(const Fields<3>& at) const {
    return enclosed_measure<3>(made.cloud.facets, [&](NodeIndex i) {
      return Vec3(at[0][index_of(i)], at[1][index_of(i)], at[2][index_of(i)]);
    });
  }
};

TEST(Polyhedra, fill_the_body_before_and_after_it_has_moved) {
  const Block block;
  for (const PolyhedraOf kind : {PolyhedraOf::median_cells, PolyhedraOf::voronoi_cells})
    for (const Fields<3>& at : {block.reference(), block.moved}) {
      const Polyhedra cells = polyhedra(kind, block.made.cloud, block.made.tetrahedra, at);
      double sum = 0.0;
      for (std::size_t c = 0; c < cells.cell.size(); ++c) {
        EXPECT_GT(cells.volume(c), 0.0);
        sum += cells.volume(c);
      }
      EXPECT_NEAR(sum / block.volume(at), 1.0, 1e-12);
    }
}

TEST(Polyhedra, have_the_volumes_of_the_operators_and_close) {
  const Block block;
  for (const PolyhedraOf kind : {PolyhedraOf::median_cells, PolyhedraOf::voronoi_cells}) {
    scni::SpaceOptions options;
    options.cells = kind == PolyhedraOf::median_cells ? scni::CellKind::median : scni::CellKind::voronoi;
    options.tetrahedra = block.made.tetrahedra;
    const Approximation<3> approximation = scni::CnemInSpace(options).rebuild(block.made.cloud);
    const Polyhedra cells = polyhedra(kind, block.made.cloud, block.made.tetrahedra, block.reference());
    for (std::size_t c = 0; c < cells.cell.size(); ++c) {
      EXPECT_NEAR(cells.volume(c) / approximation.node_volume[c], 1.0, 1e-9) << c;
      std::map<std::pair<std::int32_t, std::int32_t>, int> edges; // every edge once each way
      for (const std::int32_t f : cells.cell[c]) {
        const auto face = cells.face(index_of(f < 0 ? -1 - f : f));
        for (std::size_t k = 0; k < face.size(); ++k) {
          const std::int32_t a = face[k], b = face[(k + 1) % face.size()];
          ++(f < 0 ? edges[{b, a}] : edges[{a, b}]);
        }
      }
      for (const auto& [edge, count] : edges) {
        const auto back = edges.find({edge.second, edge.first});
        EXPECT_EQ(back == edges.end() ? 0 : back->second, count);
      }
    }
  }
}

} // namespace
} // namespace cnem::results
