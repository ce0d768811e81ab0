// Cells, links, independence of threads and of the frame: the rest of the contract.
#include "contract.hpp"

#include <omp.h>

#include <cstring>

namespace cnem::testing {
namespace {

constexpr double tolerance = 1e-12;

template<class Vector> void expect_same_bits(const Vector& a, const Vector& b) {
  ASSERT_EQ(a.size(), b.size());
  EXPECT_EQ(std::memcmp(a.data(), b.data(), a.size() * sizeof(a[0])), 0);
}

void expect_same_bits(const DiscreteOperators<2>& a, const DiscreteOperators<2>& b) {
  expect_same_bits(a.volume, b.volume);
  expect_same_bits(a.row_begin, b.row_begin);
  expect_same_bits(a.node, b.node);
  expect_same_bits(a.value, b.value);
  expect_same_bits(a.point, b.point);
  for (std::size_t k = 0; k < 2; ++k) {
    expect_same_bits(a.gradient[k], b.gradient[k]);
    expect_same_bits(a.weighted_gradient[k], b.weighted_gradient[k]);
  }
}

/// Σ_p V_p b_pJ·(Σ_K b_pK u_K) and Σ_p V_p N_pJ (Σ_K b_pK u_K): a scalar and a vector per node, whatever the
/// order of the points.
struct NodalResponse {
  std::vector<double> laplacian;
  std::vector<Vec2> gradient;
};

NodalResponse response(const DiscreteOperators<2>& op, const std::vector<double>& u) {
  std::vector<Vec2> g(index(op.points), Vec2::Zero());
  for_each_entry(op, [&](std::size_t p, std::size_t e, std::size_t j) { g[p] += u[j] * gradient(op, e); });
  NodalResponse r{std::vector<double>(u.size(), 0.0), std::vector<Vec2>(u.size(), Vec2::Zero())};
  for_each_entry(op, [&](std::size_t p, std::size_t e, std::size_t j) {
    r.laplacian[j] += op.volume[p] * gradient(op, e).dot(g[p]);
    r.gradient[j] += op.volume[p] * value(op, p, e) * g[p];
  });
  return r;
}

TEST_P(Contract, promised_cells_have_the_volumes_of_their_points) {
  if (!promised(Promise::tiling_cells)) GTEST_SKIP() << "not promised";
  on_every_domain([](const NamedCloud& domain, const Approximation<2>& approximation) {
    const CellGeometry<2>& cells = approximation.cells;
    const auto& op = approximation.mechanics;
    ASSERT_EQ(cells.begin.size(), index(op.points) + 1);
    for (std::size_t p = 0; p < index(op.points); ++p) {
      const auto begin = index(cells.begin[p]), end = index(cells.begin[p + 1]);
      ASSERT_GE(end - begin, 3u);
      double twice = 0.0;
      const Vec2 origin = cells.vertex[index(cells.index[begin])];
      for (auto v = begin; v < end; ++v)
        twice += cross(cells.vertex[index(cells.index[v])] - origin,
                       cells.vertex[index(cells.index[v + 1 < end ? v + 1 : begin])] - origin);
      EXPECT_NEAR(0.5 * twice, op.volume[p], tolerance * domain.spacing * domain.spacing);
    }
  });
}

TEST_P(Contract, promised_interpolation_cell_vertices_at_nodes_move_with_them) {
  if (!promised(Promise::interpolating_values)) GTEST_SKIP() << "not promised";
  on_every_domain([](const NamedCloud& domain, const Approximation<2>& approximation) {
    const CellGeometry<2>& cells = approximation.cells;
    std::size_t at_nodes = 0;
    for (std::size_t v = 0; v < cells.vertex.size(); ++v)
      for (auto e = index(cells.vertex_begin[v]); e < index(cells.vertex_begin[v + 1]); ++e)
        if (cells.vertex[v] == domain.cloud.position[index(cells.vertex_node[e])]) {
          EXPECT_EQ(cells.vertex_weight[e], 1.0);
          ++at_nodes;
        }
    EXPECT_GE(at_nodes, domain.cloud.facets.size());
  });
}

TEST_P(Contract, patch_cell_vertices_follow_linear_fields) {
  on_every_domain([](const NamedCloud& domain, const Approximation<2>& approximation) {
    const CellGeometry<2>& cells = approximation.cells;
    ASSERT_EQ(cells.vertex_begin.size(), cells.vertex.size() + 1);
    for (std::size_t v = 0; v < cells.vertex.size(); ++v) {
      Vec2 x = Vec2::Zero();
      double sum = 0.0;
      for (auto e = index(cells.vertex_begin[v]); e < index(cells.vertex_begin[v + 1]); ++e) {
        EXPECT_GE(cells.vertex_weight[e], -tolerance);
        sum += cells.vertex_weight[e];
        x += cells.vertex_weight[e] * domain.cloud.position[index(cells.vertex_node[e])];
      }
      EXPECT_NEAR(sum, 1.0, tolerance);
      EXPECT_LT((x - cells.vertex[v]).norm(), tolerance);
    }
  });
}

TEST_P(Contract, links_are_symmetric_and_their_weights_bounded) {
  on_every_domain([](const NamedCloud& domain, const Approximation<2>& approximation) {
    const auto& links = approximation.links;
    const auto n = index(domain.cloud.nodes());
    ASSERT_EQ(links.begin.size(), n + 1);
    ASSERT_EQ(links.weight.size(), links.neighbour.size());
    ASSERT_EQ(index(links.begin[n]), links.neighbour.size());
    std::map<std::pair<std::size_t, std::size_t>, double> weight;
    for (std::size_t i = 0; i < n; ++i)
      for (auto e = index(links.begin[i]); e < index(links.begin[i + 1]); ++e) {
        const auto j = index(links.neighbour[e]);
        EXPECT_NE(i, j);
        EXPECT_TRUE(weight.emplace(std::pair(i, j), links.weight[e]).second) << "link listed twice";
        EXPECT_GE(links.weight[e], 0.1);
        EXPECT_LE(links.weight[e], 2.0);
      }
    for (const auto& [pair, w] : weight) {
      const auto other = weight.find({pair.second, pair.first});
      ASSERT_NE(other, weight.end());
      EXPECT_EQ(other->second, w);
    }
  });
}

TEST_P(Contract, operators_do_not_depend_on_the_number_of_threads) {
  const int threads = omp_get_max_threads();
  for (const NamedCloud& domain : domains()) {
    SCOPED_TRACE(domain.name);
    std::vector<Approximation<2>> results;
    for (const int n : {1, 2, 3}) {
      omp_set_num_threads(n);
      results.push_back(GetParam().make()->rebuild(domain.cloud));
    }
    omp_set_num_threads(threads);
    for (std::size_t n = 1; n < results.size(); ++n) {
      expect_same_bits(results[0].mechanics, results[n].mechanics);
      expect_same_bits(results[0].conduction, results[n].conduction);
      expect_same_bits(results[0].links.neighbour, results[n].links.neighbour);
      expect_same_bits(results[0].links.weight, results[n].links.weight);
      expect_same_bits(results[0].node_volume, results[n].node_volume);
      expect_same_bits(results[0].cells.vertex, results[n].cells.vertex);
      expect_same_bits(results[0].cells.index, results[n].cells.index);
    }
  }
}

TEST_P(Contract, rebuilding_on_a_used_object_gives_the_bits_of_a_fresh_one) {
  const auto method = GetParam().make();
  for (const NamedCloud& domain : domains()) {
    SCOPED_TRACE(domain.name);
    expect_same_bits(method->rebuild(domain.cloud).mechanics,
                     GetParam().make()->rebuild(domain.cloud).mechanics);
  }
}

TEST_P(Contract, operators_move_and_turn_with_the_cloud) {
  const double angle = 0.7;
  Mat2 rotation;
  rotation << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
  for (const NamedCloud& domain : domains()) {
    SCOPED_TRACE(domain.name);
    Cloud<2> moved = domain.cloud;
    for (Vec2& x : moved.position) x = rotation * x + Vec2(0.4, -0.9);
    const auto before = GetParam().make()->rebuild(domain.cloud);
    const auto after = GetParam().make()->rebuild(moved);
    // Where nodes are cocircular the triangles may flip, which cells and their functions do not notice.
    if (domain.ties && !before.mechanics.nodal) continue;
    Random random(5);
    std::vector<double> u(index(domain.cloud.nodes()));
    for (double& a : u) a = random.uniform(-1, 1);
    const auto a = response(before.mechanics, u), b = response(after.mechanics, u);
    double largest = 0.0;
    for (const double l : a.laplacian) largest = std::max(largest, std::abs(l));
    for (std::size_t j = 0; j < u.size(); ++j) {
      EXPECT_NEAR(a.laplacian[j], b.laplacian[j], tolerance * largest);
      EXPECT_LT((rotation * a.gradient[j] - b.gradient[j]).norm(), tolerance * domain.spacing);
    }
  }
}

} // namespace
} // namespace cnem::testing
