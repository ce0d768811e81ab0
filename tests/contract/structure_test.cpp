// Cells, links, independence of threads and of the frame: the rest of the contract.
#include "contract.hpp"

#include <omp.h>

#include <cstring>
#include <set>

namespace cnem::testing {
namespace {

template<class Vector> void expect_same_bits(const Vector& a, const Vector& b) {
  ASSERT_EQ(a.size(), b.size());
  if (!a.empty()) { EXPECT_EQ(std::memcmp(a.data(), b.data(), a.size() * sizeof(a[0])), 0); }
}

template<int dim> void expect_same_bits(const DiscreteOperators<dim>& a, const DiscreteOperators<dim>& b) {
  expect_same_bits(a.volume, b.volume);
  expect_same_bits(a.row_begin, b.row_begin);
  expect_same_bits(a.node, b.node);
  expect_same_bits(a.value, b.value);
  expect_same_bits(a.point, b.point);
  for (std::size_t k = 0; k < dim; ++k) {
    expect_same_bits(a.gradient[k], b.gradient[k]);
    expect_same_bits(a.weighted_gradient[k], b.weighted_gradient[k]);
  }
}

/// Σ_p V_p b_pJ·(Σ_K b_pK u_K) and Σ_p V_p N_pJ (Σ_K b_pK u_K): a scalar and a vector per node, whatever the
/// order of the points.
template<int dim> struct NodalResponse {
  std::vector<double> laplacian;
  std::vector<Vec<dim>> gradient;
};

template<int dim>
NodalResponse<dim> response(const DiscreteOperators<dim>& op, const std::vector<double>& u) {
  std::vector<Vec<dim>> g(index(op.points), Vec<dim>::Zero());
  for_each_entry(op, [&](std::size_t p, std::size_t e, std::size_t j) { g[p] += u[j] * gradient(op, e); });
  NodalResponse<dim> r{std::vector<double>(u.size(), 0.0), std::vector<Vec<dim>>(u.size(), Vec<dim>::Zero())};
  for_each_entry(op, [&](std::size_t p, std::size_t e, std::size_t j) {
    r.laplacian[j] += op.volume[p] * gradient(op, e).dot(g[p]);
    r.gradient[j] += op.volume[p] * value(op, p, e) * g[p];
  });
  return r;
}

/// Volume of a cell: a polygon in the plane, a tetrahedron in space.
template<int dim> double volume_of(const CellGeometry<dim>& cells, std::size_t cell) {
  const auto begin = index(cells.begin[cell]), end = index(cells.begin[cell + 1]);
  const auto edge = [&](std::size_t v) -> Vec<dim> {
    return cells.vertex[index(cells.index[v])] - cells.vertex[index(cells.index[begin])];
  };
  EXPECT_GT(end - begin, std::size_t{dim});
  if constexpr (dim == 3) {
    EXPECT_EQ(end - begin, 4U);
    return edge(begin + 1).cross(edge(begin + 2)).dot(edge(begin + 3)) / 6.0;
  } else {
    double twice = 0.0;
    for (auto v = begin; v + 1 < end; ++v) twice += cross(edge(v), edge(v + 1));
    return 0.5 * twice;
  }
}

/// `exact`: in space without rounding.
template<int dim> Mat<dim> rotation(bool exact) {
  if constexpr (dim == 2)
    return Eigen::Rotation2Dd(0.7).toRotationMatrix();
  else
    return exact ? (Mat<3>() << 0, 0, 1, 1, 0, 0, 0, 1, 0).finished()
                 : Eigen::AngleAxisd(0.7, Vec<3>(2, -1, 2) / 3.0).toRotationMatrix();
}

TEST_P(Contract, promised_cells_have_the_volumes_of_their_points) {
  if (!promised(Promise::tiling_cells)) GTEST_SKIP() << "not promised";
  on_every_domain([]<int dim>(const Domain<dim>& domain, const Approximation<dim>& approximation) {
    const CellGeometry<dim>& cells = approximation.cells;
    const auto& op = approximation.mechanics;
    if (cells.between_points) {
      double sum = 0.0;
      for (std::size_t c = 0; c + 1 < cells.begin.size(); ++c) sum += volume_of(cells, c);
      EXPECT_NEAR(sum, enclosed_measure(domain.cloud), 1e-12 * sum) << "they fill the body";
      return;
    }
    ASSERT_EQ(cells.begin.size(), index(op.points) + 1);
    for (std::size_t p = 0; p < index(op.points); ++p)
      EXPECT_NEAR(volume_of(cells, p), op.volume[p], tolerance * std::pow(domain.spacing, dim));
  });
}

TEST_P(Contract, promised_interpolation_cell_vertices_at_nodes_move_with_them) {
  if (!promised(Promise::interpolating_values)) GTEST_SKIP() << "not promised";
  on_every_domain([]<int dim>(const Domain<dim>& domain, const Approximation<dim>& approximation) {
    const CellGeometry<dim>& cells = approximation.cells;
    std::size_t at_nodes = 0;
    for (std::size_t v = 0; v < cells.vertex.size(); ++v)
      for (auto e = index(cells.vertex_begin[v]); e < index(cells.vertex_begin[v + 1]); ++e)
        if (cells.vertex[v] == domain.cloud.position[index(cells.vertex_node[e])]) {
          EXPECT_EQ(cells.vertex_weight[e], 1.0);
          ++at_nodes;
        }
    std::set<NodeIndex> boundary;
    for (const Facet<dim>& facet : domain.cloud.facets) boundary.insert(facet.node.begin(), facet.node.end());
    EXPECT_GE(at_nodes, boundary.size());
  });
}

TEST_P(Contract, patch_cell_vertices_follow_linear_fields) {
  on_every_domain([]<int dim>(const Domain<dim>& domain, const Approximation<dim>& approximation) {
    const CellGeometry<dim>& cells = approximation.cells;
    ASSERT_EQ(cells.vertex_begin.size(), cells.vertex.size() + 1);
    for (std::size_t v = 0; v < cells.vertex.size(); ++v) {
      Vec<dim> x = Vec<dim>::Zero();
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
  on_every_domain([]<int dim>(const Domain<dim>& domain, const Approximation<dim>& approximation) {
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
        const double length = dim == 2 ? 1.0 : (domain.cloud.position[j] - domain.cloud.position[i]).norm();
        EXPECT_GE(links.weight[e], (dim == 2 ? 0.1 : 0.05) * length);
        EXPECT_LE(links.weight[e], 2.0 * length);
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
  on_every_cloud([&]<int dim>(const Domain<dim>& domain) {
    std::vector<Approximation<dim>> results;
    for (const int n : {1, 2, 3}) {
      omp_set_num_threads(n);
      results.push_back(GetParam().make(domain)->rebuild(domain.cloud));
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
  });
}

TEST_P(Contract, rebuilding_on_a_used_object_gives_the_bits_of_a_fresh_one) {
  const auto all = []<int dim>(const std::vector<Domain<dim>>& domains) {
    std::unique_ptr<Discretisation<dim>> used;
    for (const Domain<dim>& domain : domains) {
      SCOPED_TRACE(domain.name);
      if (!used || !domain.mesh.empty()) { // a mesh belongs to one domain
        used = GetParam().make(domain);
        Cloud<dim> stretched = domain.cloud;
        for (Vec<dim>& x : stretched.position) // in space in all directions: without rounding in the planes
          x = (dim == 2 ? Vec<dim>(Vec<dim>::Ones() + Vec<dim>::UnitX()) : Vec<dim>::Constant(2.0))
                  .cwiseProduct(x);
        used->rebuild(stretched);
      }
      expect_same_bits(used->rebuild(domain.cloud).mechanics,
                       GetParam().make(domain)->rebuild(domain.cloud).mechanics);
    }
  };
  if (GetParam().dim == 2)
    all(all_domains<2>());
  else
    all(all_domains<3>());
}

TEST_P(Contract, operators_move_and_turn_with_the_cloud) {
  on_every_domain([]<int dim>(const Domain<dim>& domain, const Approximation<dim>& before) {
    // Where nodes are cocircular the simplices may flip, which Voronoi cells and natural neighbours do not
    // notice, but supports of moving least squares do.
    const std::string& name = GetParam().name;
    const bool of_simplices = !before.mechanics.nodal || GetParam().entry->name == "hybrid" ||
                              name.starts_with("mls_") || name == "median" || name == "space_linear_1";
    if (domain.ties && of_simplices) return;
    Cloud<dim> moved = domain.cloud;
    // Which diagonals four nodes on a circle have, and whether they are on one plane, depends on rounding.
    const bool exact = dim == 3 && !GetParam().takes_mesh(domain);
    const Mat<dim> turn = rotation<dim>(exact);
    const Vec<dim> shift = exact ? Vec<dim>::Zero() : Vec<dim>(Vec<dim>::LinSpaced(0.4, -0.9));
    for (Vec<dim>& x : moved.position) x = turn * x + shift;
    const auto after = GetParam().make(domain)->rebuild(moved);
    Random random(5);
    std::vector<double> u(index(domain.cloud.nodes()));
    for (double& a : u) a = random.uniform(-1, 1);
    const auto a = response(before.mechanics, u), b = response(after.mechanics, u);
    double largest = 0.0;
    for (const double l : a.laplacian) largest = std::max(largest, std::abs(l));
    for (std::size_t j = 0; j < u.size(); ++j) {
      EXPECT_NEAR(a.laplacian[j], b.laplacian[j], tolerance * largest);
      EXPECT_LT((turn * a.gradient[j] - b.gradient[j]).norm(), tolerance * domain.spacing);
    }
  });
}

} // namespace
} // namespace cnem::testing
