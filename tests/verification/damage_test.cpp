// Material that breaks: what it takes does not depend on the spacing.
#include "app/simulation.hpp"
#include "input/case_reader.hpp"
#include "tests/solver_of.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace cnem::app {
namespace {

const std::string damaged_steel = R"toml(
[analysis]
thermal = false
[time]
end = "40 us"
[materials.steel]
density = "7850 kg/m3"
elastic = { young = "210 GPa", poisson = 0.3 }
plastic = { law = "perfect", yield = "500 MPa" }
damage = { law = "johnson-cook", D1 = 0.005, D2 = 0.0, D3 = 0.0, fracture_energy = "40 kJ/m2" }
)toml";

// A strip, endless along x, whose upper and lower sides slide past each other; the middle is a little weaker.
const std::string strip = damaged_steel + R"toml(
[domain]
material = "steel"
outer.rectangle = { from = "0 -0.5 mm", to = "0.2 0.5 mm" }
[cloud]
spacing = "0.05 mm"
pattern = "regular"
[initial]
velocity_gradient = { xy = "10000 1/s" }
imperfections.weak = { points = ["-1 0 mm", "1 0 mm"], width = "0.1 mm", reduction = 0.05 }
[periodic.sides]
pieces = ["left", "right"]
[boundary.lower]
pieces = ["bottom"]
velocity = { x = "-5 m/s", y = "0 m/s" }
[boundary.upper]
pieces = ["top"]
velocity = { x = "5 m/s", y = "0 m/s" }
)toml";

// A bar pulled at both ends, with a weaker middle.
const std::string bar = damaged_steel + R"toml(
[domain]
material = "steel"
outer.rectangle = { from = "-0.6 0 mm", to = "0.6 0.4 mm" }
[cloud]
spacing = "0.1 mm"
pattern = "regular"
[initial]
velocity_gradient = { xx = "8333 1/s" }
imperfections.weak = { points = ["0 -1 mm", "0 1 mm"], width = "0.15 mm", reduction = 0.1 }
[boundary.left]
pieces = ["left"]
velocity = { x = "-5 m/s" }
[boundary.right]
pieces = ["right"]
velocity = { x = "5 m/s" }
)toml";

/// Work of the supports, J/m, at eight equal times, the last one the end of the run.
struct Breaking {
  std::vector<double> work;
  double plastic = 0.0;
};

Breaking break_it(const std::string& text, const std::string& spacing, std::vector<std::string> more = {}) {
  more.push_back(fmt::format("cloud.spacing=\"{}\"", spacing));
  const input::Case input = input::read_case_text(text, "case.toml", more);
  ExplicitSolver<2> solver = testing::solver_of(input);
  StepControl control(input.time);
  ReferenceRenewal renewal(input.method);
  Breaking result;
  for (int k = 1; k <= 8; ++k) {
    const double until = input.time.end * k / 8.0;
    while (solver.state().time < until * (1.0 - 1e-9)) {
      const bool renewed = renewal.due(solver);
      if (renewed) renewal.renew(solver, [&] { solver.prepare(); });
      if (renewed || solver.state().step % 10 == 0) control.refresh(solver);
      solver.advance(control.choose(solver.state().time, until));
    }
    result.work.push_back(solver.ledger()["support_work"]);
  }
  result.plastic = solver.ledger()["plastic"];
  EXPECT_LT(std::abs(solver.ledger().residual()),
            0.003 * (solver.ledger().external() + solver.ledger().initial()));
  const Field& softening = solver.state().point.softening;
  EXPECT_EQ(*std::max_element(softening.begin(), softening.end()), 1.0);
  return result;
}

TEST(Separation, of_a_sheared_strip_takes_the_fracture_energy_at_any_spacing) {
  const double expected = 40e3 * 0.2e-3; // G_f times the width, J/m
  const Breaking coarse = break_it(strip, "0.05 mm"), fine = break_it(strip, "0.025 mm");
  EXPECT_NEAR(fine.plastic, expected, 0.05 * expected);
  EXPECT_NEAR(coarse.plastic, fine.plastic, 0.06 * fine.plastic);
  for (std::size_t k = 0; k < fine.work.size(); ++k) // the force-displacement curve, integrated
    EXPECT_NEAR(coarse.work[k], fine.work[k], 0.09 * fine.work.back()) << k;
  for (const char* lagrangian : {"total", "periodic"}) {
    const Breaking triangles = break_it(strip, "0.05 mm",
                                        {"method.name=fe-triangles", "materials.steel.damage.band=1.8",
                                         std::string("method.lagrangian=") + lagrangian});
    EXPECT_NEAR(triangles.plastic, expected, 0.06 * expected) << lagrangian;
  }
}

TEST(Separation, of_a_bar_in_tension_does_not_depend_on_the_spacing) {
  const Breaking h = break_it(bar, "0.1 mm"), half = break_it(bar, "0.05 mm"),
                 quarter = break_it(bar, "0.025 mm");
  EXPECT_NEAR(h.plastic, half.plastic, 0.08 * half.plastic);
  EXPECT_NEAR(quarter.plastic, half.plastic, 0.05 * half.plastic);
  for (std::size_t k = 0; k < half.work.size(); ++k) {
    EXPECT_NEAR(h.work[k], half.work[k], 0.1 * half.work.back()) << k;
    EXPECT_NEAR(quarter.work[k], half.work[k], 0.05 * half.work.back()) << k;
  }
}

// Dust that flies apart: what does not bear does not hold the step, on this reference or the next. Lengths
// grow by s, what is left of the moduli falls by s² with the density, and the bulk modulus is gone.
TEST(Separation, into_dust_leaves_the_step_to_what_bears) {
  const input::Case input = input::read_case_text(
      damaged_steel + R"toml(
[domain]
material = "steel"
outer.rectangle = { from = "-0.5 -0.5 mm", to = "0.5 0.5 mm" }
[cloud]
spacing = "0.1 mm"
[initial]
velocity_gradient = { xx = "1e7 1/s", yy = "1e7 1/s" }
[method]
lagrangian = "periodic"
)toml",
      "case.toml",
      {"materials.steel.damage.D1=1e-9", "materials.steel.damage.fracture_energy=\"1 J/m2\"",
       "method.bulk_viscosity.linear=0", "method.bulk_viscosity.quadratic=0"});
  ExplicitSolver<2> solver = testing::solver_of(input);
  const double first = solver.stable_step().dt;
  while (solver.state().time < 0.05e-6) solver.advance(0.02 * first);
  const State<2>& state = solver.state();
  ASSERT_EQ(*std::min_element(state.point.softening.begin(), state.point.softening.end()), 1.0);
  const plasticity::Elasticity elasticity{.young = 210e9, .poisson = 0.3};
  const double shear = 4.0 / 3.0 * elasticity.mu(), s = 1.0 + 1e7 * state.time,
               expected = first * s * std::sqrt((elasticity.kappa() + shear) / shear);
  EXPECT_NEAR(solver.stable_step().dt, expected, 0.02 * expected);
  solver.prepare();
  EXPECT_NEAR(solver.stable_step().dt, expected, 0.02 * expected);
}

} // namespace
} // namespace cnem::app
