// All hardening laws against tables that tests/data/flow_stress.py computed without the program: flow stress,
// derivatives, the return map along constant rates, and on every instruction set.
#include "core/error.hpp"
#include "core/machine/isa.hpp"
#include "plasticity/box2.hpp"
#include "tests/each_isa.hpp"
#include "tests/unit/plasticity/points.hpp"
#include "tests/unit/plasticity/tables.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

namespace cnem::plasticity::test {
namespace {

using Constants = std::map<std::string, std::string>;

struct Set {
  std::string law;
  Constants constants;
};

std::map<std::string, Set> sets() {
  std::map<std::string, Set> result;
  for (const Row& r : read_csv("flow_stress_constants.csv")) {
    result[r.at(0)].law = r.at(1);
    result[r.at(0)].constants[r.at(2)] = r.at(3);
  }
  return result;
}

/// f(the law of the set with its constants).
template<class... Law, class F> void with_law(Laws<Law...>, const Set& set, const F& f) {
  const auto try_law = [&]<class One>(std::type_identity<One>) {
    if (set.law != One::name) return;
    One law;
    std::size_t used = 0;
    for (const auto& [member, info] : One::parameters)
      if (const auto given = set.constants.find(info.name); given != set.constants.end()) {
        law.*member = std::stod(given->second);
        ++used;
      }
    if constexpr (requires { One::lists; })
      for (const auto& [member, info] : One::lists) {
        std::istringstream numbers(set.constants.at(info.name));
        NumberList& list = law.*member;
        for (std::string number; std::getline(numbers, number, ';');)
          list.value[list.size++] = std::stod(number);
        ++used;
      }
    ASSERT_EQ(used, set.constants.size()) << set.law;
    f(law);
  };
  (try_law(std::type_identity<Law>{}), ...);
}

Hardening hardening_of(const Set& set) {
  std::optional<Hardening> result;
  with_law(HardeningLaws{}, set, [&](const auto& law) { result = law; });
  return result.value();
}

template<class... Law> std::vector<std::string> names(Laws<Law...>) { return {Law::name...}; }

TEST(flow_stress, every_law_has_a_table) {
  std::vector<std::string> known;
  for (const auto& [name, set] : sets()) known.push_back(set.law);
  for (const std::string& name : names(HardeningLaws{}))
    EXPECT_TRUE(std::find(known.begin(), known.end(), name) != known.end()) << name;
}

TEST(flow_stress, is_that_of_the_table) {
  const auto known = sets();
  const auto rows = read_csv("flow_stress.csv");
  ASSERT_GT(rows.size(), 600u);
  for (const Row& r : rows) {
    const double stress = std::stod(r.at(4));
    EXPECT_NEAR(
        hardening_of(known.at(r.at(0))).flow_stress(std::stod(r[1]), std::stod(r[2]), std::stod(r[3])),
        stress, 1e-13 * stress + 1e-6)
        << r[0] << ' ' << r[1] << ' ' << r[2] << ' ' << r[3];
  }
}

TEST(flow_stress, slopes_and_curvature_are_derivatives) {
  const double h = 1e-5;
  for (const auto& [name, set] : sets())
    with_law(HardeningLaws{}, set, [h, &of = name](const auto& given) {
      const Hardening law = given;
      const auto& constants = law.as<std::decay_t<decltype(given)>>();
      using Jet = generic::Jet<double>;
      for (const double e : {1e-4, 0.03, 0.4, 1.3, 3.0})
        for (const double rate : {1e-3, 30.0, 1e5})
          for (const double t : {100.0, 450.0, 1200.0}) {
            const double stress = law.flow_stress(e, rate, t);
            const double by_strain =
                law.flow_stress(e + h * e, rate, t) - law.flow_stress(e - h * e, rate, t);
            const double by_rate =
                law.flow_stress(e, rate + h * rate, t) - law.flow_stress(e, rate - h * rate, t);
            EXPECT_NEAR(law.hardening_modulus(e, rate, t) * e, by_strain / (2 * h), 1e-8 * stress)
                << of << ' ' << e << ' ' << rate << ' ' << t;
            EXPECT_NEAR(law.rate_modulus(e, rate, t) * rate, by_rate / (2 * h), 1e-8 * stress)
                << of << ' ' << e << ' ' << rate << ' ' << t;
            // along a step: strain and rate grow together
            const auto along = [&](double s) {
              return generic::flow_stress(constants, Jet(e + 0.1 * e * s, 0.1 * e, 0.0),
                                          Jet(rate * (1 + s), rate, 0.0), t);
            };
            const double second = along(0.0).second, steps = (along(h).first - along(-h).first) / (2 * h);
            EXPECT_NEAR(second, steps, 1e-8 * stress) << of << ' ' << e << ' ' << rate << ' ' << t;
          }
    });
}

NumberList list_of(const std::vector<double>& numbers) {
  NumberList list;
  list.size = static_cast<int>(numbers.size());
  std::copy(numbers.begin(), numbers.end(), list.value);
  return list;
}

TEST(flow_stress, table_neither_overshoots_nor_kinks) {
  const std::vector<double> strain{0.0, 0.01, 0.02, 0.3, 0.31, 1.0}, stress{2e8, 2e8, 5e8, 5.1e8, 4e8, 3.9e8};
  const Hardening law = Tabulated{.strain = list_of(strain), .stress = list_of(stress)};
  double slope = law.hardening_modulus(0.0, 1.0, 300.0);
  for (std::size_t i = 1; i < strain.size(); ++i) {
    double before = stress[i - 1];
    const int n = 200;
    for (int k = 1; k <= n; ++k) {
      const double e = std::lerp(strain[i - 1], strain[i], static_cast<double>(k) / n * (1 - 1e-12));
      const double now = law.flow_stress(e, 1.0, 300.0);
      EXPECT_GE((now - before) * (stress[i] - stress[i - 1]), -1.0) << e;
      before = now;
      const double next = law.hardening_modulus(e, 1.0, 300.0);
      EXPECT_LT(std::abs(next - slope), 0.03 * 3e8 / 0.01) << "slope at " << e;
      slope = next;
    }
    EXPECT_NEAR(before, stress[i], 1.0);
  }
  EXPECT_EQ(law.flow_stress(7.0, 1.0, 300.0), 3.9e8);
  EXPECT_EQ(law.hardening_modulus(7.0, 1.0, 300.0), 0.0);
}

TEST(flow_stress, table_is_a_curve) {
  const auto make = [](const std::vector<double>& strain, const std::vector<double>& stress) {
    return Hardening(Tabulated{.strain = list_of(strain), .stress = list_of(stress)});
  };
  EXPECT_THROW(make({0.0}, {1e8}), InputError);
  EXPECT_THROW(make({0.0, 0.1}, {1e8}), InputError);
  EXPECT_THROW(make({0.01, 0.1}, {1e8, 2e8}), InputError);
  EXPECT_THROW(make({0.0, 0.1, 0.1}, {1e8, 2e8, 3e8}), InputError);
  EXPECT_NO_THROW(make({0.0, 0.1}, {1e8, 2e8}));
}

TEST(flow_stress, steepest_fall) {
  EXPECT_EQ(steel().hardening->steepest_fall().slope, 0.0);
  const Hardening cliff =
      Tabulated{.strain = list_of({0.0, 0.5, 0.501, 2.0}), .stress = list_of({5e8, 6e8, 4e8, 4e8})};
  EXPECT_NEAR(cliff.steepest_fall().slope, 1.5 * 2e8 / 1e-3, 1e8)
      << "a cubic with flat ends is 1.5 times as steep";
  EXPECT_NEAR(cliff.steepest_fall().strain, 0.5005, 1e-4);
  const Calamaz steep{.A = 1e9, .B = 0.0, .n = 1, .a = 1, .b = 1, .c = 50, .d = 1, .Tmelt = 1698.0};
  const Hardening::Fall fall = Hardening(steep).steepest_fall();
  EXPECT_GT(fall.slope, 3e9);
  EXPECT_NEAR(fall.slope, -Hardening(steep).hardening_modulus(fall.strain, 1e6, fall.temperature), 1.0);
}

/// The return map along isochoric uniaxial stretch at a constant plastic rate, heated by its own dissipation.
TEST(flow_stress, return_map_follows_the_adiabatic_table) {
  const auto known = sets();
  std::map<std::string, std::vector<Row>> paths;
  for (const Row& r : read_csv("flow_stress_adiabatic.csv")) paths[r[0] + ' ' + r[1]].push_back(r);
  ASSERT_GE(paths.size(), 10u);
  for (const auto& [name, rows] : paths) {
    Material m = steel();
    m.hardening = hardening_of(known.at(rows[0][0]));
    const double rate = std::stod(rows[0][1]);
    PointState<2> s = points_at_rest<2>(1, 296.0);
    for (const Row& r : rows) {
      const double target = std::stod(r[2]), stress = std::stod(r[3]);
      while (target - s.plastic_strain[0] > 1e-9) {
        const double e = s.plastic_strain[0] + std::min(2e-4, target - s.plastic_strain[0]);
        const double stretch =
            e + m.hardening->flow_stress(e, rate, s.temperature[0]) / (3.0 * m.elasticity.mu());
        const Eigen::Vector3d f(std::exp(stretch), std::exp(-stretch / 2), std::exp(-stretch / 2));
        set_deformation<2>(s, 0, f.asDiagonal());
        ASSERT_EQ(update(m, s, (e - s.plastic_strain[0]) / rate), -1) << name;
        ASSERT_NEAR(s.plastic_strain[0], e, 1e-10);
        s.temperature[0] += 0.9 * s.dissipation[0] / 4e6;
      }
      EXPECT_NEAR(s.temperature[0], std::stod(r[4]), 0.3) << name << " at " << target;
      EXPECT_NEAR(s.equivalent_stress[0], stress, 1e-3 * stress) << name << " at " << target;
    }
  }
}

using FlowStress = cnem::testing::EachIsa;
INSTANTIATE_TEST_SUITE_P(each, FlowStress, cnem::testing::every_isa(), cnem::testing::name_of_isa);

/// Shears of 83 points at unlike rates and temperatures, with returns to rest; step k of a path.
template<int dim> void shear(PointState<dim>& s, int k) {
  for (std::size_t i = 0; i < s.size(); ++i) {
    const double a = std::pow(10.0, -4.0 + 0.08 * static_cast<double>(i % 41)) * std::sin(0.3 * k);
    Mat3 f = Mat3::Identity();
    f(0, 1) = a;
    f(1, 0) = 0.2 * a;
    if (dim == 3) f(1, 2) = 0.4 * a;
    set_deformation<dim>(s, i, f);
    s.temperature[i] = 77.0 + 37.0 * static_cast<double>(i % 40);
  }
}

template<int dim, class Law> void compare_packs_with_doubles(const std::string& name, const Law& law) {
  Material m = steel();
  m.hardening = law;
  const double dt = 1e-7;
  PointState<dim> vector = points_at_rest<dim>(83, 300.0);
  for (int k = 1; k <= 30; ++k) {
    shear(vector, k);
    PointState<dim> scalar = vector;
    ASSERT_EQ(update(m, vector, dt), -1) << name;
    const auto parameters = return_map_parameters(m, dt);
    const auto kernel = generic::kernel_of(m.hardening->as<Law>(), dt);
    for (std::size_t i = 0; i < scalar.size(); ++i) {
      ASSERT_FALSE((generic::return_map_step<dim, double>(parameters, kernel, stress_points(scalar),
                                                          static_cast<std::ptrdiff_t>(i))));
      const double stress = vector.equivalent_stress[i];
      ASSERT_NEAR(scalar.equivalent_stress[i], stress, 1e-12 * (stress + m.elasticity.mu() * 1e-3)) << name;
      ASSERT_NEAR(scalar.plastic_strain[i], vector.plastic_strain[i], 1e-12) << name;
      const double flow =
          m.hardening->flow_stress(vector.plastic_strain[i], vector.plastic_rate[i], vector.temperature[i]);
      if (vector.plastic_rate[i] > 0.0)
        ASSERT_NEAR(stress, flow, 1e-10 * flow + 1e-10 * m.elasticity.mu() * 1e-3)
            << name << ": yield condition, point " << i << ", step " << k;
      else
        ASSERT_LE(stress, flow * (1 + 1e-12)) << name;
    }
  }
  EXPECT_GT(*std::max_element(vector.plastic_strain.begin(), vector.plastic_strain.end()), 0.5) << name;
}

/// Where the flow stress falls faster than the elastic one, a point is reported and left as it was, not given
/// one of several stresses.
TEST_P(FlowStress, falls_that_are_too_steep_are_reported) {
  Material m = steel(); // 3μ is 237 GPa
  const auto with_cliff = [&](double width) {
    m.hardening =
        Tabulated{.strain = list_of({0.0, 0.01, 0.01 + width, 1.0}), .stress = list_of({5e8, 5e8, 3e8, 3e8})};
    return m.hardening->steepest_fall().slope / (3.0 * m.elasticity.mu());
  };
  const auto first_bad = [&] {
    PointState<2> s = points_at_rest<2>(9, 300.0);
    for (int k = 1; k <= 4000; ++k) {
      for (std::size_t i = 0; i < s.size(); ++i) {
        Mat3 f = Mat3::Identity();
        f(0, 1) = i == 4 ? 1e-5 * k : 1e-6 * k;
        set_deformation<2>(s, i, f);
      }
      const PointState<2> before = s;
      if (const std::ptrdiff_t bad = update(m, s, 1e-7); bad >= 0) {
        EXPECT_EQ(s.plastic_strain[4], before.plastic_strain[4]);
        EXPECT_EQ(s.equivalent_stress[4], before.equivalent_stress[4]);
        return bad;
      }
    }
    EXPECT_GT(s.plastic_strain[4], 0.015);
    return std::ptrdiff_t{-1};
  };
  EXPECT_LT(with_cliff(2e-3), 0.7);
  EXPECT_EQ(first_bad(), -1);
  EXPECT_GT(with_cliff(3e-4), 4.0);
  EXPECT_EQ(first_bad(), 4);
}

template<int dim> void compare_all_laws() {
  for (const auto& [name, set] : sets())
    with_law(HardeningLaws{}, set,
             [&of = name](const auto& law) { compare_packs_with_doubles<dim>(of, law); });
}

TEST_P(FlowStress, plane_equal_to_doubles) { compare_all_laws<2>(); }
TEST_P(FlowStress, space_equal_to_doubles) { compare_all_laws<3>(); }

} // namespace
} // namespace cnem::plasticity::test
