// What a case allows and its writer hardly means: each doubt with its smallest case, and none of a sound one.
#include "app/plausibility/plausibility.hpp"

#include "input/case_reader.hpp"
#include "tests/solver_of.hpp"

#include <gtest/gtest.h>

namespace cnem::app {
namespace {

/// A sheet 2 mm thick between a punch and a die, clearance 0.1 mm.
const std::string sound_cut = R"toml(
[time]
end = "20 us"
[domain]
material = "steel"
outer.rectangle = { from = "0 0 mm", to = "8 2 mm" }
[cloud]
spacing = "0.2 mm"
[materials.steel]
density = "7850 kg/m3"
elastic = { young = "207 GPa", poisson = 0.3 }
plastic = { law = "perfect", yield = "400 MPa" }
damage = { law = "johnson-cook", D1 = 0.05, D2 = 3.44, D3 = -2.12, fracture_energy = "100 kJ/m2" }
[tools.punch]
rectangle = { from = "-2 2 mm", to = "3.9 6 mm" }
velocity = "0 -10 m/s"
[tools.die]
start = "4 -4 mm"
path = [{ to = "10 -4 mm" }, { to = "10 0 mm" }, { to = "4 0 mm" }]
[output]
pictures = "10 us"
[report.blanking]
punch = "punch"
)toml";

using Texts = std::vector<std::string>;

Texts doubts_with(const Texts& overrides) {
  const input::Case input = input::read_case_text(sound_cut, "case.toml", overrides);
  return doubts(input, testing::solver_of(input));
}
std::string only_doubt(const Texts& overrides) {
  const Texts list = doubts_with(overrides);
  EXPECT_EQ(list.size(), 1U) << (list.empty() ? "none" : list.back());
  return list.empty() ? "" : list.front();
}
void expect_doubt(const Texts& overrides, const std::string& part) {
  SCOPED_TRACE(overrides.front());
  EXPECT_NE(only_doubt(overrides).find(part), std::string::npos) << only_doubt(overrides);
}

TEST(Plausibility, a_sound_case_has_no_doubts) { EXPECT_EQ(doubts_with({}), Texts{}); }

TEST(Plausibility, supports_that_prescribe_different_motions) {
  const Texts held{"boundary.low.pieces=[\"bottom\"]", "boundary.low.velocity.x=0 m/s",
                   "boundary.side.pieces=[\"right\"]"};
  const auto with = [&](const std::string& speed) {
    Texts overrides = held;
    overrides.push_back("boundary.side.velocity.x=" + speed);
    return doubts_with(overrides);
  };
  EXPECT_EQ(with("0 m/s"), Texts{});
  const Texts list = with("1 m/s");
  ASSERT_EQ(list.size(), 1U);
  EXPECT_NE(list.front().find("key 'boundary.side': prescribes another motion along (1, 0) than boundary.low "
                              "of a node that both hold, such as the one at (0.008, 0) m"),
            std::string::npos)
      << list.front();
}

TEST(Plausibility, constants_a_power_of_ten_off) {
  expect_doubt(
      {"materials.steel.elastic.young=207 MPa", "materials.steel.plastic.yield=1 MPa",
       "materials.steel.damage.fracture_energy=0.5 kJ/m2"},
      "key 'materials.steel.elastic.young': 2.07e+08 Pa at 7850 kg/m³, where metals have 10 to 600 GPa: is "
      "2.07e+11 Pa meant?");
  expect_doubt({"materials.steel.density=7.85 kg/m3"}, "is 7850 kg/m³ meant?");
  expect_doubt({"materials.steel.plastic.yield=400 Pa", "materials.steel.damage.fracture_energy=0.1 J/m2"},
               "it begins to flow at 400 Pa");
  const std::string brittle = "materials.steel.damage.fracture_energy=100 J/m2";
  expect_doubt({"materials.steel.plastic.yield=400 kPa", brittle},
               "it begins to flow at 4e+05 Pa, 1.9e-06 of Young's modulus, where metals have 0.0001 to 0.02: "
               "is 4e+08 Pa meant?");
  EXPECT_EQ(
      doubts_with({"materials.steel.plastic.yield=400 kPa", "materials.steel.elastic.young=11 GPa", brittle}),
      Texts{})
      << "a model";
  expect_doubt({"materials.steel.plastic.yield=40 GPa", "materials.steel.damage.fracture_energy=10 MJ/m2",
                "materials.steel.elastic.young=900 GPa"},
               "is 4e+07 Pa meant?");
  expect_doubt({"materials.steel.elastic.young=3 GPa"}, "an elastic strain of 13%");
}

TEST(Plausibility, constants_of_heat) {
  const Texts heat{"analysis.thermal=true", "materials.steel.heat.specific_heat=460 J/(kg K)",
                   "materials.steel.heat.conductivity=50 W/(m K)"};
  const auto with = [&](const std::string& more) {
    Texts list{more};
    list.insert(list.end(), heat.begin(), heat.end());
    return list;
  };
  EXPECT_EQ(doubts_with(heat), Texts{});
  expect_doubt(with("materials.steel.heat.expansion=12 1/K"), "is 1.2e-05 1/K meant?");
  for (const auto& [key, text] : std::initializer_list<std::pair<std::string, std::string>>{
           {"initial.temperature", "initial.temperature=20 K"},
           {"tools.die.heat.temperature", "tools.die.heat.temperature=20 K"},
           {"boundary.rim.temperature",
            "boundary.rim={pieces=\"left\", temperature={times=\"0 10 us\", values=\"293 20 K\"}}"},
           {"boundary.rim.convection.ambient", "boundary.rim={pieces=\"left\", "
                                               "convection={coefficient=\"10 W/(m2 K)\", ambient=\"20 K\"}}"},
           {"coolants.spray.temperature",
            "coolants.spray={coefficient=\"50 kW/(m2 K)\", temperature=\"20 K\"}"}})
    expect_doubt(with(text), "key '" + key + "': 20 K are -253.15 °C: are 20 degC meant?");
  EXPECT_EQ(doubts_with(with("coolants.spray={coefficient=\"50 kW/(m2 K)\", temperature=\"77 K\"}")), Texts{})
      << "nitrogen";
  Texts wrong = heat;
  wrong[1] = "materials.steel.heat.specific_heat=0.46 J/(kg K)";
  expect_doubt(wrong, "is 460 J/(kg K) meant?");
  const auto carbide = [&](const std::string& density, const std::string& conductivity,
                           const std::string& specific_heat) {
    return with("tools.die.heat={density=\"" + density + "\", conductivity=\"" + conductivity +
                "\", specific_heat=\"" + specific_heat + "\"}");
  };
  EXPECT_EQ(doubts_with(carbide("14500 kg/m3", "80 W/(m K)", "220 J/(kg K)")), Texts{});
  expect_doubt(carbide("14.5 kg/m3", "80 W/(m K)", "220 J/(kg K)"),
               "key 'tools.die.heat.density': 14.5 kg/m³, where tools have 2e+03 to 2e+04 kg/m³: is 1.45e+04 "
               "kg/m³ meant?");
  expect_doubt(carbide("14500 kg/m3", "80 kW/(m K)", "220 J/(kg K)"), "is 80 W/(m K) meant?");
  expect_doubt(carbide("14500 kg/m3", "80 W/(m K)", "2200 J/(kg K)"), "2200 J/(kg K), where tools have");
}

TEST(Plausibility, damage_that_tension_delays_and_cells_too_wide_for_it) {
  expect_doubt({"materials.steel.damage.D3=2.12"},
               "key 'materials.steel.damage.D3': D2 = 3.44 and D3 = 2.12 make");
  expect_doubt({"materials.steel.damage.fracture_energy=10 kJ/m2"},
               "opened by 2 G_f/σ_y = 0.05 mm when nothing holds it, which is less than the finest spacing");
}

TEST(Plausibility, damage_that_breaks_nothing_or_all) {
  expect_doubt(
      {"materials.steel.damage.fracture_energy=60 MJ/m2"},
      "opens by 2 G_f/σ_y = 300 mm before nothing holds it, which is more than the workpiece is wide");
  expect_doubt({"materials.steel.damage.D1=40"}, "in uniaxial tension it breaks at a strain of 41.7");
  const auto cockcroft_latham = [](const std::string& work) {
    return "materials.steel.damage={law=\"cockcroft-latham\", critical_work=\"" + work +
           "\", fracture_energy=\"100 kJ/m2\"}";
  };
  expect_doubt({cockcroft_latham("300 GPa")}, "it breaks at a strain of 750");
  EXPECT_EQ(doubts_with({cockcroft_latham("300 MPa")}), Texts{});
  expect_doubt({"materials.steel.damage.length=0.2 m"},
               "averaged over 200 mm, more than the workpiece is wide");
  expect_doubt({"materials.steel.damage.length=0.02 mm"}, "expected 1.5 at least");
  EXPECT_EQ(doubts_with({"materials.steel.damage.length=0.4 mm"}), Texts{});
}

TEST(Plausibility, hardening_that_no_metal_has) {
  const auto johnson_cook = [](const std::string& constants) {
    return "materials.steel.plastic={ law = \"johnson-cook\", A = \"400 MPa\", B = \"500 MPa\", " +
           constants + " }";
  };
  EXPECT_EQ(doubts_with({johnson_cook("n = 0.3, C = 0.1")}), Texts{});
  EXPECT_EQ(doubts_with({johnson_cook("n = 0.3"), "materials.steel.plastic.A=200 kPa"}), Texts{});
  expect_doubt({"materials.steel.plastic={law=\"linear\", yield=\"400 MPa\", hardening=\"1000 GPa\"}"},
               "at a strain of 1 it flows at 1e+12 Pa, 4.8 of Young's modulus");
  const auto table = [](const std::string& strain) {
    return "materials.steel.plastic={law=\"table\", stress=\"300 420 510 640 MPa\", strain=" + strain + "}";
  };
  EXPECT_EQ(doubts_with({table("[0, 0.02, 0.1, 0.5]")}), Texts{});
  expect_doubt({table("[0, 2, 10, 50]")}, "strains of up to 50, where curves are measured up to 5 at most");
  expect_doubt({johnson_cook("n = 3.0")}, "key 'materials.steel.plastic': it hardens 1e+02 times as fast");
  expect_doubt({johnson_cook("n = 0.3, C = 0.97")}, "makes the flow stress 9.9 times that at 1 /s");
  const std::string softening = "n = 0.3, m = 1.0, T0 = \"293 K\", Tmelt = ";
  EXPECT_EQ(doubts_with({johnson_cook(softening + "\"1800 K\"")}), Texts{});
  expect_doubt({johnson_cook(softening + "\"298 K\"")}, "it melts at 298 K, 24.85 °C");
  expect_doubt({johnson_cook("n = 0.3, m = 1.0, T0 = \"20 K\", Tmelt = \"1800 K\"")}, "is T0 in degC meant?");
  expect_doubt({johnson_cook(softening + "\"900 K\""), "initial.temperature=1000 K",
                "materials.steel.damage.fracture_energy=1 MJ/m2"},
               "it begins at 1000 K, melted");
}

TEST(Plausibility, friction_that_no_tool_has) {
  expect_doubt({"tools.punch.friction={ law = \"coulomb\", coefficient = 10.0 }"},
               "key 'tools.punch.friction': a coefficient of 10, where metals on tools have 0.02 to 0.8: is "
               "0.1 meant?");
  EXPECT_EQ(doubts_with({"tools.punch.friction={ law = \"coulomb\", coefficient = 0.4 }"}), Texts{});
}

TEST(Plausibility, strokes_of_nothing_and_of_metres) {
  expect_doubt({"tools.punch.velocity=0 -10 mm/s"},
               "punch goes 0.0002 mm by time.end, 0.01% of the thickness: nothing is cut");
  expect_doubt({"time.end=20 ms"}, "punch goes 0.2 m by time.end, 24 times the size of the workpiece");
  const Texts below_a_press{"tools.punch.mass=1 kg/m", "tools.punch.direction=0 -1",
                            "tools.punch.spring={law=\"linear\", stiffness=\"1 GN/m2\"}"};
  expect_doubt(
      {"tools.punch={rectangle={from=\"-2 2 mm\", to=\"3.9 6 mm\"}, mass=\"1 kg/m\", direction=\"0 1\", "
       "initial_velocity=\"0 10 m/s\"}",
       "report.blanking.die=[\"die\"]"},
      "key 'tools.punch.initial_velocity': punch moves away");
  for (const auto& [change, part] : std::initializer_list<std::pair<std::string, std::string>>{
           {"time.end=20 ms", "key 'tools.punch.velocity': punch goes 0.2 m by time.end"},
           {"tools.punch.velocity=0 -10 mm/s", "key 'tools.punch.velocity': punch goes 0.0002 mm"}}) {
    Texts all = below_a_press;
    all.push_back(change);
    expect_doubt(all, part);
  }
}

TEST(Plausibility, sheets_of_two_cells_and_gaps_as_wide_as_they_are) {
  expect_doubt({"cloud.spacing=1 mm", "materials.steel.damage.fracture_energy=300 kJ/m2"},
               "key 'cloud.spacing': 2 cells over the thickness of 2 mm");
  expect_doubt({"tools.punch.rectangle={from=\"-2 2 mm\", to=\"2 6 mm\"}"},
               "clearance of 100% of the thickness");
  const std::string fine_at = "cloud={spacing=\"1 mm\", refine.cut={box=[\"";
  const std::string tough = "materials.steel.damage.fracture_energy=300 kJ/m2";
  EXPECT_EQ(doubts_with({fine_at + "3.4 0 mm\", \"4.6 2 mm\"], spacing=\"0.1 mm\"}}", tough}), Texts{});
  expect_doubt({fine_at + "0 0 mm\", \"1 2 mm\"], spacing=\"0.1 mm\"}}", tough},
               "cells over the thickness of 2 mm");
}

const std::string sound_chip = R"toml(
[cutting]
feed = "0.4 mm"
width = "4 mm"
rake = "10 deg"
clearance = "7 deg"
edge_radius = "40 um"
speed = "500 m/min"
length = "2 mm"
[domain]
material = "steel"
[materials.steel]
density = "7850 kg/m3"
elastic = { young = "207 GPa", poisson = 0.3 }
plastic = { law = "perfect", yield = "400 MPa" }
)toml";

TEST(Plausibility, cuts_that_no_lathe_makes) {
  const auto doubts_of = [](const Texts& overrides) {
    return doubts(input::read_case_text(sound_chip, "case.toml", overrides));
  };
  EXPECT_EQ(doubts_of({}), Texts{});
  for (const auto& [key, part] : std::initializer_list<std::pair<std::string, std::string>>{
           {"cutting.speed=800 m/s", "800 m/s are 48000 m/min"},
           {"cutting.feed=0.4 m", "400 mm of uncut chip thickness"},
           {"cutting.clearance=0 deg", "the flank rubs"},
           {"cutting.edge_radius=1 mm", "2.5 times the feed"},
           {"cutting.length=0.6 mm", "1.5 feeds of cut"}}) {
    const Texts list = doubts_of({key});
    ASSERT_FALSE(list.empty()) << key;
    EXPECT_NE(list.front().find(part), std::string::npos) << list.front();
  }
}

TEST(Plausibility, pictures_after_the_end) {
  expect_doubt({"output.pictures=10 20 us", "time.end=15 us"},
               "a picture is asked for at 2e-05 s, but the run ends");
  expect_doubt({"output.pictures=10 20 30 us", "time.end=15 us"},
               "2 pictures are asked for, the last at 3e-05 s");
  expect_doubt({"output.fields_every=30 us"}, "key 'output.fields_every'");
  expect_doubt({"output.fields_every=1 ns"}, "20000 files of fields by time.end");
  EXPECT_EQ(doubts_with({"output.fields_every=20 ns"}), Texts{});
}

TEST(Plausibility, punches_that_move_away_or_come_late) {
  expect_doubt({"tools.punch.velocity=0 10 m/s", "report.blanking.die=[\"die\"]"},
               "punch moves away from the workpiece, along (0, 1), and does not come back");
  const std::string lifted = "tools.punch.rectangle={from=\"-2 2.5 mm\", to=\"3.9 6 mm\"}";
  expect_doubt({lifted}, "punch starts 0.5 mm clear of the workpiece and does not meet it by time.end");
  expect_doubt({lifted, "time.end=100 us"}, "punch starts 0.5 mm clear of the workpiece and meets it after");
  expect_doubt({lifted, "tools.punch.velocity=0 10 m/s"},
               "clear of the workpiece and comes no nearer, along (0, 1)");
  EXPECT_EQ(doubts_with({lifted, "time.end=1 ms"}), Texts{}) << "early enough";
  expect_doubt({lifted, "tools.punch.velocity=10 0 m/s"}, "comes no nearer, along (1, 0)");
  EXPECT_EQ(doubts_with({"tools.punch.velocity=0 1 m/s", "report.blanking.die=[\"die\"]",
                         "boundary.push.pieces=bottom", "boundary.push.velocity={ y = \"10 m/s\" }"}),
            Texts{})
      << "the workpiece goes after it";
  EXPECT_EQ(doubts_with({"tools.punch.velocity={ times = \"0 5 10 us\", values = [\"0 0 m/s\", \"0 -10 "
                         "m/s\", \"0 20 m/s\"] }"}),
            Texts{})
      << "goes back after it has pressed";
}

TEST(Plausibility, punches_that_stand_or_slide) {
  expect_doubt({"tools.punch.velocity=-10 0 m/s"}, "punch slides along the sheet, along (-1, 0)");
  expect_doubt({"tools.punch.velocity=0 0 m/s"}, "punch stands still, and so does the die: nothing is cut");
  EXPECT_EQ(doubts_with({"tools.punch.velocity=0 0 m/s", "tools.die.velocity=0 10 m/s"}), Texts{});
}

TEST(Plausibility, holders_that_are_pushed_away_late_or_not_at_all) {
  const auto holder = [](const std::string& push) {
    return "tools.holder={rectangle={from=\"5 2 mm\", to=\"9 4 mm\"}, mass=\"1 kg/m\"" + push + "}";
  };
  const auto sprung = [&](const std::string& direction, const std::string& preload,
                          const std::string& ramp = "2 us") {
    return holder(", direction=\"" + direction + "\", spring={law=\"gas\", length=\"20 mm\", preload=\"" +
                  preload + "\", ramp=\"" + ramp + "\"}");
  };
  EXPECT_EQ(doubts_with({sprung("0 -1", "300 kN/m")}), Texts{});
  EXPECT_EQ(doubts_with({holder(", force=\"0 -300 kN/m\"")}), Texts{});
  expect_doubt(
      {sprung("0 1", "300 kN/m")},
      "key 'tools.holder.direction': holder is pushed along (0, 1), away from the workpiece or past it: "
      "is (0, -1) meant?");
  expect_doubt({sprung("1 0", "300 kN/m")},
               "along (1, 0), away from the workpiece or past it, expected the side");
  expect_doubt({holder(", force=\"0 300 kN/m\"")}, "key 'tools.holder.force': holder is pushed along (0, 1)");
  expect_doubt({holder("")}, "key 'tools.holder.mass': holder has a mass and nothing that moves it");
  expect_doubt({sprung("0 -1", "300 MN/m")}, "key 'tools.holder.spring': 3e+08 N/m are 3.64e+10 Pa");
  expect_doubt({sprung("0 -1", "300 kN/m", "2 ms")},
               "key 'tools.holder.spring.ramp': it takes 0.002 s to come to its full force");
  expect_doubt({holder(", force={y={value=\"-300 kN/m\", ramp=\"2 ms\"}}")},
               "key 'tools.holder.force': it takes 0.002 s");
}

TEST(Plausibility, clearance_of_nothing_or_less) {
  const auto punch_to = [](const std::string& x) {
    return "tools.punch.rectangle={from=\"-2 2 mm\", to=\"" + x + " 6 mm\"}";
  };
  expect_doubt({punch_to("4.1")}, "punch and the die overlap by 0.1 mm across the cut");
  expect_doubt({punch_to("4")}, "no clearance between punch and the die");
}

TEST(Plausibility, arcs_that_no_node_feels) {
  expect_doubt({"tools.die.path[2].fillet=0.1 mm"},
               "key 'tools.die': its arc of 0.1 mm is 0.5 spacings of the nodes");
  EXPECT_EQ(doubts_with({"tools.die.path[2].fillet=0.4 mm"}), Texts{});
  EXPECT_EQ(
      doubts_with({"tools.die.path[2].fillet=0.1 mm", "adapt.resample=true", "adapt.tool_spacing=0.05 mm"}),
      Texts{});
}

TEST(Plausibility, arcs_of_cutters_are_felt_unless_cells_there_are_made_wider) {
  const auto doubts_of = [](const Texts& overrides) {
    const input::Case input = input::read_case_text(sound_chip, "case.toml", overrides);
    return doubts(input, testing::solver_of(input));
  };
  EXPECT_EQ(doubts_of({"cutting.edge_radius=10 um"}), Texts{});
  EXPECT_EQ(
      doubts_of({"cloud.spacing=0.1 mm", "cloud.refine.layer.spacing=0.1 mm", "adapt.tool_spacing=0.1 mm",
                 "adapt.surface_spacing=0.1 mm", "adapt.rest_factor=0", "adapt.indicator.field=none"}),
      Texts{})
      << "uniform";
  const Texts list = doubts_of({"cutting.edge_radius=10 um", "adapt.tool_spacing=0.1 mm"});
  ASSERT_EQ(list.size(), 1U);
  EXPECT_NE(list.front().find("its arc of 0.01 mm is 0.5 spacings"), std::string::npos) << list.front();
}

TEST(Plausibility, what_the_case_does_not_use_is_not_doubted) {
  EXPECT_EQ(doubts_with({"materials.spare.density=7.85 kg/m3", "materials.spare.elastic.young=207 MPa",
                         "materials.spare.elastic.poisson=0.3"}),
            Texts{});
  EXPECT_EQ(doubts_with(
                {"tools.die.path[2].fillet=0.1 mm", "adapt.resample=true", "adapt.surface_spacing=0.05 mm"}),
            Texts{})
      << "finer cells by another key";
}

TEST(Plausibility, floors_of_dies_are_no_edges) {
  EXPECT_EQ(
      doubts_with(
          {"tools.die.path=[{to=\"-1 -4 mm\"}, {to=\"-1 -4.5 mm\"}, {to=\"10 -4.5 mm\"}, {to=\"10 0 mm\"}, "
           "{to=\"4 0 mm\"}]"}),
      Texts{});
}

TEST(Plausibility, parts_that_pass_through_each_other) {
  const Texts halves{"domain.cracks.slit.points=[\"6 0 mm\", \"6 2 mm\"]"};
  expect_doubt(halves, "key 'contact.deformable': the workpiece has 2 parts that pass through each other");
  Texts kept = halves;
  kept.emplace_back("contact.deformable=true");
  EXPECT_EQ(doubts_with(kept), Texts{});
}

TEST(Plausibility, measures_of_a_cut) {
  const input::Case input =
      input::read_case_text(sound_cut, "case.toml", {"tools.die.path[2].fillet=0.4 mm"});
  const auto lines = tool_measures(input, testing::solver_of(input));
  const std::vector<std::pair<std::string, std::string>> expected{
      {"clearance", "0.1 mm, 5% of 2 mm"},
      {"gap", "punch 0 mm"},
      {"gap", "die 0 mm"},
      {"edge", "die radius 0.4 mm, 2.0 spacings"}};
  EXPECT_EQ(lines, expected);
}

} // namespace
} // namespace cnem::app
