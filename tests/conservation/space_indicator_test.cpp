// The indicator on the cells of clouds in space.
#include "adapt/space/indicator.hpp"
#include "clouds/tetrahedral_block.hpp"
#include "voronoi/space/median_cells.hpp"
#include "voronoi/space/voronoi_cells.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace cnem::adapt {
namespace {

/// A bent block whose nodes stand on no lattice.
struct Body {
  clouds::TetrahedralBlock block = clouds::tetrahedral_block({1, 1, 1}, {5, 5, 5}, [](const Vec3& x) -> Vec3 {
    return {x.x() + 0.05 * x.y() * x.z(), x.y() + 0.03 * x.x() * x.x(), x.z() * (1.0 + 0.1 * x.x())};
  });
  const Cloud<3>& cloud = block.cloud;
  scni::CellKind kind;
  SpaceStructure structure;

  explicit Body(scni::CellKind cells)
      : kind(cells), structure(structure_of(cloud, voronoi::connected(cloud, block.tetrahedra), cells)) {}

  template<class Function> Field values(const Function& function) const {
    Field value;
    for (const Vec3& x : cloud.position) value.push_back(function(x));
    return value;
  }
  Indicator of(const Field& value) const { return indicator(cloud, structure, kind, value); }
  CellComplex<3> cells() const {
    if (kind == scni::CellKind::median) return voronoi::median_cells(cloud, structure.mesh.node);
    return voronoi::cell_complex(
        cloud, structure.mesh,
        voronoi::voronoi_cells(cloud, structure.mesh, voronoi::circumspheres(cloud, structure.mesh)));
  }
};

/// ∫ (g·(x − x_i))² dV of the cell of each node, as its simplices with signed volumes: V/10 Σ l_k l_m, k ≤ m.
Field second_moments(const Body& body, const CellComplex<3>& cells, const Vec3& g) {
  Field moment(body.cloud.position.size(), 0.0);
  const auto add = [&](NodeIndex i, const Vec3& a, const Vec3& b, const Vec3& c) {
    const Vec3& x = body.cloud.position[i];
    const double l[3] = {g.dot(a - x), g.dot(b - x), g.dot(c - x)};
    const double volume = (a - x).dot((b - x).cross(c - x)) / 6.0;
    moment[index_of(i)] +=
        volume / 10.0 * (l[0] * l[0] + l[1] * l[1] + l[2] * l[2] + l[0] * l[1] + l[1] * l[2] + l[2] * l[0]);
  };
  for (const auto& face : cells.interior) {
    add(face.cell[0], face.corner[0], face.corner[1], face.corner[2]);
    add(face.cell[1], face.corner[1], face.corner[0], face.corner[2]);
  }
  for (const auto& part : cells.boundary) {
    const auto side = part.on(corners_of<3>(body.cloud.facets[part.facet], body.cloud.position));
    add(part.cell, side[0], side[1], side[2]);
  }
  return moment;
}

class SpaceIndicator : public ::testing::TestWithParam<scni::CellKind> {};

TEST_P(SpaceIndicator, is_zero_for_a_constant) {
  const Body body(GetParam());
  EXPECT_EQ(body.of(body.values([](const Vec3&) { return 0.7; })).total, 0.0);
}

TEST_P(SpaceIndicator, of_a_linear_field_is_the_second_moment_of_the_cell) {
  const Body body(GetParam());
  const Vec3 g(2.0, -1.5, 0.5);
  const Indicator found = body.of(body.values([&](const Vec3& x) { return 5.0 + g.dot(x); }));
  const Field exact = second_moments(body, body.cells(), g);
  for (std::size_t i = 0; i < exact.size(); ++i)
    EXPECT_NEAR(found.error[i] * found.error[i], exact[i], 1e-10 * exact[i]) << i;
}

INSTANTIATE_TEST_SUITE_P(Cells, SpaceIndicator,
                         ::testing::Values(scni::CellKind::median, scni::CellKind::voronoi));

} // namespace
} // namespace cnem::adapt
