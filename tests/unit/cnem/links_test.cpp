// The links of the edge defect E = ½ Σ k |r_ij|², r_ij = x_j − x_i − ½ (F_i + F_j) X_ij.
#include "cnem/scni.hpp"
#include "sparse.hpp"
#include "tests/clouds.hpp"
#include "voronoi/plane/triangulation.hpp"

#include <gtest/gtest.h>

#include <set>

namespace cnem::testing {
namespace {

TEST(Links, are_the_delaunay_edges) {
  for (const NamedCloud& domain : domains()) {
    SCOPED_TRACE(domain.name);
    std::set<std::pair<NodeIndex, NodeIndex>> edges, linked;
    for (const auto& node : voronoi::triangulate(domain.cloud).node)
      for (std::size_t k = 0; k < 3; ++k) {
        edges.emplace(node[k], node[(k + 1) % 3]);
        edges.emplace(node[(k + 1) % 3], node[k]);
      }
    const auto links = scni::Cnem().rebuild(domain.cloud).links;
    for (const NodeIndex i : domain.cloud.position.indices())
      for (auto l = links.begin[index_of(i)]; l < links.begin[index_of(i) + 1]; ++l)
        linked.emplace(i, links.neighbour[std::size_t(l)]);
    EXPECT_EQ(linked, edges);
  }
}

TEST(Links, weigh_facet_over_distance_on_a_hexagonal_lattice) {
  Cloud<2> cloud;
  add_loop(cloud, ring({0, 0}, 1, 1, 6), 1.0);
  cloud.position.push_back({0, 0});
  const auto links = scni::Cnem().rebuild(cloud).links;
  ASSERT_EQ(links.begin[7] - links.begin[6], 6);
  for (auto l = std::size_t(links.begin[6]); l < std::size_t(links.begin[7]); ++l)
    EXPECT_NEAR(links.weight[l], 1 / std::sqrt(3.0), 1e-14);
}

TEST(Links, patch_defect_vanishes_on_linear_fields) {
  for (const NamedCloud& domain : domains()) {
    SCOPED_TRACE(domain.name);
    const auto approximation = scni::Cnem().rebuild(domain.cloud);
    const Sparse d = defect_matrix(approximation, domain.cloud.position);
    Vector u(domain.cloud.nodes());
    for (int i = 0; i < u.size(); ++i) u[i] = domain.cloud.position[std::size_t(i)].dot(Vec2(2, -3)) + 0.7;
    EXPECT_LT((d * u).lpNorm<Eigen::Infinity>(), 1e-12);
  }
}

TEST(Links, defect_resists_the_checkerboard_that_nodal_integration_does_not_see) {
  Cloud<2> cloud = jittered_square(0.1, 0.0, 1);
  const auto approximation = scni::Cnem().rebuild(cloud);
  Vector u(cloud.nodes());
  for (int i = 0; i < u.size(); ++i) {
    const Vec2 x = 10 * cloud.position[std::size_t(i)];
    u[i] = (std::lround(x.x()) + std::lround(x.y())) % 2 == 0 ? 1.0 : -1.0;
  }
  const auto energy = [&](const DiscreteOperators<2>& op) {
    const auto [gx, gy] = gradient_matrices(op);
    return (gx * u).cwiseAbs2().dot(as_vector(op.volume)) + (gy * u).cwiseAbs2().dot(as_vector(op.volume));
  };
  const double triangles = energy(approximation.conduction);
  const double defect = 0.05 * (defect_matrix(approximation, cloud.position) * u).squaredNorm();
  EXPECT_LT(energy(approximation.mechanics), 0.05 * triangles);
  EXPECT_GT(defect, 0.04 * triangles);
}

} // namespace
} // namespace cnem::testing
