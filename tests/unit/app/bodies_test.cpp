// Interfaces, regions, periodic pieces and imperfections as a user writes them.
#include "app/problem/bodies.hpp"
#include "app/problem/registry.hpp"
#include "core/error.hpp"
#include "input/case_reader.hpp"
#include "tests/solver_of.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace cnem::app {
namespace {

/// Two blocks side by side, 0 < x < 4 mm and 4 mm < x < 10 mm.
constexpr const char* blocks = R"toml(
[time]
end = "1 us"
[domain]
material = "steel"
outer.rectangle = { from = "0 0 mm", to = "10 2 mm" }
interfaces.joint.points = ["4 0 mm", "4 2 mm"]
regions.right = { at = "8 1 mm", material = "light" }
[cloud]
pattern = "jittered"
spacing = "0.5 mm"
[materials.steel]
density = "8000 kg/m3"
elastic = { young = "200 GPa", poisson = 0.0 }
heat = { specific_heat = "500 J/(kg K)", conductivity = "50 W/(m K)" }
[materials.light]
density = "2000 kg/m3"
elastic = { young = "50 GPa", poisson = 0.0 }
heat = { specific_heat = "900 J/(kg K)", conductivity = "200 W/(m K)" }
)toml";

input::Case read_bodies(const std::vector<std::string>& overrides) {
  return input::read_case_text(blocks, "blocks.toml", overrides);
}

ExplicitSolver<2> start(const std::vector<std::string>& overrides) {
  return testing::solver_of(read_bodies(overrides));
}

std::string refusal(const std::vector<std::string>& overrides) {
  try {
    build<2>(read_bodies(overrides));
  } catch (const InputError& error) { return error.what(); }
  return "";
}

TEST(Regions, nodes_take_the_material_of_their_side) {
  const ExplicitSolver<2> solver = start({});
  const auto& node = solver.state().node;
  double mass = 0.0;
  for (std::size_t i = 0; i < node.size(); ++i) {
    mass += node.mass[i];
    if (node.position[0][i] < 3.9e-3) { EXPECT_EQ(node.material[i], 0); }
    if (node.position[0][i] > 4.1e-3) { EXPECT_EQ(node.material[i], 1); }
  }
  EXPECT_NEAR(mass, 8000 * 8e-6 + 2000 * 12e-6, 1e-14);
}

/// A velocity that is linear in x keeps its gradient: no force acts inside, and the faces stay together.
TEST(Interface, faces_stay_together_to_the_last_bit_and_pass_the_patch_test) {
  for (const char* method : {"cnem", "fe-triangles"}) {
    ExplicitSolver<2> solver = start({"domain.regions={}", "initial.velocity_gradient={ xx = \"1e3 1/s\" }",
                                      "boundary.ends={ pieces = [\"left\"], velocity = { x = \"0 m/s\" } }",
                                      "boundary.pull={ pieces = [\"right\"], velocity = { x = \"10 m/s\" } }",
                                      "boundary.rails={ pieces = [\"top\", \"bottom\"], symmetry = true }",
                                      std::string("method.name=") + method, "method.lagrangian=total",
                                      "method.bulk_viscosity.linear=0", "analysis.thermal=false"});
    for (int n = 0; n < 100; ++n) solver.advance(2e-8);
    const auto& node = solver.state().node;
    for (std::size_t i = 0; i < node.size(); ++i) {
      EXPECT_NEAR(node.velocity[0][i], 1e3 * solver.state().node.initial_position[0][i], 1e-8);
      EXPECT_NEAR(node.velocity[1][i], 0.0, 1e-8);
    }
    ASSERT_FALSE(solver.conditions().cloud.twins.empty());
    for (const auto& [a, b] : solver.conditions().cloud.twins)
      for (std::size_t k = 0; k < 2; ++k)
        EXPECT_EQ(node.position[k][static_cast<std::size_t>(a)],
                  node.position[k][static_cast<std::size_t>(b)]);
    EXPECT_LT(std::abs(solver.ledger().residual()), 1e-6 * solver.ledger().total());
  }
}

/// A step of velocity v in the first body sends σ = v Z1 Z2/(Z1 + Z2) into both, Z = √(E ρ).
TEST(Interface, waves_part_by_the_impedances) {
  ExplicitSolver<2> solver = start(
      {"domain.outer.rectangle.to=\"40 2 mm\"", "domain.interfaces.joint.points=[\"20 0 mm\", \"20 2 mm\"]",
       "domain.regions={ right = { at = \"30 1 mm\", material = \"light\", velocity = \"-10 0 m/s\" } }",
       "boundary.rails={ pieces = [\"top\", \"bottom\"], symmetry = true }", "cloud.pattern=regular",
       "analysis.thermal=false"});
  while (solver.state().time < 2.5e-6) solver.advance(0.9 * solver.stable_step().dt);
  const double z1 = std::sqrt(200e9 * 8000), z2 = std::sqrt(50e9 * 2000);
  const double stress = 10.0 * z1 * z2 / (z1 + z2), speed = -10.0 * z2 / (z1 + z2);
  const auto& state = solver.state();
  double mass = 0.0, momentum = 0.0, area = 0.0, force = 0.0; // means: the fronts leave ripples behind
  for (std::size_t i = 0; i < state.node.size(); ++i) {
    if (std::abs(state.node.position[0][i] - 20e-3) > 5e-3) continue;
    const double volume = solver.approximation().mechanics.volume[i];
    mass += state.node.mass[i];
    momentum += state.node.mass[i] * state.node.velocity[0][i];
    area += volume;
    force -= volume * state.point.piola[0][i];
  }
  EXPECT_NEAR(force / area, stress, 0.01 * stress);
  EXPECT_NEAR(momentum / mass, speed, 0.01 * std::abs(speed));
  EXPECT_LT(std::abs(solver.ledger().residual()), 1e-3 * solver.ledger().total());
}

/// At rest the flux is ΔT/(L1/k1 + 1/h + L2/k2).
TEST(Interface, conductance_makes_the_temperature_jump) {
  ExplicitSolver<2> solver = start(
      {"analysis.mechanical=false", "domain.interfaces.joint.conductance=\"2e4 W/(m2 K)\"",
       "boundary.hot={ pieces = [\"left\"], temperature = \"500 K\" }",
       "boundary.cold={ pieces = [\"right\"], temperature = \"300 K\" }", "initial.temperature=\"400 K\""});
  while (solver.state().time < 8.0) solver.advance(solver.stable_step().dt);
  const double flux = 200.0 / (4e-3 / 50.0 + 1.0 / 2e4 + 6e-3 / 200.0);
  const auto& node = solver.state().node;
  ASSERT_FALSE(solver.conditions().cloud.twins.empty());
  for (const auto& [a, b] : solver.conditions().cloud.twins)
    EXPECT_NEAR(std::abs(node.temperature[static_cast<std::size_t>(a)] -
                         node.temperature[static_cast<std::size_t>(b)]),
                flux / 2e4, 1e-6 * flux / 2e4);
  EXPECT_LT(std::abs(solver.ledger().heat_residual()), 1e-9 * std::abs(solver.ledger()["heat_exchanged"]));
}

TEST(Interface, without_conductance_both_faces_have_one_temperature) {
  ExplicitSolver<2> solver =
      start({"analysis.mechanical=false", "domain.regions.right.temperature=\"600 K\""});
  const double before = solver.ledger()["heat_content"];
  for (int n = 0; n < 20; ++n) solver.advance(solver.stable_step().dt);
  for (const auto& [a, b] : solver.conditions().cloud.twins)
    EXPECT_EQ(solver.state().node.temperature[static_cast<std::size_t>(a)],
              solver.state().node.temperature[static_cast<std::size_t>(b)]);
  double scale = 0.0;
  for (const double c : solver.state().node.heat_capacity) scale += 300.0 * c;
  EXPECT_NEAR(solver.ledger()["heat_content"], before, 1e-13 * scale);
}

/// Both sides of a periodic strip move alike though only one of them is pushed.
TEST(Periodic, sides_move_alike) {
  ExplicitSolver<2> solver = start({"domain.interfaces={}", "domain.regions={}", "cloud.pattern=hexagonal",
                                    "periodic.strip.pieces=[\"left\", \"right\"]", "analysis.thermal=false",
                                    "boundary.push={ pieces = [\"left\"], traction = \"0 1 MPa\" }"});
  for (int n = 0; n < 50; ++n) solver.advance(solver.stable_step().dt);
  const Pairs pairs =
      tied_pairs(read_bodies({"domain.interfaces={}", "domain.regions={}", "cloud.pattern=hexagonal",
                              "periodic.strip.pieces=[\"left\", \"right\"]"}),
                 solver.conditions().cloud);
  ASSERT_EQ(pairs.motion.size(), 5U);
  const auto& node = solver.state().node;
  for (const auto& [a, b] : pairs.motion) {
    EXPECT_EQ(node.velocity[1][static_cast<std::size_t>(a)], node.velocity[1][static_cast<std::size_t>(b)]);
    EXPECT_NEAR(node.position[0][static_cast<std::size_t>(b)] - node.position[0][static_cast<std::size_t>(a)],
                10e-3, 1e-17);
    EXPECT_GT(node.velocity[1][static_cast<std::size_t>(a)], 0.0);
  }
  EXPECT_LT(std::abs(solver.ledger().residual()), 1e-4 * solver.ledger().external());
}

TEST(Periodic, pieces_that_do_not_match_are_refused) {
  const std::string message =
      refusal({"domain.interfaces={}", "domain.regions={}", "periodic.strip.pieces=[\"left\", \"top\"]"});
  EXPECT_NE(message.find("key 'periodic.strip.pieces': found 5 nodes on 'left' and 21 on 'top'"),
            std::string::npos)
      << message;
}

TEST(Regions, mistakes_are_refused) {
  EXPECT_NE(refusal({"domain.regions.left={ at = \"9 1 mm\" }"}).find("same part of the domain"),
            std::string::npos);
  EXPECT_NE(refusal({"domain.interfaces={}"}).find("found a region of an undivided domain"),
            std::string::npos);
  EXPECT_NE(refusal({"domain.regions.right.at=\"11 1 mm\""}).find("outside domain.outer"), std::string::npos);
  EXPECT_NE(refusal({"domain.regions.right.material=stel"}).find("did you mean"), std::string::npos);
  EXPECT_NE(refusal({"domain.interfaces.joint.points=[\"4 0 mm\", \"4 1 mm\"]"})
                .find("expected both ends on the boundary"),
            std::string::npos);
  EXPECT_NE(
      refusal({"domain.cracks.joint.points=[\"6 0 mm\", \"6 1 mm\"]"}).find("found the name of a crack"),
      std::string::npos);
  EXPECT_NE(refusal({"analysis.type=static", "analysis.thermal=false"}).find("found in a static analysis"),
            std::string::npos);
  EXPECT_NE(refusal({"analysis.mechanical=false", "initial.velocity=\"1 0 m/s\""}).find("without motion"),
            std::string::npos);
  EXPECT_NE(refusal({"analysis.mechanical=false", "analysis.thermal=false"}).find("nothing is solved for"),
            std::string::npos);
}

TEST(Imperfection, lowers_the_strength_around_a_line) {
  const input::Case input =
      read_bodies({"initial.imperfections.line={ points = [\"0 1 mm\", \"10 1 mm\"], width = \"0.5 "
                   "mm\", reduction = 0.1 }"});
  const app::Setup<2> setup = build<2>(input);
  const Field& factor = setup.problem.strength;
  ASSERT_EQ(factor.size(), setup.problem.cloud.position.size());
  for (std::size_t i = 0; i < factor.size(); ++i) {
    const double d = (setup.problem.cloud.position[i].y() - 1e-3) / 0.5e-3;
    EXPECT_NEAR(factor[i], 1.0 - 0.1 * std::exp(-d * d), 1e-14);
  }
}

} // namespace
} // namespace cnem::app
