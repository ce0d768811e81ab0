// Particles with constant stress in balance, beyond the contract (tests/contract): how little they differ
// from those without, and that a boundary that is moved moves the interior with it.
#include "core/error.hpp"
#include "core/index.hpp"
#include "methods/sph_consistent.hpp"
#include "tests/unit/methods/patch.hpp"

#include <gtest/gtest.h>

namespace cnem::testing {
namespace {

using methods::ConsistentSph;
using methods::Sph;

/// Σ_i V_i b_ij of each node.
std::vector<Vec2> forces_of_unit_pressure(const DiscreteOperators<2>& op) {
  std::vector<Vec2> force(index_of(op.nodes), Vec2::Zero());
  for (std::size_t j = 0; j < force.size(); ++j)
    for (auto e = index_of(op.col_begin[j]); e < index_of(op.col_begin[j + 1]); ++e)
      force[j] += Vec2(op.weighted_gradient[0][e], op.weighted_gradient[1][e]);
  return force;
}

TEST(ConsistentSph, takes_constant_stress_to_the_boundary_in_whatever_cloud) {
  for (const double jitter : {0.0, 0.1, 0.3}) {
    const Cloud<2> cloud = rectangle(1, 1, 0.05, Lattice::hexagonal, jitter);
    const auto force = forces_of_unit_pressure(ConsistentSph().rebuild(cloud).mechanics);
    for (std::size_t j = 0; j < force.size(); ++j) {
      const Vec2& x = cloud.position[as<NodeIndex>(j)];
      if (x.cwiseMin(Vec2(1, 1) - x).minCoeff() > 1e-12) { EXPECT_LT(force[j].norm(), 1e-13) << jitter; }
    }
  }
}

TEST(ConsistentSph, changes_gradients_little_deep_inside_a_lattice) {
  const Cloud<2> cloud = rectangle(2, 2, 0.05, Lattice::square, 0.0);
  const auto plain = Sph().rebuild(cloud).mechanics, balanced = ConsistentSph().rebuild(cloud).mechanics;
  double inside = 0.0, most = 0.0;
  for (std::size_t i = 0; i < index_of(plain.points); ++i) {
    const Vec2& x = cloud.position[as<NodeIndex>(i)];
    const bool deep = x.cwiseMin(Vec2(2, 2) - x).minCoeff() > 0.5;
    for (auto e = index_of(plain.row_begin[i]); e < index_of(plain.row_begin[i + 1]); ++e) {
      const double change = 0.05 * std::abs(balanced.gradient[0][e] - plain.gradient[0][e]);
      (deep ? inside : most) = std::max(deep ? inside : most, change);
    }
  }
  EXPECT_GT(most, 0.01) << "at the boundary";
  EXPECT_LT(inside, 0.02 * most);
}

TEST(ConsistentSph, passes_the_patch_test_on_new_references_too) {
  for (const int every : {0, 50}) // `sph`: 2 and 4 to 7%
    EXPECT_LT(patch_error(std::make_unique<ConsistentSph>(), 1e-3, every), 1e-9) << every;
}

} // namespace
} // namespace cnem::testing
