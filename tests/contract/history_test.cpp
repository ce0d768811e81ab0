// What methods that promise carried history keep where a reference is renewed: matter goes over to new points
// in parcels (core/operators/parcels.hpp), on every domain, sheared and waved so that most cells are others.
#include "contract.hpp"
#include "core/operators/parcels.hpp"

#include <omp.h>

namespace cnem::testing {
namespace {

/// Sheared by seven tenths of its height, with a wave of a fifth of the spacing: no cell turns over.
Vec2 moved(const Vec2& x, double spacing) {
  const double wave = 0.2 * spacing;
  return {x.x() + 0.7 * x.y() + wave * std::sin(5.0 * x.y()), x.y() + wave * std::sin(4.0 * x.x() + 1.0)};
}

struct Renewal {
  DiscreteOperators<2> old, now;
  Cloud<2> cloud; ///< that of `now`
  std::optional<PointRows> parcels;

  /// V_k det F_k of an old point where the nodes are now.
  double volume(std::size_t k) const {
    Mat2 f = Mat2::Zero();
    double hoop = old.of_revolution() ? 0.0 : 1.0;
    for (auto e = index(old.row_begin[k]); e < index(old.row_begin[k + 1]); ++e) {
      f += cloud.position[old.node[e]] * gradient(old, e).transpose();
      if (old.of_revolution()) hoop += old.hoop[e] * cloud.position[old.node[e]].x();
    }
    return old.volume[k] * f.determinant() * hoop;
  }
  std::array<NodeIndex, 3> corners(const DiscreteOperators<2>& op, std::size_t p) const {
    const auto e = index(op.row_begin[p]);
    return {op.node[e], op.node[e + 1], op.node[e + 2]};
  }
};

/// away: how far the domain is moved from the axis beforehand.
Renewal renewed(const Method& method, const Domain<2>& domain, bool deformed = true, double away = 0.0) {
  Renewal renewal;
  Domain<2> start = domain;
  for (Vec2& x : start.cloud.position) x.x() += away;
  const auto made = method.make(start);
  renewal.cloud = start.cloud;
  if (deformed)
    for (Vec2& x : renewal.cloud.position) x = moved(x, domain.spacing);
  renewal.old = made->rebuild(start.cloud).mechanics;
  renewal.now = made->rebuild(renewal.cloud).mechanics;
  renewal.parcels = made->point_parcels(renewal.old, renewal.now, renewal.cloud);
  return renewal;
}

class History : public ::testing::TestWithParam<Method> {
protected:
  template<class Check> static void on_every_renewal(Check&& check) {
    if (!GetParam().entry->promises.keep(Promise::carried_history)) GTEST_SKIP() << "not promised";
    if (GetParam().entry->promises.keep(Promise::one_point_per_node)) GTEST_SKIP() << "points stay nodes'";
    // of revolution: away from the axis, from where the wave would carry nodes over it
    const double away = GetParam().options.space == Space::revolution ? 2.0 : 0.0;
    for (const Domain<2>& domain : all_domains<2>()) {
      SCOPED_TRACE(domain.name);
      const Renewal renewal = renewed(GetParam(), domain, true, away);
      ASSERT_TRUE(renewal.parcels.has_value());
      ASSERT_EQ(renewal.parcels->size(), index(renewal.now.points));
      check(renewal, *renewal.parcels);
    }
  }
};

std::vector<Method> all_methods() {
  std::vector<Method> list;
  for (const Space space : {Space::plane, Space::revolution})
    for (Method method : methods(space)) {
      if (method.dim != 2) continue;
      if (space == Space::revolution) method.name += "_of_revolution";
      list.push_back(method);
    }
  return list;
}

TEST_P(History, promised_points_of_nodes_stay_those_of_the_same_nodes) {
  if (!GetParam().entry->promises.keep(Promise::one_point_per_node)) GTEST_SKIP() << "not promised";
  EXPECT_TRUE(GetParam().entry->promises.keep(Promise::carried_history));
  for (const Domain<2>& domain : all_domains<2>()) {
    const Renewal renewal = renewed(GetParam(), domain, true, 2.0);
    EXPECT_FALSE(renewal.parcels.has_value()) << domain.name;
    EXPECT_EQ(renewal.old.points, renewal.now.points) << domain.name;
  }
}

TEST_P(History, promised_matter_is_shared_out_whole_and_fills_the_new_points) {
  on_every_renewal([](const Renewal& renewal, const PointRows& rows) {
    std::vector<double> given(index(renewal.old.points), 0.0);
    std::size_t mixed = 0;
    for (std::size_t p = 0; p < rows.size(); ++p) {
      double volume = 0.0;
      ASSERT_LT(rows.begin[p], rows.begin[p + 1]);
      for (auto e = index(rows.begin[p]); e < index(rows.begin[p + 1]); ++e) {
        EXPECT_GT(rows.weight[e], 0.0);
        given[index(rows.from[e])] += rows.weight[e];
        volume += rows.weight[e] * renewal.volume(index(rows.from[e]));
      }
      EXPECT_NEAR(volume, renewal.now.volume[p], 1e-10 * renewal.now.volume[p]);
      mixed += rows.mixed(p);
    }
    for (const double sum : given) EXPECT_NEAR(sum, 1.0, 1e-13);
    EXPECT_GT(mixed, rows.size() / 25) << "nothing is new";
  });
}

TEST_P(History, promised_means_keep_constants_and_sums) {
  on_every_renewal([](const Renewal& renewal, const PointRows& rows) {
    Random random(9);
    Field mass(index(renewal.old.points)), varied(mass.size()), constant(mass.size(), 0.1);
    double sum = 0.0, scale = 0.0;
    for (std::size_t k = 0; k < mass.size(); ++k) {
      mass[k] = random.uniform(0.1, 1.0);
      varied[k] = random.uniform(-1.0, 1.0);
      sum += mass[k] * varied[k];
      scale += mass[k];
    }
    Field new_mass = mass;
    carry_sum(rows, new_mass);
    carry_mean(rows, mass, varied);
    carry_mean(rows, mass, constant);
    double new_sum = 0.0, total = 0.0;
    for (std::size_t p = 0; p < new_mass.size(); ++p) {
      EXPECT_EQ(constant[p], 0.1);
      new_sum += new_mass[p] * varied[p];
      total += new_mass[p];
    }
    EXPECT_NEAR(total, scale, 1e-13 * scale);
    EXPECT_NEAR(new_sum, sum, 1e-13 * scale);
  });
}

TEST_P(History, promised_points_in_both_keep_their_bits_and_no_others_do) {
  on_every_renewal([](const Renewal& renewal, const PointRows& rows) {
    std::map<std::array<NodeIndex, 3>, std::size_t> old;
    for (std::size_t k = 0; k < index(renewal.old.points); ++k) old[renewal.corners(renewal.old, k)] = k;
    for (std::size_t p = 0; p < rows.size(); ++p) {
      const auto same = old.find(renewal.corners(renewal.now, p));
      EXPECT_EQ(rows.mixed(p), same == old.end());
      if (same != old.end()) { EXPECT_EQ(index(rows.from[index(rows.begin[p])]), same->second); }
    }
  });
}

TEST_P(History, promised_a_cloud_that_has_not_moved_keeps_all_points) {
  if (!GetParam().entry->promises.keep(Promise::carried_history)) GTEST_SKIP() << "not promised";
  for (const Domain<2>& domain : all_domains<2>()) {
    const Renewal renewal = renewed(GetParam(), domain, false, 2.0);
    if (!renewal.parcels) continue;
    for (std::size_t p = 0; p < renewal.parcels->size(); ++p) {
      EXPECT_FALSE(renewal.parcels->mixed(p));
      EXPECT_EQ(index(renewal.parcels->from[p]), p);
    }
  }
}

TEST_P(History, promised_parcels_do_not_depend_on_the_number_of_threads) {
  const int threads = omp_get_max_threads();
  std::vector<PointRows> seen;
  for (const int n : {1, 2, 3}) {
    omp_set_num_threads(n);
    const Renewal renewal = renewed(GetParam(), all_domains<2>().front(), true, 2.0);
    if (renewal.parcels) seen.push_back(*renewal.parcels);
  }
  omp_set_num_threads(threads);
  for (const PointRows& rows : seen) {
    EXPECT_EQ(rows.begin, seen[0].begin);
    EXPECT_EQ(rows.from, seen[0].from);
    EXPECT_EQ(rows.weight, seen[0].weight);
  }
}

INSTANTIATE_TEST_SUITE_P(methods, History, ::testing::ValuesIn(all_methods()),
                         [](const auto& test) { return test.param.name; });

} // namespace
} // namespace cnem::testing
