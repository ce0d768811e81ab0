// Adaptation beside what else a case can ask for: both work, and nothing is lost by it.
#include "tests/verification/adapted_run.hpp"

namespace cnem::testing {
namespace {

// A slot that a plate closes, until its faces touch.
const std::string slotted = R"toml(
[time]
end = "8 us"
[domain]
material = "steel"
[domain.outer]
start = "0 0 mm"
path = [
  { to = "3 0 mm", name = "base" },
  { to = "3 0.9 mm" }, { to = "1 0.9 mm" }, { to = "1 1.2 mm" }, { to = "3 1.2 mm" }, { to = "3 2 mm" }, { to = "0 2 mm" },
]
[cloud]
spacing = "0.2 mm"
[boundary.base]
pieces = ["base"]
symmetry = true
[contact]
deformable = true
friction = { law = "coulomb", coefficient = 0.1 }
[tools.plate]
rectangle = { from = "-1 2 mm", to = "5 3 mm" }
velocity = "0 -60 m/s"
)toml" + steel_body;

TEST(Adaptation, carries_scaled_masses) {
  const Adapted plain = run(punched, by_strain),
                scaled = run(punched, with(by_strain, {"time.mass_scaling.factor=4"}));
  EXPECT_LT(scaled.status.steps, 0.65 * static_cast<double>(plain.status.steps));
  EXPECT_NEAR(scaled.energy("plastic"), plain.energy("plastic"), 0.1 * plain.energy("plastic"));
}

TEST(Adaptation, carries_local_time_steps) {
  const Texts graded{"adapt.tool_spacing=0.03 mm", "time.end=4 us"};
  const Adapted global = run(punched, graded), local = run(punched, with(graded, {"time.step.local=true"}));
  EXPECT_LT(local.status.steps, global.status.steps / 2);
  EXPECT_LT(1.5 * static_cast<double>(local.status.node_steps),
            static_cast<double>(global.status.node_steps));
  EXPECT_NEAR(local.energy("plastic"), global.energy("plastic"), 0.01 * global.energy("plastic"));
}

TEST(Adaptation, carries_the_exchange_and_the_annealing_of_stresses) {
  const Adapted plain = run(punched, by_strain),
                exchanged = run(punched,
                                with(by_strain, {"method.pressure_exchange=2", "method.stress_annealing=1"}));
  EXPECT_GT(exchanged.energy("pressure_exchange"), 0.0);
  EXPECT_GT(exchanged.energy("stress_annealing"), 0.0);
  EXPECT_GT(exchanged.metric("max.volume_drift"), 0.0);
  // cells of this size are stiffer with the noise: it takes work
  EXPECT_NEAR(exchanged.energy("plastic"), plain.energy("plastic"), 0.02 * plain.energy("plastic"));
}

TEST(Adaptation, carries_damage_without_making_energy) {
  const Adapted broken = run(punched + brittle, by_strain);
  EXPECT_EQ(broken.metric("max_damage"), 1.0);
  EXPECT_GT(broken.counted("inserted"), 50);
  EXPECT_GT(broken.energy("rereference"), -1e-3 * broken.work()) << "stored energy comes from nowhere";
}

TEST(Adaptation, refines_where_damage_is_not_resolved) {
  const Adapted broken =
      run(punched + brittle, {"adapt.indicator.field=damage", "adapt.indicator.h_min=0.1 mm"});
  EXPECT_GT(broken.counted("refined"), 20);
  EXPECT_GT(broken.counted("inserted"), 30);
}

TEST(Adaptation, carries_bodies_in_contact) {
  const Adapted closed = run(slotted, by_strain);
  const std::vector<double>& pressing = closed.column("body_contact.pressing[N/m]");
  EXPECT_GT(*std::max_element(pressing.begin(), pressing.end()), 1e4);
  EXPECT_GT(closed.counted("inserted"), 50);
}

TEST(Adaptation, carries_loads_supports_and_a_free_tool) {
  const Adapted loaded = run(block_case + R"toml(
[tools.punch]
rectangle = { from = "-1 2 mm", to = "1.1 5 mm" }
mass = "2 kg/m"
direction = "0 1"
initial_velocity = "0 -60 m/s"
[boundary.right]
pieces = ["right"]
pressure = "20 MPa"
convection = { coefficient = "1e4 W/(m2 K)", ambient = "400 K" }
[boundary.left]
pieces = ["left"]
velocity = { x = "0 m/s" }
temperature = "300 K"
[output.probes.corner]
at = "1 1.5 mm"
fields = ["temperature", "plastic_strain"]
)toml",
                             by_strain);
  EXPECT_LT(loaded.energy("tool_kinetic"), 0.95 * 0.5 * 2.0 * 60.0 * 60.0);
  EXPECT_GT(loaded.column("probe.corner.plastic_strain").back(), 0.01);
  const std::vector<double>& push = loaded.column("support.left.force_x[N/m]");
  EXPECT_GT(*std::max_element(push.begin(), push.end()), 20e6 * 2e-3 * 0.5);
}

} // namespace
} // namespace cnem::testing
