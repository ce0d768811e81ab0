// The law of Zerilli and Armstrong for body-centred metals: its formula, its derivatives, the return map on
// it, and a case.
#include "app/run.hpp"
#include "core/machine/isa.hpp"
#include "input/case_reader.hpp"
#include "plasticity/box2.hpp"
#include "results/history_writer.hpp"
#include "results/output_folder.hpp"
#include "tests/each_isa.hpp"
#include "tests/temporary_folder.hpp"
#include "tests/unit/plasticity/points.hpp"

#include <gtest/gtest.h>

namespace cnem::plasticity::test {
namespace {

constexpr ZerilliArmstrongBcc iron{
    .C0 = 65e6, .C1 = 1033e6, .C3 = 0.00698, .C4 = 0.000415, .C5 = 266e6, .n = 0.289};

Material of_iron() {
  Material m = steel();
  m.hardening = iron;
  return m;
}

TEST(zerilli_armstrong, is_its_formula) {
  const Hardening law = iron;
  for (const double strain : {0.0, 1e-3, 0.2, 1.5})
    for (const double rate : {1e-3, 1.0, 1e4})
      for (const double t : {77.0, 293.0, 900.0}) {
        const double known = 65e6 + 1033e6 * std::exp(-0.00698 * t) * std::pow(rate, 0.000415 * t) +
                             266e6 * std::pow(strain, 0.289);
        EXPECT_NEAR(law.flow_stress(strain, rate, t), known, 1e-13 * known)
            << strain << ' ' << rate << ' ' << t;
      }
  EXPECT_NEAR(law.flow_stress(0.2, 0.0, 900.0), 65e6 + 266e6 * std::pow(0.2, 0.289), 1.0)
      << "only the athermal part at rest";
  EXPECT_TRUE(std::isinf(law.melting_temperature()));
}

TEST(zerilli_armstrong, slopes_and_curvature_are_derivatives) {
  const Hardening law = iron;
  using Jet = generic::Jet<double>;
  const double h = 1e-5;
  for (const double e : {1e-3, 0.2, 1.5})
    for (const double rate : {1e-3, 1.0, 1e4})
      for (const double t : {77.0, 293.0, 900.0}) {
        const double by_strain =
            (law.flow_stress(e + h * e, rate, t) - law.flow_stress(e - h * e, rate, t)) / (2 * h * e);
        const double by_rate =
            (law.flow_stress(e, rate + h * rate, t) - law.flow_stress(e, rate - h * rate, t)) /
            (2 * h * rate);
        EXPECT_NEAR(law.hardening_modulus(e, rate, t), by_strain, 1e-7 * by_strain);
        EXPECT_NEAR(law.rate_modulus(e, rate, t), by_rate, 1e-5 * by_rate);
        // along a step: strain and rate grow together
        const auto along = [&](double s) {
          return generic::flow_stress(iron, Jet(e + 0.1 * e * s, 0.1 * e, 0.0),
                                      Jet(rate * (1 + s), rate, 0.0), t);
        };
        const double second = along(0.0).second, steps = (along(h).first - along(-h).first) / (2 * h);
        EXPECT_NEAR(second, steps, 1e-6 * std::abs(steps)) << e << ' ' << rate << ' ' << t;
      }
}

using Kernel = cnem::testing::EachIsa;
INSTANTIATE_TEST_SUITE_P(zerilli_armstrong, Kernel, cnem::testing::every_isa(), cnem::testing::name_of_isa);

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

template<int dim> void return_map_on_the_law() {
  const Material m = of_iron();
  const double dt = 1e-7;
  PointState<dim> vector = points_at_rest<dim>(83, 300.0);
  for (int k = 1; k <= 30; ++k) {
    shear(vector, k);
    PointState<dim> scalar = vector;
    ASSERT_EQ(update(m, vector, dt), -1);
    const auto parameters = return_map_parameters(m, dt);
    const auto kernel = generic::kernel_of(iron, dt);
    for (std::size_t i = 0; i < scalar.size(); ++i) {
      ASSERT_FALSE((generic::return_map_step<dim, double>(parameters, kernel, stress_points(scalar),
                                                          static_cast<std::ptrdiff_t>(i))));
      const double stress = vector.equivalent_stress[i];
      ASSERT_NEAR(scalar.equivalent_stress[i], stress, 1e-12 * (stress + m.elasticity.mu() * 1e-3));
      ASSERT_NEAR(scalar.plastic_strain[i], vector.plastic_strain[i], 1e-12);
      const double flow =
          m.hardening->flow_stress(vector.plastic_strain[i], vector.plastic_rate[i], vector.temperature[i]);
      if (vector.plastic_rate[i] > 0.0)
        ASSERT_NEAR(stress, flow, 1e-10 * flow) << "yield condition, point " << i << ", step " << k;
      else
        ASSERT_LE(stress, flow * (1 + 1e-12));
    }
  }
  EXPECT_GT(*std::max_element(vector.plastic_strain.begin(), vector.plastic_strain.end()), 0.5);
}

TEST_P(Kernel, plane) { return_map_on_the_law<2>(); }
TEST_P(Kernel, space) { return_map_on_the_law<3>(); }

TEST(zerilli_armstrong, in_a_case) {
  const input::Case input =
      input::read_case_text(R"toml(
[time]
end = "40 us"
[domain]
material = "iron"
outer.rectangle = { from = "0 0 mm", to = "1 1 mm" }
[cloud]
spacing = "0.25 mm"
[materials.iron]
density = "7850 kg/m3"
elastic = { young = "210 GPa", poisson = 0.3 }
plastic = { law = "zerilli-armstrong-bcc", C0 = "65 MPa", C1 = "1033 MPa", C3 = "0.00698 /K", C4 = "0.000415 /K", C5 = "266 MPa", n = 0.289 }
heat = { specific_heat = "450 J/(kg K)", conductivity = "0 W/(m K)" }
[initial]
velocity_gradient = { xx = "5e3 /s", yy = "-5e3 /s" }
[boundary.base]
pieces = "bottom"
symmetry = true
[boundary.axis]
pieces = "left"
symmetry = true
[boundary.anvil]
pieces = "top"
velocity = { y = "-5 m/s" }
[output]
probes.middle = { at = "0.5 0.5 mm", fields = ["equivalent_stress", "plastic_strain", "plastic_rate", "temperature", "volume_ratio"] }
)toml",
                            "case.toml", {"output.pictures=[]", "output.fields_every=1 s"});
  EXPECT_EQ(input.material("iron").hardening->as<ZerilliArmstrongBcc>().C4, 0.000415);
  const cnem::testing::TemporaryFolder folder{"zerilli_armstrong"};
  ASSERT_EQ(app::run(input, {.output = folder.path(), .force = true, .version = "test"}), Exit::done);
  const results::HistoryTable history = results::read_history(folder.path() / results::files::history);
  const auto last = [&](const std::string& name) {
    return history.column.at(static_cast<std::size_t>(history.find("probe.middle." + name))).back();
  };
  const double strain = last("plastic_strain"), temperature = last("temperature[K]");
  EXPECT_GT(strain, 0.2);
  EXPECT_GT(temperature, 320.0);
  const double flow =
      input.material("iron").hardening->flow_stress(strain, last("plastic_rate[1/s]"), temperature);
  EXPECT_NEAR(last("equivalent_stress[Pa]") * last("volume_ratio"), flow, 1e-4 * flow);
}

} // namespace
} // namespace cnem::plasticity::test
