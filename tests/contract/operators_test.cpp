// What every discretisation keeps (core/operators.hpp, core/discretisation.hpp) and what each promises beyond
// (core/promises.hpp), to rounding, on convex and non-convex domains. Gradients are compared after
// multiplication with the spacing.
#include "contract.hpp"

namespace cnem::testing {
namespace {

constexpr double tolerance = 1e-12;

using Tensors = std::vector<Mat2>;

Tensors gradient_of(const DiscreteOperators<2>& op, const std::vector<Vec2>& nodal) {
  Tensors g(index(op.points), Mat2::Zero());
  for_each_entry(op, [&](std::size_t p, std::size_t e, std::size_t j) {
    g[p] += nodal[j] * gradient(op, e).transpose();
  });
  return g;
}

/// f_J = −Σ_p P_p (V b)_pJ, gathered through the transpose as the solver does.
std::vector<Vec2> internal_force(const DiscreteOperators<2>& op, const Tensors& stress) {
  std::vector<Vec2> f(index(op.nodes), Vec2::Zero());
  for (std::size_t j = 0; j < f.size(); ++j)
    for (auto e = index(op.col_begin[j]); e < index(op.col_begin[j + 1]); ++e)
      f[j] -= stress[index(op.point[e])] * Vec2(op.weighted_gradient[0][e], op.weighted_gradient[1][e]);
  return f;
}

std::vector<Vec2> random_vectors(std::size_t n, std::uint64_t seed) {
  Random random(seed);
  std::vector<Vec2> v(n);
  for (Vec2& a : v) a = {random.uniform(-1, 1), random.uniform(-1, 1)};
  return v;
}

Tensors random_tensors(std::size_t n, std::uint64_t seed) {
  Random random(seed);
  Tensors t(n);
  for (Mat2& a : t)
    for (int k = 0; k < 4; ++k) a(k) = random.uniform(-1, 1);
  return t;
}

TEST_P(Contract, rows_are_complete_and_sorted_by_node) {
  on_all_operators([](const NamedCloud& domain, const DiscreteOperators<2>& op) {
    ASSERT_EQ(op.nodes, domain.cloud.nodes());
    ASSERT_EQ(op.row_begin.size(), index(op.points) + 1);
    ASSERT_EQ(op.volume.size(), index(op.points));
    ASSERT_EQ(index(op.row_begin.back()), op.node.size());
    ASSERT_EQ(op.value.size(), op.nodal ? 0 : op.node.size());
    for (std::size_t p = 0; p < index(op.points); ++p) {
      ASSERT_GT(op.volume[p], 0.0);
      ASSERT_GE(op.row_begin[p + 1] - op.row_begin[p], 3);
      for (auto e = index(op.row_begin[p]) + 1; e < index(op.row_begin[p + 1]); ++e)
        ASSERT_LT(op.node[e - 1], op.node[e]);
    }
  });
}

TEST_P(Contract, gradients_of_constants_vanish) {
  on_all_operators([](const NamedCloud& domain, const DiscreteOperators<2>& op) {
    std::vector<Vec2> sum(index(op.points), Vec2::Zero());
    for_each_entry(op, [&](std::size_t p, std::size_t e, std::size_t) { sum[p] += gradient(op, e); });
    for (const Vec2& s : sum) EXPECT_LT(s.norm() * domain.spacing, tolerance);
  });
}

TEST_P(Contract, patch_gradients_of_positions_are_the_identity) {
  on_all_operators([](const NamedCloud& domain, const DiscreteOperators<2>& op) {
    for (const Mat2& g : gradient_of(op, domain.cloud.position))
      EXPECT_LT((g - Mat2::Identity()).norm(), tolerance);
  });
}

TEST_P(Contract, patch_linear_displacement_gives_constant_deformation) {
  Mat2 f;
  f << 1.3, 0.4, -0.2, 0.8;
  on_all_operators([&](const NamedCloud& domain, const DiscreteOperators<2>& op) {
    std::vector<Vec2> x = domain.cloud.position;
    for (Vec2& a : x) a = f * a + Vec2(0.1, -0.3);
    for (const Mat2& g : gradient_of(op, x)) EXPECT_LT((g - f).norm(), tolerance);
  });
}

TEST_P(Contract, values_are_a_partition_of_unity) {
  on_all_operators([](const NamedCloud&, const DiscreteOperators<2>& op) {
    std::vector<double> sum(index(op.points), 0.0);
    for_each_entry(op, [&](std::size_t p, std::size_t e, std::size_t) { sum[p] += value(op, p, e); });
    for (const double s : sum) EXPECT_NEAR(s, 1.0, tolerance);
  });
}

TEST_P(Contract, declares_the_promises_of_the_registry) {
  const auto method = GetParam().make();
  for (const Promise promise : all_promises)
    EXPECT_EQ(method->promises().keep(promise), GetParam().entry->promises.keep(promise)) << name_of(promise);
}

TEST_P(Contract, promised_one_point_per_node) {
  on_operators_that_keep(Promise::one_point_per_node, [](const NamedCloud&, const DiscreteOperators<2>& op) {
    ASSERT_EQ(op.points, op.nodes);
    std::vector<bool> own(index(op.nodes), false);
    for_each_entry(op, [&](std::size_t p, std::size_t, std::size_t j) {
      if (j == p) own[p] = true;
    });
    for (std::size_t p = 0; p < own.size(); ++p) EXPECT_TRUE(own[p]) << "row " << p;
  });
}

TEST_P(Contract, promised_identity_is_declared_by_operators_without_values) {
  on_every_domain([](const NamedCloud&, const Approximation<2>& approximation) {
    EXPECT_EQ(approximation.mechanics.nodal, promised(Promise::identity_values));
  });
}

TEST_P(Contract, promised_values_are_not_negative) {
  on_operators_that_keep(Promise::non_negative_values, [](const NamedCloud&, const DiscreteOperators<2>& op) {
    for_each_entry(op, [&](std::size_t p, std::size_t e, std::size_t) { EXPECT_GE(value(op, p, e), 0.0); });
  });
}

TEST_P(Contract, promised_volumes_fill_the_domain) {
  on_operators_that_keep(Promise::tiling_cells, [](const NamedCloud& domain, const DiscreteOperators<2>& op) {
    double sum = 0.0;
    for (const double v : op.volume) sum += v;
    const double exact = area(domain.cloud);
    EXPECT_NEAR(sum, exact, tolerance * exact);
  });
}

TEST_P(Contract, node_volume_is_the_share_of_each_node) {
  on_every_domain([](const NamedCloud&, const Approximation<2>& approximation) {
    const auto& op = approximation.mechanics;
    std::vector<double> share(index(op.nodes), 0.0);
    for_each_entry(
        op, [&](std::size_t p, std::size_t e, std::size_t j) { share[j] += op.volume[p] * value(op, p, e); });
    ASSERT_EQ(approximation.node_volume.size(), share.size());
    for (std::size_t j = 0; j < share.size(); ++j)
      EXPECT_NEAR(approximation.node_volume[j], share[j], tolerance * share[j]);
  });
}

TEST_P(Contract, transpose_repeats_the_rows) {
  on_all_operators([](const NamedCloud&, const DiscreteOperators<2>& op) {
    ASSERT_EQ(op.col_begin.size(), index(op.nodes) + 1);
    ASSERT_EQ(op.point.size(), op.node.size());
    std::vector<std::size_t> next(op.col_begin.begin(), op.col_begin.end() - 1);
    for_each_entry(op, [&](std::size_t p, std::size_t e, std::size_t j) {
      const std::size_t t = next[j]++;
      ASSERT_LT(t, index(op.col_begin[j + 1]));
      ASSERT_EQ(index(op.point[t]), p);
      for (std::size_t k = 0; k < 2; ++k)
        ASSERT_EQ(op.weighted_gradient[k][t], op.volume[p] * op.gradient[k][e]);
      if (!op.nodal) { ASSERT_EQ(op.weighted_value[t], op.volume[p] * op.value[e]); }
    });
  });
}

TEST_P(Contract, power_of_forces_balances_power_of_stresses) {
  on_all_operators([](const NamedCloud&, const DiscreteOperators<2>& op) {
    const auto velocity = random_vectors(index(op.nodes), 1);
    const Tensors stress = random_tensors(index(op.points), 2);
    const auto force = internal_force(op, stress);
    const Tensors rate = gradient_of(op, velocity);
    double external = 0.0, internal = 0.0, scale = 0.0;
    for (std::size_t j = 0; j < force.size(); ++j) {
      external += force[j].dot(velocity[j]);
      scale += force[j].norm() * velocity[j].norm();
    }
    for (std::size_t p = 0; p < rate.size(); ++p)
      internal -= op.volume[p] * stress[p].cwiseProduct(rate[p]).sum();
    EXPECT_NEAR(external, internal, tolerance * scale);
  });
}

TEST_P(Contract, internal_forces_sum_to_zero_and_carry_no_moment_under_symmetric_stress) {
  on_all_operators([](const NamedCloud& domain, const DiscreteOperators<2>& op) {
    Tensors stress = random_tensors(index(op.points), 3);
    for (Mat2& s : stress) s = (s + s.transpose()).eval();
    const auto force = internal_force(op, stress);
    Vec2 sum = Vec2::Zero();
    double moment = 0.0, scale = 0.0;
    for (std::size_t j = 0; j < force.size(); ++j) {
      sum += force[j];
      moment += cross(domain.cloud.position[j], force[j]);
      scale += force[j].norm();
    }
    EXPECT_LT(sum.norm(), tolerance * scale);
    EXPECT_LT(std::abs(moment), tolerance * scale);
  });
}

TEST_P(Contract, constant_stress_has_the_virial_of_its_volume) {
  Mat2 stress;
  stress << 2.0, -0.7, 0.5, 1.1;
  on_all_operators([&](const NamedCloud& domain, const DiscreteOperators<2>& op) {
    Mat2 virial = Mat2::Zero();
    double volume = 0.0;
    for (const double v : op.volume) volume += v;
    const auto force = internal_force(op, Tensors(index(op.points), stress));
    for (std::size_t j = 0; j < force.size(); ++j) virial -= force[j] * domain.cloud.position[j].transpose();
    EXPECT_LT((virial - volume * stress).norm(), tolerance * volume);
  });
}

TEST_P(Contract, promised_patch_constant_stress_loads_the_boundary_only) {
  Mat2 stress;
  stress << 2.0, -0.7, 0.5, 1.1;
  on_operators_that_keep(Promise::balanced_constant_stress,
                         [&](const NamedCloud& domain, const DiscreteOperators<2>& op) {
                           // Each boundary edge hands half of its traction P·n L to either end; no other node
                           // is loaded.
                           std::vector<Vec2> expected(index(op.nodes), Vec2::Zero());
                           for (const auto& facet : domain.cloud.facets) {
                             const Vec2 n = right_normal(domain.cloud.position[index(facet.node[1])] -
                                                         domain.cloud.position[index(facet.node[0])]);
                             for (const auto j : facet.node) expected[index(j)] -= 0.5 * stress * n;
                           }
                           const auto force = internal_force(op, Tensors(index(op.points), stress));
                           for (std::size_t j = 0; j < force.size(); ++j)
                             EXPECT_LT((force[j] - expected[j]).norm(), tolerance * domain.spacing);
                         });
}

} // namespace

INSTANTIATE_TEST_SUITE_P(methods, Contract, ::testing::ValuesIn(methods()),
                         [](const auto& test) { return test.param.name; });

} // namespace cnem::testing
