// Element-free Galerkin beyond the contract (tests/contract): how far it is from what it does not promise, as
// docs/methods.md has it.
#include "core/error.hpp"
#include "core/index.hpp"
#include "methods/efg.hpp"
#include "methods/registry.hpp"
#include "tests/clouds.hpp"

#include <Eigen/SVD>
#include <gtest/gtest.h>

namespace cnem::testing {
namespace {

using methods::Efg;

struct Unbalanced {
  double largest = 0.0, rms = 0.0; ///< –, of inner nodes, over stress times spacing
};

/// The force of uniform stress on the inner nodes of the unit square.
Unbalanced unbalanced(Lattice lattice, double jitter, double support) {
  const double h = 0.05;
  Cloud<2> cloud;
  add_loop(cloud, rectangle(1, 1), h);
  fill(cloud, lattice, h, jitter, 0.5 * h, 1);
  const auto op = Efg(support).rebuild(cloud).mechanics;
  Mat2 stress;
  stress << 0.7, 0.5, 0.5, -0.4;
  stress /= Eigen::JacobiSVD<Mat2>(stress).singularValues()[0];
  Unbalanced result;
  const std::size_t first = cloud.facets.size(); // behind the nodes of the boundary
  for (std::size_t j = first; j < cloud.position.size(); ++j) {
    Vec2 force = Vec2::Zero();
    for (auto e = index_of(op.col_begin[j]); e < index_of(op.col_begin[j + 1]); ++e)
      force += stress * Vec2(op.weighted_gradient[0][e], op.weighted_gradient[1][e]);
    result.largest = std::max(result.largest, force.norm() / h);
    result.rms += force.squaredNorm() / (h * h);
  }
  result.rms = std::sqrt(result.rms / static_cast<double>(cloud.position.size() - first));
  return result;
}

} // namespace

TEST(Efg, uniform_stress_loads_inner_nodes_by_what_the_documents_say) {
  struct Row {
    Lattice lattice;
    double jitter, support, largest, rms;
  };
  for (const Row& row :
       {Row{Lattice::square, 0.0, 2.5, 0.067, 0.0141}, Row{Lattice::square, 0.2, 2.0, 0.215, 0.074},
        Row{Lattice::square, 0.2, 2.5, 0.187, 0.071}, Row{Lattice::square, 0.2, 3.0, 0.187, 0.075},
        Row{Lattice::hexagonal, 0.0, 2.5, 0.147, 0.0253}, Row{Lattice::hexagonal, 0.2, 2.5, 0.233, 0.083}}) {
    const Unbalanced found = unbalanced(row.lattice, row.jitter, row.support);
    EXPECT_NEAR(found.largest, row.largest, 0.02 * row.largest);
    EXPECT_NEAR(found.rms, row.rms, 0.02 * row.rms);
  }
}

TEST(Efg, each_triangle_has_three_points_that_integrate_quadratic_fields) {
  const Cloud<2> cloud = jittered_square(0.1, 0.25, 8);
  const auto result = Efg().rebuild(cloud);
  const auto& op = result.mechanics;
  EXPECT_EQ(op.points, 3 * result.conduction.points);
  double second = 0.0; // ∫ x² over the unit square, the place of a point from its values
  for (std::size_t p = 0; p < index_of(op.points); ++p) {
    double x = 0.0;
    for (auto e = index_of(op.row_begin[p]); e < index_of(op.row_begin[p + 1]); ++e)
      x += op.value[e] * cloud.position[op.node[e]].x();
    second += op.volume[p] * x * x;
  }
  EXPECT_NEAR(second, 1.0 / 3.0, 1e-13);
}

TEST(Efg, has_negative_values_but_no_negative_masses) {
  const Cloud<2> cloud = jittered_square(0.05, 0.2, 8);
  const auto result = Efg().rebuild(cloud);
  const Field& value = result.mechanics.value;
  const double least = *std::min_element(value.begin(), value.end());
  EXPECT_LT(least, -0.02);
  EXPECT_GT(least, -0.1);
  double sum = 0.0;
  for (const double v : result.node_volume) {
    EXPECT_GT(v, 0.0);
    sum += v;
  }
  EXPECT_NEAR(sum, 1.0, 1e-12);
}

TEST(Efg, refuses_supports_out_of_range_and_bodies_of_revolution) {
  EXPECT_THROW(Efg(1.0), InputError);
  EXPECT_THROW(methods::make<2>("efg", {.space = Space::revolution}), InputError);
  EXPECT_THROW(methods::make<3>("efg", {}), InputError);
  EXPECT_THROW(methods::make<2>("cnem", {.least_squares = true, .support = 6.0}), InputError);
}

} // namespace cnem::testing
