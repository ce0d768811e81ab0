// Stress intensity factors of whole cases against boundary collocation and handbook values.
#include "app/statics/static_model.hpp"
#include "input/case_reader.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fmt/format.h>
#include <fstream>
#include <map>
#include <numbers>

namespace cnem::testing {
namespace {

struct Solved {
  std::map<std::string, app::TipResult> tip;
  std::vector<std::string> closed;
  double strain_energy = 0.0;
};

Solved solve(const input::Case& input) {
  const app::StaticModel<2> model(input);
  const StaticSolution<2> solution = solve_statics(model.problem());
  Solved result;
  for (const app::TipResult& tip : app::evaluate_tips(model, solution)) result.tip.emplace(tip.name, tip);
  result.closed = app::closed_cracks(model, solution);
  result.strain_energy = solution.strain_energy;
  return result;
}

const std::string paper_case = CNEM_SOURCE_DIR "/cases/paper/crack_straight/case.toml";

/// σ√(πa) of the paper's plate.
double unit(double a) { return 1e6 * std::sqrt(std::numbers::pi * a); }

struct Reference {
  double angle, K_I, K_II; ///< degrees; over σ√(πa), boundary collocation for the finite plate, a/W = 0.1
};
constexpr std::array<Reference, 3> finite_plate{
    {{0, 1.01395, 0}, {30, 0.75992, 0.43744}, {60, 0.25293, 0.43679}}};

TEST(CrackInPlate, both_modes_are_within_1_percent_at_the_papers_760_nodes_with_enrichment_and_3_without) {
  for (const Reference& reference : finite_plate)
    for (const bool enriched : {true, false}) {
      SCOPED_TRACE(fmt::format("{} degrees, enrichment {}", reference.angle, enriched));
      const input::Case input = input::read_case(
          paper_case, {fmt::format("domain.cracks.main.rotate.angle={} deg", reference.angle),
                       fmt::format("fracture.enrichment={}", enriched)});
      const Solved solved = solve(input);
      ASSERT_EQ(solved.tip.size(), 2U);
      const double tolerance = (enriched ? 0.01 : 0.03) * unit(1e-4);
      for (const auto& [name, tip] : solved.tip) {
        EXPECT_NEAR(tip.intensity.K_I, reference.K_I * unit(1e-4), tolerance) << name;
        EXPECT_NEAR(tip.intensity.K_II, reference.K_II * unit(1e-4), tolerance) << name;
        EXPECT_LT(tip.spread, enriched ? 0.005 : 0.15) << name;
        EXPECT_EQ(app::doubt(tip).empty(), enriched) << app::doubt(tip);
      }
      EXPECT_TRUE(solved.closed.empty());
    }
}

TEST(CrackInPlate, without_enrichment_the_spread_covers_the_error_and_is_warned_of) {
  // a/W = 0.5 at 45°. Domains with a plateau agree within 0.4% at a uniform spacing of 0.1 a, where K_II is
  // off by 4%. Reference: this code enriched, 4,902 and 7,590 nodes (0.6688, 0.6166 and 0.6689, 0.6166).
  constexpr double K_I = 0.6689, K_II = 0.6166;
  const std::vector<std::string> crack{"domain.cracks.main.points=[\"-0.5 0 mm\", \"0.5 0 mm\"]",
                                       "domain.cracks.main.rotate.angle=45 deg"};
  for (const auto& [away, at_tip] : std::array<std::array<const char*, 2>, 3>{
           {{"0.05 mm", "0.05 mm"}, {"0.1 mm", "0.04 mm"}, {"0.1 mm", "0.008 mm"}}})
    for (const bool enriched : {true, false}) {
      SCOPED_TRACE(fmt::format("spacing {} and {}, enrichment {}", away, at_tip, enriched));
      std::vector<std::string> set = crack;
      set.push_back(fmt::format("cloud.spacing={}", away));
      set.push_back(fmt::format("cloud.refine.tips.spacing={}", at_tip));
      set.push_back(fmt::format("fracture.enrichment={}", enriched));
      for (const auto& [name, tip] : solve(input::read_case(paper_case, set)).tip) {
        const double error =
            std::hypot(tip.intensity.K_I / unit(5e-4) - K_I, tip.intensity.K_II / unit(5e-4) - K_II) /
            std::hypot(K_I, K_II);
        if (enriched) {
          EXPECT_LT(error, 0.004) << name;
          EXPECT_EQ(app::doubt(tip), "") << name;
        } else {
          EXPECT_GT(tip.spread, error) << name;
          EXPECT_NE(app::doubt(tip).find("not enriched"), std::string::npos) << name;
        }
      }
    }
}

TEST(CrackInPlate, on_triangles_is_warned_of_though_domains_agree) {
  // Linear triangles are as far off (−3.4%) and agree within 1%: the spacing over the length tells.
  const Solved solved = solve(input::read_case(
      paper_case,
      {"domain.cracks.main.points=[\"-0.5 0 mm\", \"0.5 0 mm\"]", "domain.cracks.main.rotate.angle=45 deg",
       "cloud.refine.tips.spacing=0.04 mm", "method.name=fe-triangles", "method.lagrangian=total"}));
  ASSERT_EQ(solved.tip.size(), 2U);
  for (const auto& [name, tip] : solved.tip) {
    EXPECT_LT(tip.spread, 0.01) << name;
    EXPECT_NE(app::doubt(tip).find("not enriched"), std::string::npos) << name;
  }
}

TEST(CrackInPlate, along_the_load_carries_nothing_and_is_not_doubted) {
  const input::Case input = input::read_case(paper_case, {"domain.cracks.main.rotate.angle=90 deg"});
  const app::StaticModel<2> model(input);
  const StaticSolution<2> solution = solve_statics(model.problem());
  for (std::size_t p = 0; p < model.cracks.enriched.position.size(); ++p)
    EXPECT_NEAR(solution.stress[1][p], 1e6, 1e6 * 1e-6) << model.cracks.enriched.position[p].transpose();
  for (const app::TipResult& tip : app::evaluate_tips(model, solution)) {
    EXPECT_LT(std::hypot(tip.intensity.K_I, tip.intensity.K_II), 3e-4 * unit(1e-4)) << tip.name;
    EXPECT_EQ(app::doubt(tip), "") << tip.name;
  }
}

TEST(CrackInPlate, error_is_below_0_3_percent_at_5000_nodes_with_enrichment) {
  const Solved solved =
      solve(input::read_case(paper_case, {"cloud.spacing=0.033 mm", "cloud.refine.tips.spacing=0.002 mm"}));
  for (const auto& [name, tip] : solved.tip)
    EXPECT_NEAR(tip.intensity.K_I, 1.01395 * unit(1e-4), 0.003 * unit(1e-4)) << name;
}

TEST(CrackInPlate, pressure_on_the_faces_equals_tension_of_the_plate) {
  // By superposition: the uncracked plate under uniform tension, cut open along the crack.
  const std::vector<std::string> pressed{"boundary.top.traction=0 0 MPa", "boundary.bottom.traction=0 0 MPa",
                                         "boundary.faces={ pieces = [\"main\"], pressure = \"1 MPa\" }"};
  const Solved tension = solve(input::read_case(paper_case)),
               pressure = solve(input::read_case(paper_case, pressed));
  for (const auto& [name, tip] : tension.tip)
    EXPECT_NEAR(pressure.tip.at(name).intensity.K_I, tip.intensity.K_I, 0.005 * unit(1e-4)) << name;
}

TEST(CrackInPlate, under_compression_is_reported_as_closed) {
  const Solved solved = solve(
      input::read_case(paper_case, {"boundary.top.traction=0 -1 MPa", "boundary.bottom.traction=0 1 MPa"}));
  ASSERT_EQ(solved.closed.size(), 1U);
  EXPECT_NE(solved.closed[0].find("crack 'main' closes"), std::string::npos);
}

TEST(CrackInPlate, open_to_the_boundary_agrees_with_the_handbook) {
  // Single edge crack under uniform tension, a/b = 0.4: F = 2.105 (Tada's fit 2.1117, 0.5%), h/b = 1.5.
  const double F = 1.12 - 0.231 * 0.4 + 10.55 * 0.16 - 21.72 * 0.064 + 30.39 * 0.0256;
  const Solved solved = solve(input::read_case_text(R"(
[analysis]
type = "static"
[domain]
material = "plate"
outer.rectangle = { from = "0 -1.5 mm", to = "1 1.5 mm" }
cracks.edge.points = ["0 0 mm", "0.4 0 mm"]
[cloud]
spacing = "0.06 mm"
refine.tips = { tips = ["all"], spacing = "0.01 mm", growth = 0.25 }
[materials.plate]
density = "7800 kg/m3"
elastic = { young = "210 GPa", poisson = 0.3 }
[boundary]
top = { pieces = ["top"], traction = "0 1 MPa" }
bottom = { pieces = ["bottom"], traction = "0 -1 MPa" }
corner = { points = ["1 -1.5 mm"], displacement = "0 0 mm" }
level = { points = ["1 1.5 mm"], displacement = { x = "0 mm" } }
)",
                                                    "edge.toml", {}));
  ASSERT_EQ(solved.tip.size(), 1U);
  const auto& [name, tip] = *solved.tip.begin();
  EXPECT_EQ(name, "right");
  EXPECT_NEAR(tip.intensity.K_I, F * unit(4e-4), 0.01 * F * unit(4e-4));
  EXPECT_NEAR(tip.intensity.K_II, 0.0, 0.005 * F * unit(4e-4));
}

TEST(CrackAcrossPlate, passes_no_stress_from_one_side_to_the_other) {
  // A crack from side to side leaves two parts; the upper one is pulled, the lower one feels nothing.
  const Solved solved = solve(input::read_case_text(R"(
[analysis]
type = "static"
[domain]
material = "plate"
outer.rectangle = { from = "-1 -1 mm", to = "1 1 mm" }
cracks.cut.points = ["-1 0 mm", "1 0 mm"]
[cloud]
spacing = "0.1 mm"
[materials.plate]
density = "7800 kg/m3"
elastic = { young = "210 GPa", poisson = 0.3 }
[boundary]
top = { pieces = ["top"], displacement = "0 0.01 mm" }
bottom = { pieces = ["bottom"], displacement = "0 0 mm" }
)",
                                                    "cut.toml", {}));
  EXPECT_TRUE(solved.tip.empty());
  EXPECT_LT(solved.strain_energy, 1e-18);
}

} // namespace
} // namespace cnem::testing
