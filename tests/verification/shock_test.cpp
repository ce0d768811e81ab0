// A piston drives a plane shock into metal. Without shear its speed is that of the equation of state,
// U = C + S1 u, which is how S1 is measured: p = ρ0 C² ε/(1 − S1 ε)², ε = u/U the compression.
#include "tests/finished_run.hpp"

#include <fmt/format.h>

namespace cnem::testing {
namespace {

constexpr double speed_of_sound = 5328.0, slope = 1.338, piston = 300.0, density = 2785.0;
const double bulk = density * speed_of_sound * speed_of_sound;
// The little shear stiffness that keeps the nodes in order.
const plasticity::Elasticity soft = plasticity::Elasticity{10e9, 0.33}.with_bulk_modulus(bulk);

/// m/s, between two probes 2 mm apart that the metal takes along; `state`: the equation of it.
double shock_speed(const std::string& state) {
  const std::string text = fmt::format(R"toml(
[time]
end = "0.65 us"
[domain]
material = "metal"
outer.rectangle = {{ from = "0 0 mm", to = "4 0.2 mm" }}
[cloud]
spacing = "25 um"
[materials.metal]
density = "{} kg/m3"
elastic = {{ young = "{:.17g} Pa", poisson = {:.17g} }}
{}
[boundary.piston]
pieces = "left"
velocity = {{ x = "{} m/s" }}
[boundary.walls]
pieces = ["bottom", "top"]
velocity = {{ y = "0 m/s" }}
[output]
history_every = "1 ns"
pictures = []
probes.near = {{ at = "1 0.1 mm", fields = ["pressure"] }}
probes.far = {{ at = "3 0.1 mm", fields = ["pressure"] }}
)toml",
                                       density, soft.young, soft.poisson, state, piston);
  const FinishedRun done = finish(input::read_case_text(text, "case.toml", {}));
  EXPECT_LT(done.status.energy_residual, 1e-3);
  const double half = 0.5 * density * speed_of_sound * piston;
  const auto arrival = [&](const char* probe) {
    const std::vector<double>&time = done.of("time"),
          &pressure = done.of(fmt::format("probe.{}.pressure", probe));
    std::size_t k = 1;
    while (k + 1 < time.size() && pressure[k] < half) ++k;
    const double s = (half - pressure[k - 1]) / (pressure[k] - pressure[k - 1]);
    return time[k - 1] + s * (time[k] - time[k - 1]);
  };
  return 2e-3 / (arrival("far") - arrival("near"));
}

/// U of ρ0 U u = p(ε) + 4/3 μ ln(1/(1 − ε))/(1 − ε), the stress along the shock.
template<class Pressure> double expected_speed(const Pressure& pressure) {
  double speed = speed_of_sound;
  for (int i = 0; i < 100; ++i) {
    const double compression = piston / speed, length = 1.0 - compression;
    const double stress = pressure(compression) - 4.0 / 3.0 * soft.mu() * std::log(length) / length;
    speed = std::sqrt(stress / (density * compression)); // ρ0 U u = ρ0 U² ε
  }
  return speed;
}

TEST(Shock, RunsAtTheSpeedOfItsEquationOfState) {
  const double expected = expected_speed(
      [](double compression) { return bulk * compression / std::pow(1.0 - slope * compression, 2); });
  EXPECT_NEAR(shock_speed(fmt::format(
                  "equation_of_state = {{ law = \"mie-gruneisen\", S1 = {}, gamma0 = 2.0 }}", slope)),
              expected, 3e-3 * expected);
}

TEST(Shock, RunsSlowerWithTheLogarithmicLaw) {
  const double expected = expected_speed(
      [](double compression) { return -bulk * std::log(1.0 - compression) / (1.0 - compression); });
  EXPECT_NEAR(shock_speed(""), expected, 3e-3 * expected);
}

} // namespace
} // namespace cnem::testing
