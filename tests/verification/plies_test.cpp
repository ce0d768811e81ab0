// Plies through the whole program: plane waves, energies of breaking, restarts of the reference.
#include "app/problem/registry.hpp"
#include "app/simulation.hpp"
#include "input/case_reader.hpp"
#include "tests/solver_of.hpp"

#include <Eigen/Eigenvalues>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace cnem::app {
namespace {

/// UD-GFRP of paper 000, Table 2.
std::string gfrp(double degrees, const std::string& failure = "") {
  return fmt::format(R"toml(
[materials.ply]
density = "1580 kg/m3"
elastic = {{ law = "orthotropic", E1 = "34.28 GPa", E2 = "11.57 GPa", nu12 = 0.24244, G12 = "2.05 GPa", angle = "{} deg" }}
{})toml",
                     degrees, failure);
}

const std::string strengths =
    R"(Xt = "697.8 MPa", Xc = "443.76 MPa", Yt = "89.7216 MPa", Yc = "148.33 MPa", S = "33.1 MPa", eps1t = 0.023,
  Gft = "12.5 kJ/m2", Gfc = "12.5 kJ/m2", Gmt = "1 kJ/m2", Gmc = "1 kJ/m2")";

std::string failing(const std::string& law, const std::string& more = "") {
  return fmt::format(
      "[materials.ply.failure]\nlaw = \"{}\"\n{}\n{}", law,
      [] {
        std::string lines = strengths;
        for (std::size_t at; (at = lines.find(", ")) != std::string::npos;) lines.replace(at, 2, "\n");
        for (std::size_t at; (at = lines.find(",\n")) != std::string::npos;) lines.replace(at, 2, "\n");
        return lines;
      }(),
      more);
}

/// Runs to a time, or until `stop` of the solver, with references as the case has them.
template<class Stop>
void run_until(const input::Case& input, ExplicitSolver<2>& solver, double end, Stop&& stop) {
  StepControl control(input.time);
  ReferenceRenewal renewal(input.method);
  while (solver.state().time < end * (1.0 - 1e-9) && !stop()) {
    const bool renewed = renewal.due(solver);
    if (renewed) renewal.renew(solver, [&] { solver.prepare(); });
    if (renewed || solver.state().step % 10 == 0) control.refresh(solver);
    solver.advance(control.choose(solver.state().time, end));
  }
}

// A strip, endless along y, in which a standing wave swings between the free ends.
const std::string strip = R"toml(
[analysis]
thermal = false
kinematics = "plane stress"
[time]
end = "10 us"
[domain]
material = "ply"
outer.rectangle = { from = "0 0 mm", to = "4 0.2 mm" }
[cloud]
spacing = "0.05 mm"
pattern = "regular"
[method]
bulk_viscosity = { linear = 0.0, quadratic = 0.0 }
[periodic.sides]
pieces = ["bottom", "top"]
)toml";

TEST(Plies, plane_waves_run_at_the_speeds_of_christoffel) {
  const double length = 4e-3, density = 1580.0;
  for (const char* kinematics : {"plane stress", "plane strain"})
    for (const double degrees : {0.0, 20.0, 45.0, 70.0, 90.0}) {
      const input::Case input = input::read_case_text(
          strip + gfrp(degrees), "case.toml", {fmt::format("analysis.kinematics=\"{}\"", kinematics)});
      // (C_xx C_xs; C_xs C_ss)/ρ of a normal along x
      const auto plane =
          plasticity::plane_stiffness(*input.materials[0].ply, std::string(kinematics) == "plane stress");
      const Mat<2> acoustic =
          (Mat<2>() << plane.D[0][0], plane.D[0][2], plane.D[2][0], plane.D[2][2]).finished() / density;
      const Eigen::SelfAdjointEigenSolver<Mat<2>> christoffel(acoustic);
      for (const int wave : {0, 1}) {
        const Vec2 direction = christoffel.eigenvectors().col(wave);
        const double speed = std::sqrt(christoffel.eigenvalues()[wave]);
        Setup<2> setup = build<2>(input);
        const auto& position = setup.problem.cloud.position;
        const double k = std::numbers::pi / length, size = 1e-3; // m/s: strains of 1e-6
        for (std::size_t i = 0; i < position.size(); ++i)
          for (int c : {0, 1})
            setup.velocity[static_cast<std::size_t>(c)][i] =
                size * direction[c] * std::cos(k * position[i].x());
        ExplicitSolver<2> solver(std::move(setup.problem), std::move(setup.velocity),
                                 std::move(setup.temperature));
        // the part of the wave in all velocities, which falls through zero after a quarter of 2 L/c
        const auto part = [&] {
          double sum = 0.0;
          const NodeState<2>& node = solver.state().node;
          for (std::size_t i = 0; i < node.size(); ++i)
            sum += node.mass[i] * std::cos(k * node.initial_position[0][i]) *
                   (direction.x() * node.velocity[0][i] + direction.y() * node.velocity[1][i]);
          return sum;
        };
        double before = part(), last = 0.0, crossed = 0.0;
        run_until(input, solver, input.time.end, [&] {
          const double now = part(), time = solver.state().time - 0.5 * solver.state().step_before;
          if (now <= 0.0 && before > 0.0) crossed = last + (time - last) * before / (before - now);
          before = now, last = time;
          return crossed > 0.0;
        });
        EXPECT_NEAR(crossed * 2.0 * speed / length, 1.0, 0.01)
            << kinematics << " " << degrees << "° " << speed;
      }
    }
}

/// A bar that is pulled (v > 0) or pushed apart along x by its ends, everything at first in the motion that
/// it would go on with, weaker in the middle.
std::string bar(int cells) {
  return fmt::format(R"toml(
[analysis]
thermal = false
kinematics = "plane stress"
[domain]
material = "ply"
outer.rectangle = {{ from = "-0.5 0 mm", to = "0.5 0.2 mm" }}
[cloud]
spacing = "{} mm"
pattern = "regular"
[initial.imperfections.weak]
points = ["0 -1 mm", "0 1 mm"]
width = "0.1 mm"
reduction = 0.05
)toml",
                     1.0 / cells);
}

struct BrokenBar {
  double failure, work, residual; ///< J/m
};

BrokenBar break_bar(const std::string& text, double end, const std::vector<std::string>& more = {}) {
  const input::Case input = input::read_case_text(text, "case.toml", more);
  ExplicitSolver<2> solver = testing::solver_of(input);
  run_until(input, solver, end, [] { return false; });
  const auto ledger = solver.ledger();
  return {ledger["failure"], ledger.external() + ledger.initial(), ledger.residual()};
}

} // namespace
} // namespace cnem::app
