// What every discretisation that promises hoop rows keeps on bodies of revolution, to rounding, on domains
// that touch the axis and on domains away from it.
#include "contract.hpp"
#include "core/error.hpp"
#include "core/geometry/revolution.hpp"

namespace cnem::testing {
namespace {

/// The domains of the suite, moved to touch the axis and to stand half their size away from it.
std::vector<Domain<2>> revolved_domains() {
  std::vector<Domain<2>> list;
  for (const double gap : {0.0, 0.5})
    for (Domain<2> domain : all_domains<2>()) {
      double least = 1e9;
      for (const Vec2& x : domain.cloud.position) least = std::min(least, x.x());
      for (Vec2& x : domain.cloud.position) x.x() += gap - least;
      domain.name += gap > 0.0 ? " away from the axis" : " on the axis";
      list.push_back(domain);
    }
  return list;
}

/// 2π ∫ r dA by Gauss's theorem over the boundary: the volume of the solid.
double solid_volume(const Cloud<2>& cloud) {
  double sum = 0.0;
  for (const Facet<2>& facet : cloud.facets) {
    const Vec2 &a = cloud.position[index(facet.node[0])], &b = cloud.position[index(facet.node[1])];
    sum += (a.x() * a.x() + a.x() * b.x() + b.x() * b.x()) / 3.0 * (b.y() - a.y());
  }
  return std::numbers::pi * sum;
}

class Revolution : public ::testing::TestWithParam<Method> {
protected:
  template<class Check> void on_all_operators(Check&& check) const {
    for (const Domain<2>& domain : revolved_domains()) {
      SCOPED_TRACE(domain.name);
      const Approximation<2> approximation = GetParam().make(domain)->rebuild(domain.cloud);
      {
        SCOPED_TRACE("mechanics");
        check(domain, approximation.mechanics);
      }
      SCOPED_TRACE("conduction");
      check(domain, approximation.conduction);
    }
  }
};

TEST_P(Revolution, gradients_of_constants_vanish_and_of_positions_are_the_identity) {
  on_all_operators([](const Domain<2>& domain, const DiscreteOperators<2>& op) {
    std::vector<Vec2> sum(index(op.points), Vec2::Zero());
    std::vector<Mat2> g(index(op.points), Mat2::Zero());
    for_each_entry(op, [&](std::size_t p, std::size_t e, std::size_t j) {
      sum[p] += gradient(op, e);
      g[p] += domain.cloud.position[j] * gradient(op, e).transpose();
    });
    for (std::size_t p = 0; p < g.size(); ++p) {
      EXPECT_LT(sum[p].norm() * domain.spacing, tolerance);
      EXPECT_LT((g[p] - Mat2::Identity()).norm(), tolerance);
    }
  });
}

TEST_P(Revolution, hoop_rows_see_a_uniform_radial_stretch) {
  on_all_operators([](const Domain<2>& domain, const DiscreteOperators<2>& op) {
    ASSERT_TRUE(op.of_revolution());
    std::vector<double> stretch(index(op.points), 0.0), share(stretch);
    for_each_entry(op, [&](std::size_t p, std::size_t e, std::size_t j) {
      EXPECT_GE(op.hoop[e], 0.0);
      stretch[p] += op.hoop[e] * 1.7 * domain.cloud.position[j].x();
      share[p] += op.hoop[e] * op.radius[p];
    });
    for (std::size_t p = 0; p < stretch.size(); ++p) {
      EXPECT_NEAR(stretch[p], 1.7, tolerance);
      EXPECT_NEAR(share[p], 1.0, tolerance);
    }
  });
}

TEST_P(Revolution, volumes_fill_the_solid) {
  on_all_operators([](const Domain<2>& domain, const DiscreteOperators<2>& op) {
    double sum = 0.0, carried = 0.0;
    for (const double v : op.volume) {
      EXPECT_GT(v, 0.0);
      sum += v;
    }
    for (const double v : op.node_volume()) carried += v;
    const double exact = solid_volume(domain.cloud);
    EXPECT_NEAR(sum, exact, tolerance * exact);
    EXPECT_NEAR(carried, exact, tolerance * exact);
  });
}

TEST_P(Revolution, transpose_repeats_the_rows) {
  on_all_operators([](const Domain<2>&, const DiscreteOperators<2>& op) {
    std::vector<std::size_t> next(op.col_begin.begin(), op.col_begin.end() - 1);
    for_each_entry(op, [&](std::size_t p, std::size_t e, std::size_t j) {
      const std::size_t t = next[j]++;
      ASSERT_EQ(index(op.point[t]), p);
      ASSERT_EQ(op.weighted_hoop[t], op.volume[p] * op.hoop[e]);
    });
  });
}

TEST_P(Revolution, patch_uniform_pressure_loads_the_boundary_only) {
  on_all_operators([](const Domain<2>& domain, const DiscreteOperators<2>& op) {
    std::vector<Vec2> expected(index(op.nodes), Vec2::Zero()), force(expected);
    for (const Facet<2>& facet : domain.cloud.facets) {
      const Vec2 &a = domain.cloud.position[index(facet.node[0])],
                 &b = domain.cloud.position[index(facet.node[1])];
      const Vec2 n = right_normal(b - a).normalized();
      const auto area = end_areas(Space::revolution, a, b);
      for (std::size_t k = 0; k < 2; ++k) expected[index(facet.node[k])] -= area[k] * n;
    }
    for (std::size_t j = 0; j < force.size(); ++j) {
      for (auto e = index(op.col_begin[j]); e < index(op.col_begin[j + 1]); ++e)
        force[j] -= Vec2(op.weighted_gradient[0][e] + op.weighted_hoop[e], op.weighted_gradient[1][e]);
      EXPECT_LT((force[j] - expected[j]).norm(), tolerance * domain.spacing);
    }
  });
}

TEST_P(Revolution, patch_uniform_axial_stress_loads_the_boundary_only) {
  on_all_operators([](const Domain<2>& domain, const DiscreteOperators<2>& op) {
    for (std::size_t j = 0; j < index(op.nodes); ++j) {
      double axial = 0.0, exact = 0.0;
      for (auto e = index(op.col_begin[j]); e < index(op.col_begin[j + 1]); ++e)
        axial += op.weighted_gradient[1][e];
      for (const Facet<2>& facet : domain.cloud.facets)
        for (std::size_t k = 0; k < 2; ++k)
          if (index(facet.node[k]) == j) {
            const Vec2 &a = domain.cloud.position[index(facet.node[0])],
                       &b = domain.cloud.position[index(facet.node[1])];
            exact += end_areas(Space::revolution, a, b)[k] * right_normal(b - a).normalized().y();
          }
      EXPECT_NEAR(axial, exact, tolerance * domain.spacing);
    }
  });
}

TEST(RevolvedSolids, methods_without_hoop_rows_are_refused_by_the_promise) {
  for (const methods::Entry& entry : methods::registry()) {
    if (entry.promises.keep(Promise::hoop_rows) || !entry.exists_in(2)) continue;
    try {
      methods::make<2>(entry.name, {.space = Space::revolution});
      FAIL() << entry.name;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("hoop rows of bodies of revolution"), std::string::npos)
          << error.what();
    }
  }
}

TEST(RevolvedSolids, cylinder_and_cone_have_their_volumes) {
  Cloud<2> cylinder, cone;
  add_loop(cylinder, {{0.5, 0}, {2, 0}, {2, 3}, {0.5, 3}}, 0.2);
  fill(cylinder, Lattice::hexagonal, 0.2, 0.2, 0.1, 1);
  add_loop(cone, {{0, 0}, {1, 0}, {0, 2}}, 0.1);
  fill(cone, Lattice::hexagonal, 0.1, 0.2, 0.05, 1);
  const auto volume = [](const Cloud<2>& cloud) {
    double sum = 0.0;
    for (const double v : scni::Cnem({.space = Space::revolution}).rebuild(cloud).node_volume) sum += v;
    return sum;
  };
  EXPECT_NEAR(volume(cylinder), std::numbers::pi * (4.0 - 0.25) * 3.0, 1e-11);
  EXPECT_NEAR(volume(cone), std::numbers::pi * 2.0 / 3.0, 1e-12);
}

INSTANTIATE_TEST_SUITE_P(methods, Revolution, ::testing::ValuesIn(methods(Space::revolution)),
                         [](const auto& test) { return test.param.name; });

} // namespace
} // namespace cnem::testing
