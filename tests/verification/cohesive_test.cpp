// Cohesive interfaces in whole runs, against beam theory and balances.
#include "input/case_reader.hpp"
#include "tests/finished_run.hpp"
#include "tests/solver_of.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>

namespace cnem::testing {
namespace {

/// What beam theory says of a double cantilever beam per thickness (shared reference: composites.md; Williams
/// 1989).
struct Beam {
  double modulus, shear, height, energy; ///< along the arms in plane strain, Pa; Pa; m; J/m²

  double inertia() const { return height * height * height / 12.0; }
  double chi() const {
    const double ratio = 1.18 * modulus / shear, share = ratio / (1.0 + ratio);
    return std::sqrt(modulus / (11.0 * shear) * (3.0 - 2.0 * share * share));
  }
  double greatest_load(double crack) const {
    return std::sqrt(energy * modulus * inertia()) / (crack + chi() * height);
  }
  double growth() const { // P √δ
    return std::sqrt(2.0 / 3.0) * std::pow(energy, 0.75) * std::pow(modulus * inertia(), 0.25);
  }
};

TEST(Cohesive, double_cantilever_beam_opens_as_beams_do) {
  const input::Case input =
      input::read_case(std::string(CNEM_SOURCE_DIR) + "/cases/verification/double_cantilever/case.toml");
  const FinishedRun done = finish(input);
  const double young = 34.28e9, poisson = 0.3;
  const Beam beam{young / (1.0 - poisson * poisson), young / (2.0 + 2.0 * poisson), 1e-3, 300.0};
  const std::vector<double>&load = done.of("support.up.force_y"), &place = done.of("probe.up.displacement_y"),
        &broken = done.of("cohesive.joint.broken");
  double greatest = 0.0; // waves run through the arms: means over half of their slowest period
  for (double time = 0.0; time < 4.6e-3; time += 0.02e-3)
    greatest = std::max(greatest, done.mean("support.up.force_y", time, time + 0.12e-3));
  EXPECT_NEAR(greatest, beam.greatest_load(14e-3), 0.06 * beam.greatest_load(14e-3));
  double sum = 0.0;
  int rows = 0;
  for (std::size_t r = 0; r < load.size(); ++r)
    if (broken[r] > 14.3e-3 && broken[r] < 17e-3) {
      sum += load[r] * std::sqrt(2.0 * place[r]);
      ++rows;
    }
  ASSERT_GT(rows, 30);
  EXPECT_NEAR(sum / rows, beam.growth(), 0.04 * beam.growth());
  EXPECT_LT(done.status.energy_residual, 1e-3);
}

// Two blocks on a bond that is inclined a little; the upper one is pulled off, pushed back, and slid.
const std::string blocks = R"toml(
[time]
end = "14 us"
[analysis]
thermal = false
[domain]
material = "steel"
outer.rectangle = { from = "0 0 mm", to = "4 2 mm" }
[domain.interfaces.joint]
points = ["0 0.9 mm", "4 1.1 mm"]
[domain.interfaces.joint.cohesive]
stiffness = "2e15 Pa/m"
strength = "120 MPa"
shear_strength = "90 MPa"
energy = "60 J/m2"
shear_energy = "120 J/m2"
eta = 1.5
[cloud]
spacing = "0.25 mm"
[materials.steel]
density = "7850 kg/m3"
elastic = { young = "210 GPa", poisson = 0.33 }
[contact]
deformable = true
friction = { law = "coulomb", coefficient = 0.2 }
[boundary.base]
pieces = ["bottom"]
velocity = "0 0 m/s"
[output]
history_every = "0.1 us"
)toml";
const std::string pulled_off = R"toml(
[boundary.top]
pieces = ["top"]
velocity.y = { times = "0 1 3 4 5 9 10 us", values = "0 4 4 0 -4 -4 0 m/s" }
velocity.x = { times = "0 9 10 us", values = "0 0 20 m/s" }
)toml";
const std::string sheared_off = R"toml(
[boundary.top]
pieces = ["top"]
velocity.y = { times = "0 1 3 4 us", values = "0 -2 -2 0 m/s" }
velocity.x = { times = "0 4 5 us", values = "0 0 10 m/s" }
)toml";

double energy(const FinishedRun& done, const std::string& name) { return done.of("energy." + name).back(); }

TEST(Cohesive, blocks_come_off_and_rub_on_each_other) {
  const FinishedRun done = finish(input::read_case_text(blocks + pulled_off, "case.toml", {}));
  EXPECT_NEAR(done.of("cohesive.joint.broken").back(), std::hypot(4e-3, 0.2e-3), 1e-9);
  EXPECT_EQ(energy(done, "cohesive_elastic"), 0.0);
  EXPECT_NEAR(energy(done, "cohesive_damage"), 60.0 * 4e-3, 0.1 * 60.0 * 4e-3); // waves shear it a little
  EXPECT_GT(energy(done, "friction"), energy(done, "elastic"));
  EXPECT_LT(done.status.energy_residual, 1e-3);
}

TEST(Cohesive, what_is_sheared_off_under_pressure_goes_over_to_contact) {
  const FinishedRun done = finish(input::read_case_text(blocks + sheared_off, "case.toml", {}));
  EXPECT_NEAR(done.of("cohesive.joint.broken").back(), std::hypot(4e-3, 0.2e-3), 1e-9);
  EXPECT_GT(energy(done, "cohesive_damage"), 120.0 * 4e-3); // and what pressure had stored
  EXPECT_LT(energy(done, "contact_recovery"), 0.02 * energy(done, "elastic"));
  EXPECT_LT(energy(done, "contact_impact"), 0.02 * energy(done, "elastic"));
  const double pressed = done.mean("body_contact.pressing", 10e-6, 14e-6);
  EXPECT_GT(pressed, 0.9 * std::abs(done.mean("support.top.force_y", 10e-6, 14e-6)));
  EXPECT_LT(done.status.energy_residual, 1e-3);
}

TEST(Cohesive, new_nodes_change_little) {
  const std::string soft =
      blocks + sheared_off + "[materials.steel.plastic]\nlaw = \"perfect\"\nyield = \"500 MPa\"\n";
  const FinishedRun given = finish(input::read_case_text(soft, "case.toml", {}));
  const FinishedRun resampled = finish(input::read_case_text(
      soft, "case.toml",
      {"adapt.resample=true", "adapt.indicator={field=\"plastic_strain\",h_min=\"0.12 mm\"}",
       "method.rereference.every=40"}));
  EXPECT_GT(resampled.metric("adapt.inserted"), 50.0);
  expect_nothing_lost(resampled);
  EXPECT_LT(resampled.status.energy_residual, 1e-3);
  EXPECT_NEAR(resampled.of("cohesive.joint.broken").back(), given.of("cohesive.joint.broken").back(), 1e-9);
  for (const char* name : {"cohesive_damage", "friction", "plastic"})
    EXPECT_NEAR(energy(resampled, name), energy(given, name), 0.05 * energy(given, name)) << name;
}

/// Bonds so stiff that they would take the step down to a third of what cells bear.
TEST(Cohesive, scaling_of_inertia_keeps_the_step_that_is_wanted_beside_stiff_bonds) {
  const std::string stiff = blocks + pulled_off;
  const auto steps = [&](const std::string& scaling) {
    return finish(input::read_case_text(stiff, "case.toml",
                                        {"time.end=\"1 us\"", scaling,
                                         "domain.interfaces.joint.cohesive.stiffness=\"2e17 Pa/m\""}))
        .status.steps;
  };
  constexpr double wanted = 1e-6 / 12e-9;
  EXPECT_LT(static_cast<double>(steps("time.mass_scaling.step=\"12 ns\"")), 1.1 * wanted);
  EXPECT_GT(static_cast<double>(steps("time.mass_scaling.factor=1")), 2.0 * wanted);
}

TEST(Cohesive, without_contact_compression_is_borne_for_good) {
  const FinishedRun done = finish(input::read_case_text(blocks + sheared_off, "case.toml", {"contact={}"}));
  EXPECT_NEAR(done.of("cohesive.joint.broken").back(), std::hypot(4e-3, 0.2e-3), 1e-9);
  EXPECT_GT(energy(done, "cohesive_elastic"), 0.1);
  EXPECT_EQ(energy(done, "friction"), 0.0);
  EXPECT_LT(done.status.energy_residual, 1e-3);
}

} // namespace
} // namespace cnem::testing
