// What every discretisation keeps (core/operators/operators.hpp, core/operators/discretisation.hpp) and what
// each promises beyond (core/operators/promises.hpp), to rounding, on convex and non-convex domains.
// Gradients are compared after multiplication with the spacing.
#include "contract.hpp"
#include "core/operators/operator_checks.hpp"

namespace cnem::testing {
namespace {

template<int dim> using Vectors = std::vector<Vec<dim>>;
template<int dim> using Tensors = std::vector<Mat<dim>>;

template<int dim> Tensors<dim> gradient_of(const DiscreteOperators<dim>& op, const Vectors<dim>& nodal) {
  Tensors<dim> g(index(op.points), Mat<dim>::Zero());
  for_each_entry(op, [&](std::size_t p, std::size_t e, std::size_t j) {
    g[p] += nodal[j] * gradient(op, e).transpose();
  });
  return g;
}

/// f_J = −Σ_p P_p (V b)_pJ, gathered through the transpose as the solver does.
template<int dim> Vectors<dim> internal_force(const DiscreteOperators<dim>& op, const Tensors<dim>& stress) {
  Vectors<dim> f(index(op.nodes), Vec<dim>::Zero());
  for (std::size_t j = 0; j < f.size(); ++j)
    for (auto e = index(op.col_begin[j]); e < index(op.col_begin[j + 1]); ++e)
      f[j] -= stress[index(op.point[e])] * vector_at<dim>(op.weighted_gradient, e);
  return f;
}

template<int dim> Vectors<dim> random_vectors(std::size_t n, std::uint64_t seed) {
  Random random(seed);
  Vectors<dim> v(n);
  for (Vec<dim>& a : v)
    for (double& component : a) component = random.uniform(-1, 1);
  return v;
}

template<int dim> Tensors<dim> random_tensors(std::size_t n, std::uint64_t seed) {
  Random random(seed);
  Tensors<dim> t(n);
  for (Mat<dim>& a : t)
    for (double& component : a.reshaped()) component = random.uniform(-1, 1);
  return t;
}

/// Neither symmetric nor traceless; the leading block of the one in space.
template<int dim> Mat<dim> some_tensor() {
  Mat<3> t;
  t << 2.0, -0.7, 0.3, 0.5, 1.1, -0.4, 0.8, 0.2, -1.6;
  return t.topLeftCorner<dim, dim>();
}

TEST_P(Contract, rows_are_complete_and_sorted_by_node) {
  on_all_operators([]<int dim>(const Domain<dim>& domain, const DiscreteOperators<dim>& op) {
    ASSERT_EQ(op.nodes, domain.cloud.nodes());
    ASSERT_EQ(op.row_begin.size(), index(op.points) + 1);
    ASSERT_EQ(op.volume.size(), index(op.points));
    ASSERT_EQ(index(op.row_begin.back()), op.node.size());
    ASSERT_EQ(op.value.size(), op.nodal ? 0 : op.node.size());
    for (std::size_t p = 0; p < index(op.points); ++p) {
      ASSERT_GT(op.volume[p], 0.0);
      ASSERT_GT(op.row_begin[p + 1] - op.row_begin[p], dim);
      for (auto e = index(op.row_begin[p]) + 1; e < index(op.row_begin[p + 1]); ++e)
        ASSERT_LT(op.node[e - 1], op.node[e]);
    }
  });
}

/// What builds with assertions check of all operators (core/operators/operator_checks.hpp).
TEST_P(Contract, checks_for_assertions_pass_operators_and_see_damaged_ones) {
  on_all_operators([]<int dim>(const Domain<dim>& domain, const DiscreteOperators<dim>& op) {
    EXPECT_TRUE(rows_are_complete(op));
    EXPECT_TRUE(reproduces_linear_fields(op, domain.cloud.position));
    const auto damaged = [&](auto&& damage) {
      DiscreteOperators<dim> changed = op;
      damage(changed);
      return changed;
    };
    const auto is_complete = [&](auto&& damage) { return rows_are_complete(damaged(damage)); };
    EXPECT_FALSE(is_complete([](auto& o) { o.volume.back() = 0.0; }));
    EXPECT_FALSE(is_complete([](auto& o) { std::swap(o.node[0], o.node[1]); }));
    EXPECT_FALSE(is_complete([](auto& o) { o.node[index(o.row_begin[1]) - 1] = as<NodeIndex>(o.nodes); }));
    EXPECT_FALSE(is_complete([](auto& o) { o.gradient[dim - 1].pop_back(); }));
    EXPECT_FALSE(is_complete([](auto& o) { o.hoop.push_back(1.0); }));
    const auto reproduces = [&](auto&& damage) {
      return reproduces_linear_fields(damaged(damage), domain.cloud.position);
    };
    EXPECT_FALSE(
        reproduces([](auto& o) { o.gradient[dim - 1][1] += 1e-6 * vector_at<dim>(o.gradient, 1).norm(); }));
    EXPECT_FALSE(reproduces([](auto& o) {
      for (double& g : o.gradient[0]) g *= 1.0 + 1e-6; // constants still have no gradient
    }));
  });
}

TEST_P(Contract, gradients_of_constants_vanish) {
  on_all_operators([]<int dim>(const Domain<dim>& domain, const DiscreteOperators<dim>& op) {
    Vectors<dim> sum(index(op.points), Vec<dim>::Zero());
    for_each_entry(op, [&](std::size_t p, std::size_t e, std::size_t) { sum[p] += gradient(op, e); });
    for (const Vec<dim>& s : sum) EXPECT_LT(s.norm() * domain.spacing, tolerance);
  });
}

TEST_P(Contract, patch_gradients_of_positions_are_the_identity) {
  on_all_operators([]<int dim>(const Domain<dim>& domain, const DiscreteOperators<dim>& op) {
    for (const Mat<dim>& g : gradient_of(op, domain.cloud.position))
      EXPECT_LT((g - Mat<dim>::Identity()).norm(), tolerance);
  });
}

TEST_P(Contract, patch_linear_displacement_gives_constant_deformation) {
  on_all_operators([]<int dim>(const Domain<dim>& domain, const DiscreteOperators<dim>& op) {
    const Mat<dim> f = Mat<dim>::Identity() + 0.5 * some_tensor<dim>();
    Vectors<dim> x = domain.cloud.position;
    for (Vec<dim>& a : x) a = f * a + Vec<dim>::LinSpaced(0.1, -0.3);
    for (const Mat<dim>& g : gradient_of(op, x)) EXPECT_LT((g - f).norm(), tolerance);
  });
}

TEST_P(Contract, values_are_a_partition_of_unity) {
  on_all_operators([]<int dim>(const Domain<dim>&, const DiscreteOperators<dim>& op) {
    std::vector<double> sum(index(op.points), 0.0);
    for_each_entry(op, [&](std::size_t p, std::size_t e, std::size_t) { sum[p] += value(op, p, e); });
    for (const double s : sum) EXPECT_NEAR(s, 1.0, tolerance);
  });
}

TEST_P(Contract, declares_the_promises_of_the_registry) {
  on_every_cloud([](const auto& domain) {
    const auto method = GetParam().make(domain);
    for (const Promise promise : all_promises) {
      if (GetParam().dim == 3 && promise == Promise::hoop_rows) continue; // there are none in space
      EXPECT_EQ(method->promises().keep(promise), promised(promise)) << name_of(promise);
    }
  });
}

TEST_P(Contract, promised_one_point_per_node) {
  on_operators_that_keep(Promise::one_point_per_node,
                         []<int dim>(const Domain<dim>&, const DiscreteOperators<dim>& op) {
                           ASSERT_EQ(op.points, op.nodes);
                           std::vector<bool> own(index(op.nodes), false);
                           for_each_entry(op, [&](std::size_t p, std::size_t, std::size_t j) {
                             if (j == p) own[p] = true;
                           });
                           for (std::size_t p = 0; p < own.size(); ++p) EXPECT_TRUE(own[p]) << "row " << p;
                         });
}

TEST_P(Contract, promised_identity_is_declared_by_operators_without_values) {
  on_every_domain([]<int dim>(const Domain<dim>&, const Approximation<dim>& approximation) {
    EXPECT_EQ(approximation.mechanics.nodal, promised(Promise::identity_values));
  });
}

TEST_P(Contract, promised_values_are_not_negative) {
  on_operators_that_keep(Promise::non_negative_values, []<int dim>(const Domain<dim>&,
                                                                   const DiscreteOperators<dim>& op) {
    for_each_entry(op, [&](std::size_t p, std::size_t e, std::size_t) { EXPECT_GE(value(op, p, e), 0.0); });
  });
}

TEST_P(Contract, promised_volumes_fill_the_domain) {
  on_operators_that_keep(Promise::tiling_cells,
                         []<int dim>(const Domain<dim>& domain, const DiscreteOperators<dim>& op) {
                           double sum = 0.0;
                           for (const double v : op.volume) sum += v;
                           const double exact = enclosed_measure(domain.cloud);
                           EXPECT_NEAR(sum, exact, tolerance * exact);
                         });
}

TEST_P(Contract, node_volume_is_the_share_of_each_node) {
  on_every_domain([]<int dim>(const Domain<dim>&, const Approximation<dim>& approximation) {
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
  on_all_operators([]<int dim>(const Domain<dim>&, const DiscreteOperators<dim>& op) {
    ASSERT_EQ(op.col_begin.size(), index(op.nodes) + 1);
    ASSERT_EQ(op.point.size(), op.node.size());
    std::vector<std::size_t> next(op.col_begin.begin(), op.col_begin.end() - 1);
    for_each_entry(op, [&](std::size_t p, std::size_t e, std::size_t j) {
      const std::size_t t = next[j]++;
      ASSERT_LT(t, index(op.col_begin[j + 1]));
      ASSERT_EQ(index(op.point[t]), p);
      for (std::size_t k = 0; k < dim; ++k)
        ASSERT_EQ(op.weighted_gradient[k][t], op.volume[p] * op.gradient[k][e]);
      if (!op.nodal) { ASSERT_EQ(op.weighted_value[t], op.volume[p] * op.value[e]); }
    });
  });
}

TEST_P(Contract, power_of_forces_balances_power_of_stresses) {
  on_all_operators([]<int dim>(const Domain<dim>&, const DiscreteOperators<dim>& op) {
    const auto velocity = random_vectors<dim>(index(op.nodes), 1);
    const auto stress = random_tensors<dim>(index(op.points), 2);
    const auto force = internal_force(op, stress);
    const auto rate = gradient_of(op, velocity);
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
  on_all_operators([]<int dim>(const Domain<dim>& domain, const DiscreteOperators<dim>& op) {
    auto stress = random_tensors<dim>(index(op.points), 3);
    for (Mat<dim>& s : stress) s = (s + s.transpose()).eval();
    const auto force = internal_force(op, stress);
    Vec<dim> sum = Vec<dim>::Zero();
    Mat<dim> moment = Mat<dim>::Zero();
    double scale = 0.0;
    for (std::size_t j = 0; j < force.size(); ++j) {
      sum += force[j];
      const Mat<dim> arm = domain.cloud.position[j] * force[j].transpose();
      moment += arm - arm.transpose();
      scale += force[j].norm();
    }
    EXPECT_LT(sum.norm(), tolerance * scale);
    EXPECT_LT(moment.norm(), tolerance * scale);
  });
}

TEST_P(Contract, constant_stress_has_the_virial_of_its_volume) {
  on_all_operators([]<int dim>(const Domain<dim>& domain, const DiscreteOperators<dim>& op) {
    const Mat<dim> stress = some_tensor<dim>();
    Mat<dim> virial = Mat<dim>::Zero();
    double volume = 0.0;
    for (const double v : op.volume) volume += v;
    const auto force = internal_force(op, Tensors<dim>(index(op.points), stress));
    for (std::size_t j = 0; j < force.size(); ++j) virial -= force[j] * domain.cloud.position[j].transpose();
    EXPECT_LT((virial - volume * stress).norm(), tolerance * volume);
  });
}

/// Each boundary facet hands an equal share of its traction P·n A to each corner; no other node is loaded.
TEST_P(Contract, promised_patch_constant_stress_loads_the_boundary_only) {
  on_operators_that_keep(Promise::balanced_constant_stress, []<int dim>(const Domain<dim>& domain,
                                                                        const DiscreteOperators<dim>& op) {
    const Mat<dim> stress = some_tensor<dim>();
    Vectors<dim> expected(index(op.nodes), Vec<dim>::Zero());
    for (const Facet<dim>& facet : domain.cloud.facets) {
      const Vec<dim> normal = area_normal<dim>(corners_of<dim>(facet, domain.cloud.position));
      for (const auto j : facet.node) expected[index(j)] -= stress * normal / dim;
    }
    const auto force = internal_force(op, Tensors<dim>(index(op.points), stress));
    for (std::size_t j = 0; j < force.size(); ++j)
      EXPECT_LT((force[j] - expected[j]).norm(), tolerance * domain.spacing);
  });
}

} // namespace

INSTANTIATE_TEST_SUITE_P(methods, Contract, ::testing::ValuesIn(methods()),
                         [](const auto& test) { return test.param.name; });

} // namespace cnem::testing
