// Johnson-Cook flow stress and adiabatic heating against the tables of reference numbers in tests/data.
#include "tests/unit/plasticity/points.hpp"
#include "tests/unit/plasticity/tables.hpp"

#include <gtest/gtest.h>

#include <map>

namespace cnem::plasticity::test {
namespace {

struct HeatedMaterial {
  Material material;
  double heat_slope; ///< J/(kg K²)  the specific heat is specific_heat + heat_slope (T − 273.15 K)

  double heat(double temperature) const {
    return material.density * (material.specific_heat + heat_slope * (temperature - 273.15));
  }
};

std::map<std::string, HeatedMaterial> materials() {
  std::map<std::string, HeatedMaterial> result;
  for (const Row& r : read_csv("jc_parameters.csv")) {
    const auto number = [&](std::size_t k) { return std::stod(r.at(k)); };
    Material m = steel();
    m.name = r.at(0);
    m.hardening = JohnsonCook{number(1) * 1e6, number(2) * 1e6, number(3), number(4), 1.0,
                              number(5),       number(6),       number(7)};
    m.density = number(8);
    m.specific_heat = number(9);
    result[m.name] = {m, number(10)};
  }
  return result;
}

struct Condition {
  const HeatedMaterial* material;
  double rate;
  bool adiabatic;

  double stress(double strain, double temperature) const {
    return material->material.hardening->flow_stress(strain, rate, temperature);
  }
  double heating(double strain, double temperature) const {
    return adiabatic
               ? material->material.taylor_quinney * stress(strain, temperature) / material->heat(temperature)
               : 0.0;
  }
  /// dT/dε̄p = χ σ_y/(ρ c) by Runge-Kutta, in steps that grow with the strain.
  double temperature(double start, double from, double to) const {
    const int steps = 400;
    double t = start, e = from;
    for (int k = 1; k <= steps; ++k) {
      const double next =
          from + (to - from) * std::pow(static_cast<double>(k) / steps, from > 0.0 ? 1.0 : 3.0);
      const double h = next - e;
      const double k1 = heating(e, t), k2 = heating(e + h / 2, t + h / 2 * k1);
      const double k3 = heating(e + h / 2, t + h / 2 * k2), k4 = heating(next, t + h * k3);
      t += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
      e = next;
    }
    return t;
  }
};

TEST(johnson_cook, table_of_single_points) {
  const auto known = materials();
  const auto rows = read_csv("jc_single_point.csv");
  ASSERT_EQ(rows.size(), 1728u);
  for (const Row& r : rows) {
    const double strain = std::stod(r[4]), stress = std::stod(r[5]), temperature = std::stod(r[6]);
    const Condition c{&known.at(r[0]), std::stod(r[2]), r[1] == "adiabatic"};
    const double computed = c.temperature(std::stod(r[3]), 0.0, strain);
    ASSERT_NEAR(computed, temperature, 0.5) << r[0] << ' ' << r[1] << ' ' << r[2] << " /s, " << strain;
    ASSERT_NEAR(c.stress(strain, computed) / 1e6, stress, 1e-3 * stress)
        << r[0] << ' ' << r[1] << ' ' << r[2] << " /s, " << strain << ", " << computed << " K";
  }
}

TEST(johnson_cook, table_of_adiabatic_peaks) {
  const auto known = materials();
  const auto rows = read_csv("jc_adiabatic_peak.csv");
  ASSERT_EQ(rows.size(), 72u);
  for (const Row& r : rows) {
    const Condition c{&known.at(r[0]), std::stod(r[1]), true};
    double low = 0.01, high = 4.0; // golden section on σ_y(ε̄p, T(ε̄p))
    const double start = std::stod(r[2]);
    const auto stress = [&](double e) { return c.stress(e, c.temperature(start, 0.0, e)); };
    while (high - low > 1e-5) {
      const double a = high - 0.618 * (high - low), b = low + 0.618 * (high - low);
      (stress(a) < stress(b) ? low : high) = stress(a) < stress(b) ? a : b;
    }
    EXPECT_NEAR(low, std::stod(r[3]), 2e-3) << r[0] << ' ' << r[1];
    EXPECT_NEAR(stress(low) / 1e6, std::stod(r[4]), 1e-3 * std::stod(r[4])) << r[0] << ' ' << r[1];
    EXPECT_NEAR(c.temperature(start, 0.0, low), std::stod(r[5]), 0.5) << r[0] << ' ' << r[1];
  }
}

/// The return map itself along isochoric uniaxial stretch at a constant plastic rate, heated by its own
/// dissipation.
TEST(johnson_cook, return_map_follows_the_table) {
  const auto known = materials();
  std::map<std::string, std::vector<Row>> paths;
  for (const Row& r : read_csv("jc_single_point.csv")) paths[r[0] + r[1] + r[2] + ',' + r[3]].push_back(r);
  ASSERT_EQ(paths.size(), 144u);
  for (const auto& [name, rows] : paths) {
    const HeatedMaterial& m = known.at(rows[0][0]);
    const Hardening& law = *m.material.hardening;
    const double rate = std::stod(rows[0][2]), step = 2.5e-4;
    PointState<2> s = points_at_rest<2>(1, std::stod(rows[0][3]));
    double& temperature = s.temperature[0];
    for (const Row& r : rows) {
      const double target = std::stod(r[4]), stress = std::stod(r[5]);
      while (target - s.plastic_strain[0] > 1e-9) {
        const double e = s.plastic_strain[0] + std::min(step, target - s.plastic_strain[0]);
        const double stretch = e + law.flow_stress(e, rate, temperature) / (3.0 * m.material.elasticity.mu());
        const Eigen::Vector3d f(std::exp(stretch), std::exp(-stretch / 2), std::exp(-stretch / 2));
        set_deformation<2>(s, 0, f.asDiagonal());
        const double dt = (e - s.plastic_strain[0]) / rate;
        ASSERT_EQ(update(m.material, s, dt), -1);
        ASSERT_NEAR(s.plastic_strain[0], e, 1e-10);
        ASSERT_NEAR(s.plastic_rate[0], rate, 1e-6 * rate);
        if (r[1] == "adiabatic")
          temperature += m.material.taylor_quinney * s.dissipation[0] / m.heat(temperature);
      }
      if (target == 0.0) continue; // not yet loaded
      EXPECT_NEAR(temperature, std::stod(r[6]), 0.5) << name << " at " << target;
      EXPECT_NEAR(s.equivalent_stress[0] / 1e6, stress, 1e-3 * stress) << name << " at " << target;
    }
  }
}

TEST(johnson_cook, moduli_are_derivatives_of_the_flow_stress) {
  const Hardening law = *steel().hardening;
  for (double e : {1e-4, 0.1, 2.0})
    for (double rate : {0.5, 10.0, 1e5})
      for (double t : {250.0, 500.0, 1500.0, 1800.0}) {
        const double h = 1e-5;
        const double by_strain =
            (law.flow_stress(e * (1 + h), rate, t) - law.flow_stress(e * (1 - h), rate, t));
        EXPECT_NEAR(law.hardening_modulus(e, rate, t), by_strain / (2 * h * e), 1e-4 * 1e8);
        const double by_rate =
            (law.flow_stress(e, rate * (1 + h), t) - law.flow_stress(e, rate * (1 - h), t));
        EXPECT_NEAR(law.rate_modulus(e, rate, t) * rate, by_rate / (2 * h), 1e-4 * 1e8);
      }
}

TEST(johnson_cook, limits) {
  const Hardening law = *steel().hardening;
  EXPECT_DOUBLE_EQ(law.flow_stress(0.0, 0.0, 296.0), 253e6);
  EXPECT_DOUBLE_EQ(law.flow_stress(0.0, 0.5, 100.0), 253e6); // clipped below rate0 and below T0
  EXPECT_DOUBLE_EQ(law.flow_stress(1.0, 1.0, 296.0), 253e6 + 685e6);
  EXPECT_DOUBLE_EQ(law.flow_stress(1.0, 1e6, 1698.0), 0.0);
  EXPECT_DOUBLE_EQ(law.flow_stress(1.0, 1e6, 5000.0), 0.0);
  EXPECT_TRUE(std::isinf(law.hardening_modulus(0.0, 1.0, 300.0)));
  const Hardening linear = JohnsonCook{1e8, 2e8};
  EXPECT_DOUBLE_EQ(linear.flow_stress(0.5, 1e8, 4000.0), 2e8);
  EXPECT_DOUBLE_EQ(linear.hardening_modulus(0.0, 0.0, 0.0), 2e8);
  const Elasticity steel_elasticity{210e9, 0.33};
  EXPECT_NEAR(steel_elasticity.dilatational_speed(7850.0), 6295.7, 0.1);
  EXPECT_NEAR(steel_elasticity.shear_speed(7850.0), 3171.3, 0.1);
  EXPECT_NEAR(steel_elasticity.bar_speed(7850.0), 5172.2, 0.1);
  EXPECT_NEAR(steel_elasticity.kappa(), steel_elasticity.lambda() + 2.0 / 3.0 * steel_elasticity.mu(), 1.0);
}

} // namespace
} // namespace cnem::plasticity::test
