// Rolled sheet through the whole program: plane strain compression of a section against Hill's closed form.
#include "app/simulation.hpp"
#include "input/case_reader.hpp"
#include "tests/solver_of.hpp"

#include <gtest/gtest.h>

namespace cnem::app {
namespace {

// A quarter of a block between smooth plates, free at its right side.
const std::string block = R"toml(
[analysis]
thermal = false
[time]
end = "20 us"
[domain]
material = "sheet"
outer.rectangle = { from = "0 0 mm", to = "1 0.5 mm" }
[cloud]
spacing = "0.1 mm"
[method]
rereference = { every = 50, strain = 0.01 }
[materials.sheet]
density = "7850 kg/m3"
elastic = { young = "210 GPa", poisson = 0.3 }
plastic = { law = "perfect", yield = "400 MPa" }
[initial]
velocity_gradient = { xx = "2000 1/s", yy = "-2000 1/s" }
[boundary.left]
pieces = ["left"]
symmetry = true
[boundary.bottom]
pieces = ["bottom"]
symmetry = true
[boundary.plate]
pieces = ["top"]
velocity = { y = "-1 m/s" }
)toml";

/// Largest |(τ_xx − τ_yy)/σ̄ − expected| of the points at the end.
double worst(const std::string& anisotropy, double expected) {
  std::vector<std::string> more;
  if (!anisotropy.empty()) more.push_back("materials.sheet.anisotropy=" + anisotropy);
  const input::Case input = input::read_case_text(block, "case.toml", more);
  ExplicitSolver<2> solver = testing::solver_of(input);
  StepControl control(input.time);
  ReferenceRenewal renewal(input.method);
  int references = 0;
  while (solver.state().time < input.time.end * (1.0 - 1e-9)) {
    const bool renewed = renewal.due(solver);
    if (renewed) renewal.renew(solver, [&] { solver.prepare(); });
    references += renewed;
    if (renewed || solver.state().step % 10 == 0) control.refresh(solver);
    solver.advance(control.choose(solver.state().time, input.time.end));
  }
  EXPECT_GT(references, 0);
  const auto ledger = solver.ledger();
  EXPECT_LT(std::abs(ledger.residual()), 1e-3 * (ledger.external() + ledger.initial()));
  const PointState<2>& point = solver.state().point;
  double error = 0.0;
  for (std::size_t p = 0; p < point.size(); ++p) {
    const auto& f = point.deformation;
    const auto& s = point.piola;
    const double difference =
        (s[0][p] * f[0][p] + s[1][p] * f[1][p] - s[2][p] * f[2][p] - s[3][p] * f[3][p]) /
        point.stress_free[p];
    error = std::max(error, std::abs(difference / 400e6 - expected));
  }
  return error;
}

TEST(Sheet, plane_strain_compression_takes_what_hill_says) {
  EXPECT_LT(worst("", 2.0 / std::sqrt(3.0)), 2e-3);
  for (const double r : {0.6, 1.8})
    EXPECT_LT(worst("{ law = \"hill48\", r0 = " + std::to_string(r) + " }", (1 + r) / std::sqrt(1 + 2 * r)),
              2e-3)
        << r;
  const double r0 = 1.8, r90 = 2.4, G = 1 / (1 + r0), H = r0 * G, F = H / r90;
  EXPECT_LT(worst("{ law = \"hill48\", r0 = 1.8, r90 = 2.4 }", std::sqrt(1 / (G + F * H / (F + H)))), 2e-3);
  EXPECT_LT(worst("{ law = \"hill48\", r0 = 1.8, r90 = 2.4, rolling = \"z\" }",
                  std::sqrt(1 / (F + G * H / (G + H)))),
            2e-3);
}

} // namespace
} // namespace cnem::app
