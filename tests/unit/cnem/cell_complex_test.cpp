// Smoothed gradients and links on a cell complex, in the plane on Voronoi cells and in space on the median
// dual of tetrahedra, whose smoothed gradients are means over the tetrahedra at a node.
#include "cnem/scni.hpp"
#include "cnem/smoothing.hpp"
#include "tests/contract/domains.hpp"
#include "tests/index_literals.hpp"
#include "tests/linear_functions.hpp"
#include "voronoi/linear_simplices.hpp"

#include <gtest/gtest.h>

namespace cnem::testing {
using namespace literals;

namespace {

constexpr double tolerance = 1e-12;

voronoi::Cells voronoi_cells(const Cloud<2>& cloud) {
  const auto mesh = voronoi::triangulate(cloud);
  return voronoi::constrained_cells(cloud, mesh, voronoi::circumcircles(cloud, mesh));
}

/// The cells of a domain, and the operators and links made of them.
struct Smoothed {
  explicit Smoothed(const Domain<3>& domain, int points = 1)
      : cells(voronoi::median_cells(domain.cloud, domain.mesh)), faces(faces_of_cells(cells)),
        op(scni::smoothed_gradients(
            domain.cloud, cells, faces,
            scni::face_means(domain.cloud, cells, points, Space::plane,
                             [&] { return LinearFunctions(domain.cloud, domain.mesh); }))),
        links(scni::stabilisation_links(domain.cloud, cells, faces)) {}

  CellComplex<3> cells;
  CellLists<FaceIndex> faces;
  DiscreteOperators<3> op;
  StabilisationLinks<3> links;
};

Vec<3> gradient(const DiscreteOperators<3>& op, std::size_t e) {
  return {op.gradient[0][e], op.gradient[1][e], op.gradient[2][e]};
}

Vec<3> gradient_of(const DiscreteOperators<3>& op, std::size_t row, const std::vector<double>& u) {
  Vec<3> g = Vec<3>::Zero();
  for (auto e = index_of(op.row_begin[row]); e < index_of(op.row_begin[row + 1]); ++e)
    g += u[index_of(op.node[e])] * gradient(op, e);
  return g;
}

template<class Field> std::vector<double> nodal(const Cloud<3>& cloud, Field&& field) {
  std::vector<double> u;
  for (const Vec<3>& x : cloud.position) u.push_back(field(x));
  return u;
}

TEST(CellComplex, is_closed_on_all_domains) {
  for (const auto& domain : all_domains<2>())
    EXPECT_TRUE(is_closed<2>(domain.cloud, voronoi_cells(domain.cloud))) << domain.name;
  for (const auto& domain : all_domains<3>())
    EXPECT_TRUE(is_closed(domain.cloud, voronoi::median_cells(domain.cloud, domain.mesh))) << domain.name;
}

template<int dim> void expect_open_once_damaged(const Cloud<dim>& cloud, const CellComplex<dim>& whole) {
  ASSERT_TRUE(is_closed(cloud, whole));
  const auto damaged = [&](auto&& damage) {
    CellComplex<dim> cells = whole;
    damage(cells);
    return !is_closed(cloud, cells);
  };
  EXPECT_TRUE(damaged([](auto& cells) { cells.volume[3] *= 1.0 + 1e-9; }));
  EXPECT_TRUE(damaged([](auto& cells) { cells.volume[3] = std::nan(""); }));
  EXPECT_TRUE(damaged([](auto& cells) { cells.interior[2].corner[0].x() += 1e-9; }));
  EXPECT_TRUE(damaged([](auto& cells) { std::swap(cells.interior[2].cell[0], cells.interior[2].cell[1]); }));
  EXPECT_TRUE(damaged([](auto& cells) { cells.boundary.pop_back(); }));
  EXPECT_TRUE(damaged([](auto& cells) { cells.boundary[1].place[1][0] += 1e-9; }));
}

TEST(CellComplex, is_seen_to_be_open) {
  const Cloud<2> square = jittered_square(0.2, 0.3, 4);
  expect_open_once_damaged<2>(square, voronoi_cells(square));
  const Domain<3> block = all_domains<3>()[2];
  expect_open_once_damaged<3>(block.cloud, voronoi::median_cells(block.cloud, block.mesh));
}

TEST(CellComplex, shares_of_a_facet_sum_to_one_over_its_corners) {
  for (const auto& domain : all_domains<2>()) {
    std::vector<std::array<double, 2>> sum(domain.cloud.facets.size(), {0.0, 0.0});
    for (const BoundaryPart<2>& part : voronoi_cells(domain.cloud).boundary)
      for (std::size_t a = 0; a < 2; ++a) sum[index_of(part.facet)][a] += part.shares()[a];
    for (const auto& [a, b] : sum) {
      EXPECT_NEAR(a, 0.5, 1e-14);
      EXPECT_NEAR(b, 0.5, 1e-14);
    }
  }
  const Domain<3> box = all_domains<3>()[0];
  std::vector<std::array<double, 3>> own(box.cloud.facets.size(), {0.0, 0.0, 0.0});
  for (const BoundaryPart<3>& part : voronoi::median_cells(box.cloud, box.mesh).boundary)
    for (std::size_t a = 0; a < 3; ++a) own[index_of(part.facet)][a] += part.shares()[a];
  for (const auto& share : own)
    for (const double s : share) EXPECT_NEAR(s, 1.0 / 3.0, 1e-14);
  // the third of a corner: 22/108 of its own function, 7/108 of each other
  const auto parts = voronoi::median_cells(box.cloud, box.mesh).boundary;
  const auto one = parts[0].shares(), two = parts[1].shares();
  EXPECT_NEAR(one[0] + two[0], 22.0 / 108.0, 1e-15);
  EXPECT_NEAR(one[1] + two[1], 7.0 / 108.0, 1e-15);
  EXPECT_NEAR(one[2] + two[2], 7.0 / 108.0, 1e-15);
}

TEST(CellComplex, smoothed_gradients_in_space_reproduce_linear_fields) {
  for (const auto& domain : all_domains<3>())
    for (const int points : {1, 2}) {
      SCOPED_TRACE(domain.name);
      const Smoothed smoothed(domain, points);
      const auto u = nodal(domain.cloud, [](const Vec<3>& x) { return 0.7 + Vec<3>(2, -3, 1.5).dot(x); });
      const std::vector<double> one(u.size(), 1.0);
      for (std::size_t i = 0; i < u.size(); ++i) {
        EXPECT_LT(gradient_of(smoothed.op, i, one).norm() * domain.spacing, tolerance);
        EXPECT_LT((gradient_of(smoothed.op, i, u) - Vec<3>(2, -3, 1.5)).norm(), tolerance);
      }
    }
}

/// ∮ φ n dΓ over the cell of a node is Σ_t ¼ V_t ∇φ over its tetrahedra: nodal integration of tetrahedra
/// (Dohrmann et al. 2000).
TEST(CellComplex, smoothed_gradients_of_the_median_dual_are_means_over_the_tetrahedra) {
  for (const auto& domain : all_domains<3>()) {
    SCOPED_TRACE(domain.name);
    const Smoothed smoothed(domain);
    const auto tetrahedra = voronoi::linear_simplices<3>(domain.cloud, domain.mesh);
    Random random(11);
    const auto u = nodal(domain.cloud, [&](const Vec<3>&) { return random.uniform(-1, 1); });
    std::vector<Vec<3>> mean(u.size(), Vec<3>::Zero());
    for (std::size_t t = 0; t < domain.mesh.size(); ++t)
      for (const NodeIndex i : domain.mesh[t])
        mean[index_of(i)] +=
            0.25 * tetrahedra.volume[t] / smoothed.cells.volume[index_of(i)] * gradient_of(tetrahedra, t, u);
    for (std::size_t i = 0; i < u.size(); ++i)
      EXPECT_LT((gradient_of(smoothed.op, i, u) - mean[i]).norm() * domain.spacing, tolerance);
  }
}

TEST(CellComplex, constant_stress_in_space_loads_the_boundary_only) {
  for (const auto& domain : all_domains<3>()) {
    SCOPED_TRACE(domain.name);
    const DiscreteOperators<3> op = Smoothed(domain).op;
    std::vector<Vec<3>> expected(domain.cloud.position.size(), Vec<3>::Zero());
    for (const Facet<3>& facet : domain.cloud.facets)
      for (const NodeIndex i : facet.node)
        expected[index_of(i)] += area_normal<3>(corners_of<3>(facet, domain.cloud.position)) / 3.0;
    for (std::size_t j = 0; j < expected.size(); ++j) {
      Vec<3> sum = Vec<3>::Zero();
      for (auto e = index_of(op.col_begin[j]); e < index_of(op.col_begin[j + 1]); ++e)
        sum += Vec<3>(op.weighted_gradient[0][e], op.weighted_gradient[1][e], op.weighted_gradient[2][e]);
      EXPECT_LT((sum - expected[j]).norm(), tolerance * domain.spacing * domain.spacing);
    }
  }
}

/// Gradients of a quadratic field err by the first power of the spacing, in the jittered block.
TEST(CellComplex, smoothed_gradients_of_a_quadratic_field_converge) {
  const auto error = [](int n) {
    auto block = clouds::tetrahedral_block({1, 1, 1}, {n, n, n}, [n](const Vec<3>& x) -> Vec<3> {
      return x + 0.2 / n * scatter(n * x).cwiseProduct(Vec<3>(x.array().min(1.0 - x.array()).sign()));
    });
    const Domain<3> domain{"", std::move(block.cloud), 1.0 / n, false, std::move(block.tetrahedra)};
    const Smoothed smoothed(domain);
    const auto u = nodal(domain.cloud, [](const Vec<3>& x) { return x.squaredNorm(); });
    double squared = 0.0;
    for (std::size_t i = 0; i < u.size(); ++i)
      squared += smoothed.op.volume[i] *
                 (gradient_of(smoothed.op, i, u) - 2.0 * domain.cloud.position[i]).squaredNorm();
    return std::sqrt(squared);
  };
  EXPECT_GT(error(4) / error(8), 1.8);
}

TEST(CellComplex, links_in_space_are_symmetric_and_see_linear_fields_as_exact) {
  for (const auto& domain : all_domains<3>()) {
    SCOPED_TRACE(domain.name);
    const Smoothed smoothed(domain);
    const auto& links = smoothed.links;
    const auto u = nodal(domain.cloud, [](const Vec<3>& x) { return Vec<3>(1, 2, -1).dot(x); });
    std::map<std::pair<std::size_t, std::size_t>, double> weight;
    for (std::size_t i = 0; i < u.size(); ++i)
      for (auto l = index_of(links.begin[i]); l < index_of(links.begin[i + 1]); ++l) {
        const auto j = index_of(links.neighbour[l]);
        EXPECT_TRUE(weight.emplace(std::pair(i, j), links.weight[l]).second);
        const Vec<3> x = domain.cloud.position[j] - domain.cloud.position[i];
        const Vec<3> g = 0.5 * (gradient_of(smoothed.op, i, u) + gradient_of(smoothed.op, j, u));
        EXPECT_LT(std::abs(u[j] - u[i] - g.dot(x)), tolerance);
        EXPECT_GE(links.weight[l], 0.05 * x.norm());
        EXPECT_LE(links.weight[l], 2.0 * x.norm());
      }
    for (const auto& [pair, w] : weight) EXPECT_NEAR(weight.at({pair.second, pair.first}), w, tolerance * w);
  }
}

/// Voronoi cells of a lattice of 2 × 1 × 1 nodes h apart and one beside it that shares an edge of the mesh
/// only.
TEST(CellComplex, links_in_space_weigh_area_over_distance) {
  constexpr double h = 0.1;
  Cloud<3> cloud;
  cloud.position = {{0, 0, 0}, {h, 0, 0}, {h, 2 * h, 0}};
  CellComplex<3> cells;
  cells.volume.assign(3, h * h * h);
  constexpr std::array no_simplex{SimplexIndex::none, SimplexIndex::none};
  const double x = 0.5 * h, a = 0.5 * h;
  cells.interior.push_back(
      {{0_node, 1_node}, no_simplex, {Vec<3>(x, -a, -a), Vec<3>(x, a, -a), Vec<3>(x, a, a)}});
  cells.interior.push_back(
      {{0_node, 1_node}, no_simplex, {Vec<3>(x, -a, -a), Vec<3>(x, a, a), Vec<3>(x, -a, a)}});
  cells.neighbours = other_ends(3, std::vector<std::array<NodeIndex, 2>>{{1_node, 0_node}, {1_node, 2_node}});
  const auto links = scni::stabilisation_links(cloud, cells, faces_of_cells(cells));
  EXPECT_EQ(links.neighbour, (std::vector{1_node, 0_node, 2_node, 1_node}));
  EXPECT_NEAR(links.weight[0], h, 1e-15); // h²/h
  EXPECT_NEAR(links.weight[1], h, 1e-15);
  EXPECT_NEAR(links.weight[2], 0.05 * 2 * h, 1e-15);
}

TEST(CellComplex, quadrature_points_are_exact_to_their_degree) {
  for (const int points : {1, 2, 3}) {
    for (int power = 0; power < 2 * points; ++power) {
      double sum = 0.0;
      for (const auto& point : face_rule<2>(points)) sum += point.weight * std::pow(point.place[0], power);
      EXPECT_NEAR(sum, 1.0 / (power + 1), 1e-15);
    }
    for (int p = 0; p <= std::min(points, 2); ++p)
      for (int q = 0; p + q <= std::min(points, 2); ++q) {
        double sum = 0.0;
        for (const auto& point : face_rule<3>(points))
          sum += point.weight * std::pow(point.place[0], p) * std::pow(point.place[1], q);
        EXPECT_NEAR(sum, 2.0 * std::tgamma(p + 1) * std::tgamma(q + 1) / std::tgamma(p + q + 3), 1e-15);
      }
  }
}

} // namespace
} // namespace cnem::testing
