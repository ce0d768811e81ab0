// Cracks that run: what they dissipate, and what their lips bear.
#include "tests/finished_run.hpp"
#include "tests/shared_cases.hpp"

#include <fmt/format.h>
#include <numbers>

namespace cnem::testing {
namespace {

constexpr double fracture_energy = 60e3, ligament = 2.0 * std::numbers::sqrt2 * 1e-3;
const std::string strip = notched_strip + R"toml(
fracture_energy = "60 kJ/m2"
[time]
end = "50 us"
[output]
history_every = "0.5 us"
pictures = []
)toml";

FinishedRun run_cracks(const std::string& text, const std::vector<std::string>& set = {}) {
  return finish(input::read_case_text(text, "case.toml", set));
}

TEST(RunningCrack, takes_the_fracture_energy_times_its_length_whatever_the_spacing) {
  for (const double spacing : {0.2, 0.14, 0.1}) {
    const FinishedRun done = run_cracks(strip, {fmt::format("cloud.spacing=\"{} mm\"", spacing)});
    expect_nothing_lost(done);
    EXPECT_GE(done.metric("adapt.cracks"), 1.0) << spacing;
    double taken = 0.0;
    for (const char* energy : {"energy.plastic", "energy.damage"}) taken += done.of(energy).back();
    EXPECT_NEAR(taken / (fracture_energy * ligament), 1.0, 0.1) << spacing;
    EXPECT_LT(std::abs(done.metric("area_drift")), 0.005) << spacing;
  }
}

/// A block that is sheared under a pressure of 200 MPa: rubble would bear 0.3/√3 of the flow stress, 87 MPa.
const std::string pressed = R"toml(
[time]
end = "40 us"
[domain]
material = "steel"
[domain.outer]
start = "0 0 mm"
path = [{ to = "4 0 mm", name = "bottom" }, { to = "4 0.45 mm" }, { to = "3.6 0.5 mm" }, { to = "4 0.55 mm" }, { to = "4 1 mm" }, { to = "0 1 mm", name = "top" }, { to = "0 0.55 mm" }, { to = "0.4 0.5 mm" }, { to = "0 0.45 mm" }, { to = "0 0 mm" }]
[cloud]
spacing = "0.08 mm"
pattern = "hexagonal"
[contact]
deformable = true
friction = { law = "coulomb", coefficient = 0.2 }
[boundary.bottom]
pieces = ["bottom"]
velocity = "0 0 m/s"
[boundary.top]
pieces = ["top"]
velocity = { x = { value = "8 m/s", ramp = "10 us", smooth = true } }
pressure = { value = "200 MPa", ramp = "10 us", smooth = true }
[method]
rereference = { every = 50, strain = 0.2 }
[output]
history_every = "0.2 us"
pictures = []
)toml" + cracking_steel + "fracture_energy = \"15 kJ/m2\"\nresidual_strength = 0.3\n";

TEST(RunningCrack, lips_that_are_pressed_on_each_other_keep_their_friction) {
  double shear[2];
  for (const int k : {0, 1}) {
    const FinishedRun done =
        run_cracks(pressed, {fmt::format("contact.friction.coefficient={}", k == 0 ? 0.2 : 0.05)});
    expect_nothing_lost(done);
    EXPECT_GE(done.metric("adapt.cracks"), 1.0);
    const std::vector<double>&time = done.of("time"), &x = done.of("support.top.force_x"),
          &y = done.of("support.bottom.force_y");
    double force = 0.0, pressing = 0.0;
    for (std::size_t r = 0; r < time.size(); ++r)
      if (time[r] > 36e-6) {
        force += x[r];
        pressing += y[r];
      }
    shear[k] = force / pressing;
  }
  // lips are rough on the scale of the cells, which takes some work more
  EXPECT_NEAR(shear[0], 0.2, 0.05);
  EXPECT_NEAR(shear[0] - shear[1], 0.15, 0.05);
}

} // namespace
} // namespace cnem::testing
