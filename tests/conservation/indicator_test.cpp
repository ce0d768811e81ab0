// The indicator (80)-(82) on fields it is exact for.
#include "adapt/plane/indicator.hpp"
#include "clouds/tetrahedral_block.hpp"
#include "tests/clouds.hpp"
#include "tests/linear_functions.hpp"

#include <gtest/gtest.h>

namespace cnem::adapt {
namespace {

Cloud<2> notched(double spacing) {
  Cloud<2> cloud;
  testing::add_loop(cloud, {{0, 0}, {1, 0}, {1, 0.4}, {0.4, 0.4}, {0.4, 1}, {0, 1}}, spacing);
  testing::fill(cloud, testing::Lattice::hexagonal, spacing, 0.25, 0.5 * spacing, 3);
  return cloud;
}

TEST(Indicator, is_zero_for_a_constant) {
  const Cloud<2> cloud = notched(0.08);
  const Structure structure = build_structure(cloud);
  const Indicator found = indicator(cloud, structure, Field(cloud.position.size(), 0.7));
  EXPECT_EQ(found.total, 0.0);
  EXPECT_NEAR(found.norm, 0.7 * std::sqrt(0.64), 1e-14);
}

TEST(Indicator, of_a_linear_field_is_the_second_moment_of_the_cell) {
  const Cloud<2> cloud = notched(0.08);
  const Structure structure = build_structure(cloud);
  const Vec2 g(2.0, -1.5);
  Field value(cloud.position.size());
  for (std::size_t i = 0; i < value.size(); ++i) value[i] = 5.0 + g.dot(cloud.position[i]);
  const Indicator found = indicator(cloud, structure, value);
  const CellGeometry<2> cells =
      voronoi::cell_geometry(cloud, structure.mesh, structure.circles, structure.cells);
  double sum = 0.0;
  for (std::size_t i = 0; i < value.size(); ++i) {
    // ∫ (g·(X − X_i))² over the polygon, exact for each triangle (0, a, b): A/6 (α² + αβ + β²)
    double exact = 0.0;
    const auto first = static_cast<std::size_t>(cells.begin[i]),
               last = static_cast<std::size_t>(cells.begin[i + 1]);
    for (std::size_t v = first; v < last; ++v) {
      const Vec2 a = cells.vertex[static_cast<std::size_t>(cells.index[v])] - cloud.position[i],
                 b = cells.vertex[static_cast<std::size_t>(cells.index[v + 1 < last ? v + 1 : first])] -
                     cloud.position[i];
      const double alpha = g.dot(a), beta = g.dot(b);
      exact += 0.5 * cross(a, b) / 6.0 * (alpha * alpha + alpha * beta + beta * beta);
    }
    EXPECT_NEAR(found.error[i] * found.error[i], exact, 1e-12 * exact + 1e-18) << i;
    sum += exact;
  }
  EXPECT_NEAR(found.total, std::sqrt(sum), 1e-12);
}

TEST(Indicator, of_a_linear_field_falls_with_the_spacing) {
  double total[2];
  for (int k = 0; k < 2; ++k) {
    const Cloud<2> cloud = notched(k == 0 ? 0.1 : 0.05);
    Field value(cloud.position.size());
    for (std::size_t i = 0; i < value.size(); ++i) value[i] = cloud.position[i].x();
    total[k] = indicator(cloud, build_structure(cloud), value).total;
  }
  EXPECT_NEAR(total[0] / total[1], 2.0, 0.3);
}

/// The same indicator in space, on the median dual of a bent block.
struct Solid {
  explicit Solid(int n)
      : block(clouds::tetrahedral_block(
            {1, 1, 1}, {n, n, n},
            [](const Vec<3>& x) -> Vec<3> {
              return {x.x() + 0.2 * x.y() * x.z(), x.y(), x.z() * (1.0 + 0.3 * x.x())};
            })),
        cells(voronoi::median_cells(block.cloud, block.tetrahedra)) {}

  template<class Function> Indicator of(Function&& function) const {
    Field value;
    for (const Vec<3>& x : block.cloud.position) value.push_back(function(x));
    return indicator<3>(block.cloud, cells, value,
                        [&] { return testing::LinearFunctions(block.cloud, block.tetrahedra); });
  }

  clouds::TetrahedralBlock block;
  CellComplex<3> cells;
};

TEST(Indicator, in_space_falls_with_the_spacing) {
  const auto quadratic = [](const Vec<3>& x) { return x.squaredNorm() + x.y(); };
  EXPECT_NEAR(Solid(4).of(quadratic).total / Solid(8).of(quadratic).total, 2.0, 0.1);
}

} // namespace
} // namespace cnem::adapt
