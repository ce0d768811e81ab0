// The vector kernels against the same template on double, their lanes, and what must not break them.
#include "core/machine/isa.hpp"
#include "plasticity/hill_return.hpp"
#include "tests/each_isa.hpp"
#include "tests/unit/plasticity/points.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <random>

namespace cnem::plasticity::test {
namespace {

using Kernel = cnem::testing::EachIsa;
INSTANTIATE_TEST_SUITE_P(each, Kernel, cnem::testing::every_isa(), cnem::testing::name_of_isa);

/// Points that yield, unload, yield again or stay elastic, at unlike rates and temperatures; step k of a
/// path.
template<int dim> void deform(PointState<dim>& s, int k) {
  for (std::size_t i = 0; i < s.size(); ++i) {
    const double x = static_cast<double>(i);
    const double size = std::pow(10.0, -4.0 + 0.08 * static_cast<double>(i % 41));
    const double a = size * std::sin(0.2 * k + 0.1 * std::sin(x) * k);
    Mat3 f = Mat3::Identity();
    f(0, 1) = a;
    f(1, 0) = 0.3 * a * std::cos(x);
    f(0, 0) += 0.2 * a;
    f(2, 2) -= 0.15 * a;
    if (dim == 3) f(1, 2) = f(2, 0) = 0.4 * a;
    const Mat3 q = Eigen::AngleAxisd(0.05 * k * std::cos(x), Eigen::Vector3d::UnitZ()).toRotationMatrix();
    set_deformation<dim>(s, i, q * f);
    s.temperature[i] = 250.0 + 37.0 * static_cast<double>(i % 40);
  }
}

/// Every field the kernel writes.
template<int dim> std::vector<const Field*> results(const PointState<dim>& s) {
  std::vector<const Field*> fields{&s.plastic_strain, &s.plastic_rate,  &s.equivalent_stress, &s.plastic_work,
                                   &s.pressure,       &s.stored_energy, &s.dissipation,       &s.stress_free};
  for (const Field& f : s.inverse_plastic_cauchy_green) fields.push_back(&f);
  for (const Field& f : s.piola) fields.push_back(&f);
  return fields;
}

template<int dim> void expect_same_bits(const PointState<dim>& a, const PointState<dim>& b) {
  const auto fa = results(a), fb = results(b);
  for (std::size_t k = 0; k < fa.size(); ++k)
    for (std::size_t i = 0; i < a.size(); ++i)
      ASSERT_EQ(generic::to_bits((*fa[k])[i]), generic::to_bits((*fb[k])[i]))
          << "field " << k << ", point " << i;
}

const Hill48 rolled_sheet{.r0 = 1.9, .r45 = 0.7, .r90 = 2.4, .L = 1.2, .M = 1.8};

template<int dim> void compare_with_scalar(const Material& m) {
  PointState<dim> vector = points_at_rest<dim>(83, 300.0);
  keep_axes(vector);
  const double dt = 1e-7;
  const double stress = 2e-3 * m.elasticity.mu(); // that of a strain of 1e-3
  for (int k = 1; k <= 60; ++k) {
    deform(vector, k);
    PointState<dim> scalar = vector; // each step on its own: roundings of F C_p⁻¹ Fᵀ add up
    ASSERT_EQ(update(m, vector, dt), -1);
    const auto parameters = return_map_parameters(m, dt);
    const auto kernel = generic::kernel_of(m.hardening->as<JohnsonCook>(), dt);
    const auto points = stress_points(scalar);
    const HillForm form = m.anisotropy.value_or(Hill48{}).form();
    for (std::ptrdiff_t i = 0; i < static_cast<std::ptrdiff_t>(scalar.size()); ++i)
      if (m.anisotropy)
        ASSERT_FALSE((generic::return_map_step<dim, double>(generic::HillParameters{parameters, form}, kernel,
                                                            points, i)));
      else
        ASSERT_FALSE((generic::return_map_step<dim, double>(parameters, kernel, points, i)));
    for (std::size_t i = 0; i < scalar.size(); ++i) {
      const Mat3 p = general<dim>(scalar.piola, i);
      ASSERT_LT((p - general<dim>(vector.piola, i)).norm(), 1e-12 * std::max(p.norm(), stress)) << i;
      ASSERT_NEAR(scalar.plastic_strain[i], vector.plastic_strain[i], 1e-12);
      ASSERT_NEAR(scalar.plastic_work[i], vector.plastic_work[i], 1e-12 * (scalar.plastic_work[i] + stress));
      ASSERT_NEAR(scalar.stored_energy[i], vector.stored_energy[i],
                  1e-12 * (scalar.stored_energy[i] + stress));
    }
  }
  EXPECT_GT(*std::max_element(vector.plastic_strain.begin(), vector.plastic_strain.end()), 0.1);
  EXPECT_EQ(*std::min_element(vector.plastic_strain.begin(), vector.plastic_strain.end()), 0.0);
}

TEST_P(Kernel, plane_equal_to_scalar) { compare_with_scalar<2>(steel()); }
TEST_P(Kernel, space_equal_to_scalar) { compare_with_scalar<3>(steel()); }
TEST_P(Kernel, sheet_in_plane_equal_to_scalar) { compare_with_scalar<2>(sheet(rolled_sheet)); }
TEST_P(Kernel, sheet_in_space_equal_to_scalar) { compare_with_scalar<3>(sheet(rolled_sheet)); }

template<int dim> void compare_ranges(const Material& m) {
  const std::size_t n = 75;
  PointState<dim> whole = points_at_rest<dim>(n, 300.0);
  keep_axes(whole);
  PointState<dim> cut = whole, reversed = whole;
  std::mt19937 random(5);
  for (int k = 1; k <= 40; ++k) {
    deform(whole, k);
    deform(cut, k);
    deform(reversed, k);
    for (Field& f : reversed.deformation) std::reverse(f.begin(), f.end());
    std::reverse(reversed.temperature.begin(), reversed.temperature.end());
    ASSERT_EQ(update(m, whole, 1e-7), -1);
    ASSERT_EQ(update(m, reversed, 1e-7), -1);
    const auto last = static_cast<std::ptrdiff_t>(n);
    for (std::ptrdiff_t begin = 0; begin < last;) {
      const std::ptrdiff_t end =
          std::min<std::ptrdiff_t>(last, begin + 1 + static_cast<std::ptrdiff_t>(random() % 23));
      ASSERT_EQ(update_stress(m, stress_points(cut), begin, end, 1e-7), -1);
      begin = end;
    }
    expect_same_bits(whole, cut);
    PointState<dim> turned = reversed;
    for (const Field* f : results(turned))
      std::reverse(const_cast<Field*>(f)->begin(), const_cast<Field*>(f)->end());
    expect_same_bits(whole, turned);
  }
}

TEST_P(Kernel, plane_same_bits_however_ranges_are_cut) { compare_ranges<2>(steel()); }
TEST_P(Kernel, space_same_bits_however_ranges_are_cut) { compare_ranges<3>(steel()); }
TEST_P(Kernel, sheet_in_plane_same_bits_however_ranges_are_cut) { compare_ranges<2>(sheet(rolled_sheet)); }
TEST_P(Kernel, sheet_in_space_same_bits_however_ranges_are_cut) { compare_ranges<3>(sheet(rolled_sheet)); }

TEST_P(Kernel, empty_range_does_nothing) {
  PointState<2> s = points_at_rest<2>(3, 300.0);
  const PointState<2> before = s;
  EXPECT_EQ(update_stress(steel(), stress_points(s), 2, 2, 1e-7), -1);
  expect_same_bits(before, s);
}

template<int dim> void meaningless_points() {
  const double nan = std::nan(""), infinity = std::numeric_limits<double>::infinity();
  PointState<dim> good = points_at_rest<dim>(40, 300.0);
  for (int k = 1; k <= 10; ++k) {
    deform(good, k);
    ASSERT_EQ(update(steel(), good, 1e-7), -1);
  }
  deform(good, 11);
  PointState<dim> healthy = good;
  ASSERT_EQ(update(steel(), healthy, 1e-7), -1);
  std::vector<std::function<void(PointState<dim>&, std::size_t)>> defects{
      [&](auto& s, auto i) { s.deformation[1][i] = nan; },
      [&](auto& s, auto i) { s.deformation[0][i] = infinity; },
      [&](auto& s, auto i) { s.deformation[0][i] = -s.deformation[0][i]; },
      [&](auto& s, auto i) {
        for (Field& f : s.deformation) f[i] = 0.0;
      },
      [&](auto& s, auto i) { s.inverse_plastic_cauchy_green[0][i] = -1.0; },
      [&](auto& s, auto i) { s.inverse_plastic_cauchy_green[2][i] = nan; },
      [&](auto& s, auto i) { s.inverse_plastic_cauchy_green[3][i] = 5.0; },
      [&](auto& s, auto i) { s.temperature[i] = nan; },
      [&](auto& s, auto i) { s.temperature[i] = -1.0; },
      [&](auto& s, auto i) { s.plastic_strain[i] = nan; },
      [&](auto& s, auto i) { s.plastic_strain[i] = -1e-3; },
      [&](auto& s, auto i) { s.plastic_rate[i] = nan; },
      [&](auto& s, auto i) { s.equivalent_stress[i] = infinity; },
      [&](auto& s, auto i) { s.plastic_work[i] = nan; }};
  for (std::size_t k = 0; k < defects.size(); ++k)
    for (std::size_t i : {0u, 7u, 17u, 39u}) {
      PointState<dim> s = good;
      defects[k](s, i);
      const PointState<dim> before = s;
      ASSERT_EQ(update(steel(), s, 1e-7), static_cast<std::ptrdiff_t>(i)) << "defect " << k;
      const auto now = results(s), old = results(before), right = results(healthy);
      for (std::size_t f = 0; f < now.size(); ++f)
        for (std::size_t j = 0; j < s.size(); ++j)
          ASSERT_EQ(generic::to_bits((*now[f])[j]), generic::to_bits((*(j == i ? old : right)[f])[j]))
              << "defect " << k << " at " << i << ", field " << f << ", point " << j;
    }
  PointState<dim> s = good;
  defects[0](s, 30);
  defects[2](s, 12);
  EXPECT_EQ(update(steel(), s, 1e-7), 12) << "the first of several";
}

TEST_P(Kernel, plane_reports_meaningless_points) { meaningless_points<2>(); }
TEST_P(Kernel, space_reports_meaningless_points) { meaningless_points<3>(); }

/// The strength scales the flow stress as smaller constants would.
TEST_P(Kernel, strength_scales_the_flow_stress) {
  const double strength = 0.7;
  Material weak = steel(), scaled = steel();
  weak.hardening = Voce{.yield = 3e8, .hardening = 1e9, .saturation = 5e8, .exponent = 20.0};
  scaled.hardening = Voce{
      .yield = strength * 3e8, .hardening = strength * 1e9, .saturation = strength * 5e8, .exponent = 20.0};
  PointState<2> s = points_at_rest<2>(5, 400.0), expected = s;
  s.strength.assign(5, strength);
  for (int step = 1; step <= 50; ++step) {
    for (PointState<2>* points : {&s, &expected})
      for (std::size_t i = 0; i < 5; ++i) {
        Mat3 f = Mat3::Identity();
        f(0, 1) = 1e-3 * step * static_cast<double>(i + 1);
        set_deformation<2>(*points, i, f);
      }
    ASSERT_EQ(update(weak, s, 1e-7), -1);
    ASSERT_EQ(update(scaled, expected, 1e-7), -1);
  }
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_GT(s.plastic_strain[i], 0.0);
    EXPECT_NEAR(s.plastic_strain[i], expected.plastic_strain[i], 1e-13);
    EXPECT_NEAR(s.equivalent_stress[i], expected.equivalent_stress[i], 1e-11 * expected.equivalent_stress[i]);
  }
}

/// Points of two materials in one range get what each would alone.
TEST_P(Kernel, ranges_of_several_materials) {
  Material soft = steel();
  soft.hardening = Perfect{1e8};
  const std::vector<Material> materials{steel(), soft};
  const std::size_t n = 41;
  PointState<2> mixed = points_at_rest<2>(n, 300.0);
  for (std::size_t i = 0; i < n; ++i) {
    mixed.material[i] = (i % 7 < 4) ? 0 : 1;
    Mat3 f = Mat3::Identity();
    f(0, 1) = 0.01 + 1e-3 * static_cast<double>(i);
    set_deformation<2>(mixed, i, f);
  }
  std::array<PointState<2>, 2> alone{mixed, mixed};
  ASSERT_EQ(update_stress(materials, mixed.material, stress_points(mixed), 3, 40, 1e-7), -1);
  for (std::size_t m = 0; m < 2; ++m) ASSERT_EQ(update(materials[m], alone[m], 1e-7), -1);
  for (std::size_t i = 3; i < 40; ++i)
    EXPECT_EQ(mixed.piola[1][i], alone[static_cast<std::size_t>(mixed.material[i])].piola[1][i]) << i;
  EXPECT_EQ(mixed.plastic_strain[0], 0.0) << "outside the range";
  mixed.deformation[0][20] = -1.0;
  EXPECT_EQ(update_stress(materials, mixed.material, stress_points(mixed), 0, 41, 1e-7), 20);
}

/// Strain, rate, temperature and step far beyond any use: finite, on the yield surface, no complaint.
TEST_P(Kernel, extremes) {
  const std::vector<Hardening> laws{
      *steel().hardening,
      Perfect{3e8},
      Linear{3e8, 1e9},
      JohnsonCook{0.0, 5e8, 0.3}, // no initial stress
      JohnsonCook{1e8, 5e8, 0.01, 0.5, 1e-3, 0.1, 300.0, 900.0},
      JohnsonCook{1e8, 5e8, 2.5, 0.02, 1e4, 3.0, 300.0, 900.0},
      JohnsonCook{1e8, 5e8, 12.0, 0.0, 1.0, 1.0, 300.0, 900.0},
      JohnsonCook{1e3, 0.0, 1.0, 1.0, 1.0, 1.0, 300.0, 900.0},
      Voce{.yield = 4.5e8, .hardening = 0.0, .saturation = 7.15e8, .exponent = 16.93},
      Voce{.yield = 1e8, .hardening = 1e8, .saturation = 1.1e9, .exponent = 1e3}};
  const std::vector<double> shears{0.0, 1e-300, 1e-16, 1e-8, 1e-3, 3e-3, 0.05, 1.0, 20.0};
  const std::vector<double> strains{0.0, 1e-300, 1e-12, 1e-4, 0.1, 10.0, 1e3};
  const std::vector<double> rates{0.0, 1e-12, 1.0, 1e4, 1e8};
  const std::vector<double> temperatures{0.0, 200.0, 296.0, 600.0, 899.9999999, 1698.0, 1e4};
  for (const auto& [law, anisotropy] : [&] {
         std::vector<std::pair<Hardening, std::optional<Hill48>>> pairs;
         for (const Hardening& law : laws) pairs.insert(pairs.end(), {{law, {}}, {law, rolled_sheet}});
         return pairs;
       }()) {
    Material m = steel();
    m.hardening = law;
    m.anisotropy = anisotropy;
    double steepest = 3.0;
    if (anisotropy)
      for (const double value : anisotropy->form().value) steepest = std::max(steepest, 2.0 * value);
    for (double dt : {1e-30, 1e-12, 1e-8, 1e-3, 1e6})
      for (double stretch : {1.0, 0.7, 1.5}) {
        PointState<2> s =
            points_at_rest<2>(shears.size() * strains.size() * rates.size() * temperatures.size(), 0.0);
        keep_axes(s);
        std::size_t i = 0;
        for (double shear : shears)
          for (double strain : strains)
            for (double rate : rates)
              for (double temperature : temperatures) {
                Mat3 f = Mat3::Identity() * stretch;
                f(0, 1) = shear * stretch;
                set_deformation<2>(s, i, f);
                s.plastic_strain[i] = strain;
                s.plastic_rate[i] = rate;
                s.temperature[i++] = temperature;
              }
        const PointState<2> before = s;
        ASSERT_EQ(update(m, s, dt), -1);
        for (i = 0; i < s.size(); ++i) {
          const double increment = s.plastic_rate[i] * dt;
          const double trial = s.equivalent_stress[i] + steepest * m.elasticity.mu() * increment;
          const double flow =
              law.flow_stress(before.plastic_strain[i] + increment, s.plastic_rate[i], s.temperature[i]);
          for (const Field* f : results(s)) ASSERT_TRUE(std::isfinite((*f)[i]));
          if (increment > 0.0)
            ASSERT_NEAR(s.equivalent_stress[i], flow, 1e-11 * trial)
                << "point " << i << ", dt " << dt << ", shear " << before.deformation[1][i] << ", strain "
                << before.plastic_strain[i] << ", T " << s.temperature[i];
          else
            ASSERT_LE(s.equivalent_stress[i], flow * (1 + 1e-12));
        }
      }
  }
}

} // namespace
} // namespace cnem::plasticity::test
