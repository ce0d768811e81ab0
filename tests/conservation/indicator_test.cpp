// The indicator (80)-(82) on fields it is exact for, and the marks that follow from it.
#include "adapt/marking.hpp"
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

TEST(Indicator, in_space_is_zero_for_a_constant) {
  const Solid solid(3);
  const Indicator found = solid.of([](const Vec<3>&) { return 0.7; });
  double volume = 0.0;
  for (const double v : solid.cells.volume) volume += v;
  EXPECT_EQ(found.total, 0.0);
  EXPECT_NEAR(found.norm, 0.7 * std::sqrt(volume), 1e-14);
}

TEST(Indicator, in_space_of_a_linear_field_is_the_second_moment_of_the_cell) {
  const Solid solid(3);
  const Vec<3> g(2.0, -1.5, 0.5);
  const Indicator found = solid.of([&](const Vec<3>& x) { return 5.0 + g.dot(x); });
  std::vector<double> exact(found.error.size(), 0.0);
  for (const auto& corner : solid.block.tetrahedra) {
    std::array<Vec<3>, 4> x;
    for (std::size_t k = 0; k < 4; ++k)
      x[k] = solid.block.cloud.position[static_cast<std::size_t>(corner[k])];
    for (std::size_t a = 0; a < 4; ++a) {
      // the hexahedron of corner a, as six pieces: corner, middle of an edge, centroid of a face, of all
      for (std::size_t b = 0; b < 4; ++b)
        for (std::size_t c = 0; c < 4; ++c) {
          if (a == b || b == c || a == c) continue;
          const Vec<3> middle = 0.5 * (x[a] + x[b]), face = (x[a] + x[b] + x[c]) / 3.0,
                       centre = 0.25 * (x[0] + x[1] + x[2] + x[3]);
          const double l[3] = {g.dot(middle - x[a]), g.dot(face - x[a]), g.dot(centre - x[a])};
          const double volume = std::abs(measure<3>({x[a], middle, face, centre}));
          // ∫ λ_k² = V/10, ∫ λ_k λ_l = V/20
          exact[static_cast<std::size_t>(corner[a])] +=
              volume / 10.0 *
              (l[0] * l[0] + l[1] * l[1] + l[2] * l[2] + l[0] * l[1] + l[1] * l[2] + l[2] * l[0]);
        }
    }
  }
  for (std::size_t i = 0; i < exact.size(); ++i)
    EXPECT_NEAR(found.error[i] * found.error[i], exact[i], 1e-12 * exact[i]) << i;
}

TEST(Indicator, in_space_falls_with_the_spacing) {
  const auto quadratic = [](const Vec<3>& x) { return x.squaredNorm() + x.y(); };
  EXPECT_NEAR(Solid(4).of(quadratic).total / Solid(8).of(quadratic).total, 2.0, 0.1);
}

struct Marked {
  Cloud<2> cloud = notched(0.08);
  Structure structure = build_structure(cloud);
  Field value, size;
  MarkingRules rules{.tolerance = 0.2, .coarsen = 0.05, .h_min = 0.02, .h_max = 0.16};

  Marked() {
    for (const Vec2& x : cloud.position) value.push_back(std::tanh((x.x() - 0.2) / 0.05));
    size.assign(value.size(), 0.08);
  }
  Marking mark_now() { return mark<2>(cloud, structure, indicator(cloud, structure, value), rules, size); }
};

TEST(Marking, refines_at_the_front_and_coarsens_where_nothing_happens) {
  Marked m;
  const Marking marking = m.mark_now();
  EXPECT_GT(marking.refined, 5);
  EXPECT_GT(marking.coarsened, 5);
  for (std::size_t i = 0; i < m.size.size(); ++i) {
    const double x = m.cloud.position[i].x();
    if (std::abs(x - 0.2) < 0.02) {
      EXPECT_EQ(m.size[i], 0.04) << x;
    } else if (x > 0.6) {
      EXPECT_EQ(m.size[i], 0.16) << x;
    }
  }
}

TEST(Marking, waits_until_the_cloud_has_followed) {
  Marked m;
  m.mark_now();
  const Field once = m.size;
  m.mark_now();
  EXPECT_EQ(m.size, once);
}

TEST(Marking, keeps_to_the_range_and_the_budget) {
  Marked m;
  m.rules.h_min = 0.06;
  m.rules.h_max = 0.1;
  m.mark_now();
  for (const double h : m.size) {
    EXPECT_GE(h, 0.06);
    EXPECT_LE(h, 0.1);
  }
  Marked poor;
  poor.rules.max_nodes = 180;
  poor.rules.coarsen = 0.0;
  const Marking marking = poor.mark_now();
  EXPECT_GT(marking.tolerance, 0.2);
  EXPECT_LE(nodes_wanted(poor.structure, poor.size), 180.0);
}

TEST(Marking, spacing_grows_no_faster_than_asked) {
  Marked m;
  m.size[10] = 0.005;
  limit_growth<2>(m.cloud, m.structure, 0.3, m.size);
  for (const NodeIndex i : m.cloud.position.indices())
    for (const NodeIndex k : m.structure.neighbours(i)) {
      const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(k);
      EXPECT_LE(m.size[b], m.size[a] + 0.3 * (m.cloud.position[b] - m.cloud.position[a]).norm() + 1e-12);
    }
  EXPECT_EQ(m.size[10], 0.005);
}

} // namespace
} // namespace cnem::adapt
