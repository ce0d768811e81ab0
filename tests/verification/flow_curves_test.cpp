// Cases with each of the hardening laws that the return map evaluates by their formula, and with friction
// that passes smoothly into the strength of the metal.
#include "app/run.hpp"
#include "input/case_reader.hpp"
#include "plasticity/hardening.hpp"
#include "results/history_writer.hpp"
#include "results/output_folder.hpp"
#include "tests/temporary_folder.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace cnem {
namespace {

/// The last row of the history of a case; `folder` keeps its files.
struct Finished {
  cnem::testing::TemporaryFolder folder{"flow_curves"};
  results::HistoryTable history;

  explicit Finished(const input::Case& input) {
    EXPECT_EQ(app::run(input, {.output = folder.path(), .force = true, .version = "test"}), Exit::done);
    history = results::read_history(folder.path() / results::files::history);
  }
  double last(const std::string& name) const {
    return history.column.at(static_cast<std::size_t>(history.find(name))).back();
  }
};

const std::string squeezed_block = R"toml(
[time]
end = "40 us"
[domain]
material = "metal"
outer.rectangle = { from = "0 0 mm", to = "1 1 mm" }
[cloud]
spacing = "0.25 mm"
[materials.metal]
density = "7850 kg/m3"
elastic = { young = "210 GPa", poisson = 0.3 }
heat = { specific_heat = "450 J/(kg K)", conductivity = "0 W/(m K)" }
)toml";

const std::string squeezed = R"toml(
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
)toml";

class FlowCurve : public ::testing::TestWithParam<const char*> {};

TEST_P(FlowCurve, in_a_case) {
  const input::Case input =
      input::read_case_text(squeezed_block + "plastic = { law = " + GetParam() + " }" + squeezed, "case.toml",
                            {"output.pictures=[]", "output.fields_every=1 s"});
  const Finished run(input);
  const double strain = run.last("probe.middle.plastic_strain");
  const double temperature = run.last("probe.middle.temperature[K]");
  EXPECT_GT(strain, 0.2);
  EXPECT_GT(temperature, 310.0);
  const double flow = input.material("metal").hardening->flow_stress(
      strain, run.last("probe.middle.plastic_rate[1/s]"), temperature);
  EXPECT_NEAR(run.last("probe.middle.equivalent_stress[Pa]") * run.last("probe.middle.volume_ratio"), flow,
              1e-4 * flow);
}

INSTANTIATE_TEST_SUITE_P(
    of, FlowCurve,
    ::testing::Values(
        R"("swift", K = "950 MPa", strain0 = 0.012, n = 0.21)",
        R"("hockett-sherby", yield = "330 MPa", saturation = "620 MPa", N = 4.7, p = 0.81)",
        R"("goijaerts", yield = "420 MPa", rise = "133 MPa", rise_strain = 0.0567, root = "406 MPa", hardening = "70.7 MPa")",
        R"("zerilli-armstrong-fcc", C0 = "165 MPa", C2 = "890 MPa", C3 = "0.0028 /K", C4 = "0.000115 /K")",
        R"("calamaz", A = "253 MPa", B = "685 MPa", n = 0.312, a = 1.6, b = 0.4, c = 6, d = 1, C = 0.0973, m = 2.044, T0 = "296 K", Tmelt = "1698 K")",
        R"("table", strain = [0, 0.05, 0.2, 0.8], stress = "310 480 560 540 MPa", C = 0.02, m = 1.1, Tmelt = "1750 K")",
        R"("table", strain = [0, 0.1], stress = ["400 MPa", "0.5 GPa"])"),
    [](const auto& curve) {
      std::string name(curve.param);
      name = name.substr(1, name.find('"', 1) - 1) + std::to_string(curve.index);
      std::replace(name.begin(), name.end(), '-', '_');
      return name;
    });

/// A punch presses a block hard on a plate that slides under it: what drags it is between nothing and what
/// the limited law gives.
TEST(SmoothFriction, in_a_case) {
  const auto drag = [](const std::string& law) {
    const input::Case input =
        input::read_case_text(squeezed_block + R"toml(
plastic = { law = "linear", yield = "400 MPa", hardening = "200 MPa" }
[boundary.top]
pieces = "top"
velocity = { x = "0 m/s", y = { value = "-1 m/s", ramp = "5 us" } }
[tools.plate]
rectangle = { from = "-3 -1 mm", to = "3 0 mm" }
velocity = "20 0 m/s"
friction = { law = ")toml" + law + R"toml(", coefficient = 0.3, shear_factor = 0.5 }
)toml",
                              "case.toml", {"output.pictures=[]", "output.fields_every=1 s"});
    const Finished run(input);
    EXPECT_GT(run.last("plate.force_y[N/m]"), 3e5);
    EXPECT_GT(run.last("plate.force_x[N/m]"), 0.0);
    return std::array{run.last("plate.force_x[N/m]"), run.last("plate.force_y[N/m]")};
  };
  const auto smooth = drag("tresca-smooth"), limited = drag("tresca-limited");
  // k = 0.5 σ_y/√3 is about 120 MPa on 1 mm, μp about 0.3 · 470 MPa: near the knee, where the laws differ
  // most
  const double k = 0.5 * 410e6 / std::numbers::sqrt3 * 1e-3;
  const double known = k * (1.0 - std::exp(-0.3 * smooth[1] / k));
  EXPECT_NEAR(smooth[0], known, 0.1 * known);
  EXPECT_LT(smooth[0], 0.8 * limited[0]);
}

} // namespace
} // namespace cnem
