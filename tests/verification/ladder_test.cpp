// The ladder of benchmarks, on coarse clouds, against exact or published results
// (cases/verification/*/expected.md).
#include "app/run.hpp"
#include "input/case_reader.hpp"
#include "results/history_writer.hpp"
#include "results/output_folder.hpp"
#include "results/status.hpp"
#include "tests/temporary_folder.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <gtest/gtest.h>

namespace cnem::testing {
namespace {

/// A case of cases/verification, run to its end; columns of its history by name.
class Ladder : public ::testing::Test {
protected:
  void run(const std::string& name, std::vector<std::string> overrides) {
    const std::filesystem::path& folder = temporary.path();
    for (const char* quiet : {"output.pictures=[]", "output.fields_every=1 s"}) overrides.emplace_back(quiet);
    const input::Case input = input::read_case(
        std::string(CNEM_SOURCE_DIR) + "/cases/verification/" + name + "/case.toml", overrides);
    ASSERT_EQ(app::run(input, {.output = folder, .force = true, .version = "test"}), Exit::done);
    history = results::read_history(folder / results::files::history);
    EXPECT_LT(results::read_status(folder).energy_residual, 1e-4);
  }
  const std::vector<double>& column(const std::string& name) const {
    return history.column.at(static_cast<std::size_t>(history.find(name)));
  }
  const TemporaryFolder temporary{"ladder"};
  results::HistoryTable history;
};

void expect_near(double found, double reference, double share, const char* what) {
  EXPECT_NEAR(found, reference, share * std::abs(reference)) << what;
}

/// Ansys VM265: contact after gap/v, for 2L/c, with the force ρ c v A.
TEST_F(Ladder, bar_against_a_wall) {
  run("bar_impact", {"cloud.spacing=5.08 mm", "output.history_every=0.25 us", "time.step.max=0.25 us"});
  const std::vector<double>&time = column("time[s]"), &force = column("wall.force_x[N/m]");
  std::vector<double> pushing, when;
  for (std::size_t i = 0; i < time.size(); ++i)
    if (-force[i] > 2.5e6) pushing.push_back(-force[i]), when.push_back(time[i]);
  ASSERT_GT(pushing.size(), 100U);
  EXPECT_NEAR(when.front(), 4.9456e-5, 1e-6);
  EXPECT_NEAR(when.back(), 1.48114e-4, 3e-6);
  std::sort(pushing.begin(), pushing.end());
  expect_near(pushing[pushing.size() / 2] * 25.4e-3 / 4.4482216, 29923.0, 0.005, "force in lbf");
}

/// Perfect contact of two half-spaces: (e1 T1 + e2 T2)/(e1 + e2).
TEST_F(Ladder, heat_contact) {
  run("heat_contact", {"cloud.spacing=20 um"});
  EXPECT_NEAR(column("probe.interface.temperature[K]").back(), 421.57, 0.05);
}

/// Elastic up to 104 MPa: Lamé's displacement.
TEST_F(Ladder, thick_cylinder) {
  run("thick_cylinder", {"cloud.spacing=10 mm", "boundary.fluid.pressure.value=100 MPa", "time.end=5 ms",
                         "boundary.fluid.pressure.ramp=4 ms"});
  expect_near(column("probe.outside.displacement_x[m]").back(), 0.057778e-3, 0.01, "displacement");
}

/// Rigid, perfectly plastic: σ_rr at the bore is −2/√3 σ_y ln(b/a).
TEST_F(Ladder, cylinder_expansion) {
  run("cylinder_expansion", {"time.end=17.67 ms"});
  const double a = 10e-3 + column("probe.bore.displacement_x[m]").back(), b = std::sqrt(a * a + 300e-6);
  EXPECT_NEAR(a, 15e-3, 1e-5);
  const double pressure = column("support.bore.force_x[N]").back() / (6.283185307 * a * 0.5e-3);
  expect_near(pressure, 2.0 / std::sqrt(3.0) * 0.5e6 * std::log(b / a), 0.003, "pressure");
}

/// Simo and Armero: 6.97 to 7.09 mm; coarse meshes of the literature are stiffer.
TEST_F(Ladder, cooks_membrane_at_finite_strain) {
  run("cooks_membrane_j2", {"cloud.spacing=4 mm", "boundary.load.traction.y.ramp=60 ms", "time.end=66 ms",
                            "output.history_every=1 ms"});
  expect_near(column("probe.tip.displacement_y[m]").back(), 7.05e-3, 0.03, "tip");
}

/// The stress rises to its peak and falls as an independent solution in one dimension says.
TEST_F(Ladder, shear_band_up_to_the_peak) {
  run("shear_band", {"cloud.spacing=10 um", "domain.outer.rectangle.to=20 500 um", "time.end=39 us",
                     "initial.imperfections.middle.points=[\"0 0 um\", \"20 0 um\"]"});
  const std::vector<double>& force = column("support.top.force_x[N/m]");
  const auto peak = std::max_element(force.begin(), force.end());
  expect_near(*peak / 20e-6, 1031.32e6, 0.001, "peak of the shear stress");
  expect_near(5.5e4 * column("time[s]")[static_cast<std::size_t>(peak - force.begin())], 2.0899, 0.01,
              "its strain");
}

/// Hill 1948 with σ_y = 300 MPa + 500 MPa ε̄p: along a sheet that keeps its width the metal takes
/// k = (1 + r)/√(1 + 2r) of its flow stress, with τ_zz = s τ_xx, s = r/(1 + r). ε̄p is k times the strain
/// without what is elastic, τ : ε_e = (1 − 2νs + s²) τ_xx²/E.
TEST_F(Ladder, plane_strain_tension_of_rolled_sheet) {
  for (const double r : {0.5, 1.0, 2.0}) {
    run("hill_sheet", {"cloud.spacing=0.25 mm", "materials.sheet.anisotropy.r0=" + std::to_string(r)});
    const double k = (1.0 + r) / std::sqrt(1.0 + 2.0 * r), stretch = 1.0 + 1000.0 * column("time[s]").back();
    const double stress = column("support.grip.force_x[N/m]").back() * stretch / 0.5e-3;
    const double strain = column("probe.middle.plastic_strain").back();
    expect_near(stress / (300e6 + 500e6 * strain), k, 1e-4, "stress over flow stress");
    const double s = r / (1.0 + r), elastic = (1.0 - 2.0 * 0.3 * s + s * s) * stress / 210e9;
    expect_near(strain, k * (std::log(stretch) - elastic), 0.001, "plastic strain");
  }
}

/// The bar carries most near 10 % elongation, then necks in the middle.
TEST_F(Ladder, necking_bar) {
  run("necking_bar", {"cloud.spacing=1 mm", "cloud.refine.neck.spacing=0.6 mm", "time.end=0.7 ms"});
  const std::vector<double>& force = column("support.grip.force_y[N]");
  expect_near(*std::max_element(force.begin(), force.end()), 77.5e3, 0.02, "largest force");
  expect_near(6.298e-3 + column("probe.neck.displacement_x[m]").back(), 4.59e-3, 0.03, "radius of the neck");
}

} // namespace
} // namespace cnem::testing
