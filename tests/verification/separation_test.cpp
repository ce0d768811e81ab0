// A slug comes off: what is left of it are two bodies, with nothing lost, that do not go through each other.
#include "adapt/plane/structure.hpp"
#include "app/adaptation.hpp"
#include "app/simulation.hpp"
#include "tests/clouds.hpp"
#include "tests/finished_run.hpp"
#include "tests/solver_of.hpp"

#include <fmt/format.h>
#include <numbers>

namespace cnem::testing {
namespace {

/// Half of a sheet of 2 mm between a punch and a die, from x = `left` (mm) on.
std::string blank(double left = 0.0, const char* kinematics = "plane strain") {
  const auto x = [&](double from_left) { return fmt::format("{:g}", left + from_left); };
  return fmt::format(R"toml(
[analysis]
kinematics = "{kinematics}"
[time]
end = "40 us"
[domain]
material = "steel"
outer.rectangle = {{ from = "{x0} 0 mm", to = "{x6} 2 mm" }}
[cloud]
spacing = "0.25 mm"
[materials.steel]
density = "7850 kg/m3"
elastic = {{ young = "210 GPa", poisson = 0.3 }}
plastic = {{ law = "johnson-cook", A = "300 MPa", B = "400 MPa", n = 0.3, C = 0.02, rate0 = "1 /s", m = 1.0, T0 = "296 K", Tmelt = "1698 K" }}
heat = {{ specific_heat = "500 J/(kg K)", conductivity = "15 W/(m K)" }}
damage = {{ law = "johnson-cook", D1 = 0.2, D2 = 0.2, D3 = -1.5, fracture_energy = "30 kJ/m2", residual_strength = 0.3 }}
[contact]
deformable = true
conductance = "1e6 W/(m2 K)"
friction = {{ law = "coulomb", coefficient = 0.1 }}
[boundary.symmetry]
pieces = ["left"]
symmetry = true
[tools.punch]
start = "{x_1} 2 mm"
path = [{{ to = "{x3} 2 mm", fillet = "0.1 mm" }}, {{ to = "{x3} 6 mm" }}, {{ to = "{x_1} 6 mm" }}]
velocity = "0 -45 m/s"
[tools.die]
start = "{x9} 0 mm"
path = [{{ to = "{die} 0 mm", fillet = "0.1 mm" }}, {{ to = "{die} -3 mm" }}, {{ to = "{x9} -3 mm" }}]
[tools.holder] # rests on the sheet
rectangle = {{ from = "{holder} 2 mm", to = "{x9} 3 mm" }}
[method]
rereference = {{ every = 50, strain = 0.2 }}
[adapt]
resample = true
separate = true
tool_spacing = "0.12 mm"
[adapt.indicator]
field = "plastic_strain"
h_min = "0.12 mm"
[output]
history_every = "0.2 us"
pictures = []
)toml",
                     fmt::arg("kinematics", kinematics), fmt::arg("x0", x(0)), fmt::arg("x6", x(6)),
                     fmt::arg("x_1", x(-1)), fmt::arg("x3", x(3)), fmt::arg("x9", x(9)),
                     fmt::arg("die", x(3.1)), fmt::arg("holder", x(3.4)));
}

FinishedRun run_blank(const std::string& text, const std::vector<std::string>& set = {}) {
  return finish(input::read_case_text(text, "case.toml", set));
}

void expect_to_lose_nothing(const std::string& text, const std::string& enclosed) {
  const FinishedRun done = run_blank(text);
  EXPECT_GE(done.metric("adapt.cuts"), 1.0);
  EXPECT_GE(done.metric("adapt.opened"), 5.0);
  expect_nothing_lost(done);
  EXPECT_LT(std::abs(done.metric(enclosed + "_drift")), 0.005);
  double cuts = 0.0;
  for (const double c : done.of_changes("cuts")) cuts += c;
  EXPECT_EQ(cuts, done.metric("adapt.cuts"));
  EXPECT_EQ(static_cast<double>(done.events.rows()), done.metric("adapt.passes"));
  for (std::size_t e = 1; e < done.events.rows(); ++e)
    EXPECT_EQ(done.of_changes("before.nodes")[e], done.of_changes("after.nodes")[e - 1]);
  // the punch pushes nothing but the slug any more
  const std::vector<double>& force = done.of("punch.force_y");
  double last = 0.0, peak = 0.0;
  for (std::size_t r = 0; r < force.size(); ++r) {
    peak = std::max(peak, std::abs(force[r]));
    if (r + 10 >= force.size()) last += std::abs(force[r]) / 10.0;
  }
  EXPECT_LT(last, 0.15 * peak);
}

TEST(Separation, of_a_slug_loses_nothing) { expect_to_lose_nothing(blank(), "area"); }
TEST(Separation, of_a_round_slug_loses_nothing) {
  expect_to_lose_nothing(blank(0.0, "axisymmetric"), "enclosed_volume");
}

/// The largest force of the punch in the first 0.3 mm.
double largest_force(const std::string& text) {
  return run_blank(text, {"time.end=\"7 us\""}).metric("peak_force.punch");
}

TEST(Separation, a_slug_of_fifty_times_the_thickness_takes_the_force_of_the_plane_per_perimeter) {
  const double radius = 0.1, perimeter = 2.0 * std::numbers::pi * radius; // of the punch, m
  const double plane = largest_force(blank());
  EXPECT_NEAR(largest_force(blank(97.0, "axisymmetric")) / perimeter, plane, 0.02 * plane);
}

TEST(Separation, makes_two_bodies) {
  const input::Case input = input::read_case_text(blank(), "case.toml", {});
  const TemporaryFolder folder("separation");
  ExplicitSolver<2> solver = testing::solver_of(input);
  app::StepControl control(input.time);
  app::ReferenceRenewal renewal(input.method);
  app::Adaptation adaptation(input, solver);
  adaptation.start_log(folder.path());
  const auto nothing = [](const Resampling<2>&) {};
  adaptation.fit_to_tools(solver, nothing);
  while (solver.state().time < input.time.end * (1.0 - 1e-9)) {
    const bool renewed = renewal.due(solver);
    if (renewed) renewal.renew(solver, [&] { adaptation.renew(solver, nothing); });
    if (renewed || solver.state().step % 10 == 0) control.refresh(solver);
    solver.advance(control.choose(solver.state().time, input.time.end));
  }
  const Cloud<2> cloud = solver.present_cloud();
  EXPECT_GE(loops(cloud), 2);
  EXPECT_TRUE(adapt::structure_if_valid(cloud)) << "boundaries cross";
  int faces = 0;
  for (const Facet<2>& facet : cloud.facets) faces += cloud.piece_names[facet.piece] == "fracture";
  EXPECT_GE(faces, 10);
}

} // namespace
} // namespace cnem::testing
