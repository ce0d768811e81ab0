#include "plasticity/hardening_laws.hpp"
#include "tests/unit/input/case_text.hpp"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

namespace cnem::input {
namespace {

const std::string full_case = R"toml(
title = "Everything"
[analysis]
type = "explicit"
kinematics = "plane strain"
thermal = true
[time]
end = "10 us"
step = { safety = 0.8, max = "5 ns", check_every = 20 }
[domain]
material = "soft"
[domain.outer]
start = "0 0 mm"
close = "left"
path = [
  { to = "20 0 mm", name = "bottom" },
  { to = "20 10 mm", name = "side", fillet = "1 mm", fillet_name = "corner" },
  { to = "0 10 mm", name = "top" },
]
[domain.holes.round]
circle = { centre = "5 5 mm", radius = "1 mm" }
[domain.holes.slot]
rectangle = { from = ["9 mm", "4 mm"], to = ["11 mm", "6 mm"], names = { top = "roof" } }
[domain.cracks.slit]
points = ["14 5 mm", "16 5 mm", "17 6 mm"]
[cloud]
spacing = "0.5 mm"
pattern = "jittered"
jitter = 0.1
seed = 7
[cloud.refine.near]
box = ["14 6 mm", "12 4 mm"]
factor = 0.5
[cloud.refine.tip]
points = ["17 6 mm"]
spacing = "0.1 mm"
growth = 0.2
[materials.soft]
density = "2.7 g/cm3"
elastic = { young = "70 GPa", poisson = 0.33 }
plastic = { law = "linear", yield = "100 MPa", hardening = "50 MPa" }
heat = { specific_heat = "900 J/(kg K)", conductivity = "200 W/(m K)", expansion = "23e-6 1/K" }
[materials.jc]
density = "7850 kg/m3"
elastic = { young = "210 GPa", poisson = 0.3 }
plastic = { law = "johnson-cook", A = "253 MPa", B = "685 MPa", n = 0.312, m = 2.044, T0 = "296 K", Tmelt = "1698 K" }
[boundary.bed]
pieces = "bottom"
velocity = { y = "0 m/s" }
[boundary.push]
pieces = ["top"]
traction = { y = { times = "0 1 2 us", values = ["0 MPa", "-10 MPa", "0 MPa"] } }
temperature = { value = "400 K", ramp = "1 us", from = "300 K" }
[boundary.inner]
pieces = ["round", "slot", "roof"]
pressure = "1 bar"
convection = { coefficient = "100 W/(m2 K)", ambient = "20 degC" }
[boundary.symmetry]
pieces = "left"
symmetry = true
heat_flux = { value = "1 kW/m2", ramp = "1 us" }
[initial]
temperature = "300 K"
velocity = "1 2 m/s"
spin = { rate = "600 rpm", centre = "10 5 mm" }
[loads]
body_force = "0 -9.81 m/s2"
[tools.punch]
rectangle = { from = "0 10 mm", to = "5 12 mm", fillet = "0.5 mm" }
rotate = { angle = "90 deg", centre = "0 10 mm" }
velocity = { value = "0 -11 m/s", ramp = "2 us" }
friction = { law = "tresca-limited", coefficient = 0.2, shear_factor = 0.8 }
heat = { conductance = "1e4 W/(m2 K)", conductivity = "100 W/(m K)", density = "8000 kg/m3", specific_heat = "450 J/(kg K)" }
[method]
name = "fe-triangles"
functions = "laplace"
gauss_points = 2
stabilisation = 0.1
lagrangian = "total"
rereference = { every = 50, strain = 0.1 }
bulk_viscosity = { linear = 0.1, quadratic = 2 }
energy_tolerance = 0.01
[output]
history_every = "10 ns"
fields_every = "1 us"
pictures = "4 2 4 us"
picture_fields = ["temperature"]
notes.two = { at = "2 us", text = "hot" }
[output.windows.zoom]
box = ["10 0 mm", "0 5 mm"]
[output.probes.a]
at = "1 1 mm"
fields = ["temperature", "velocity_x"]
)toml";

TEST(CaseReader, SmallCaseHasTheDefaults) {
  const Case c = read_small();
  EXPECT_EQ(c.path, "case.toml");
  EXPECT_FALSE(c.analysis.thermal);
  EXPECT_EQ(c.time.end, 20e-6);
  EXPECT_EQ(c.time.safety, 0.9);
  EXPECT_EQ(c.time.check_every, 10);
  EXPECT_FALSE(c.time.max_step || c.time.fixed);
  EXPECT_EQ(c.domain.material, "steel");
  EXPECT_EQ(c.domain.piece_names(), (std::vector<std::string>{"bottom", "right", "top", "left"}));
  EXPECT_DOUBLE_EQ(c.domain.outer.area(), 50e-6);
  EXPECT_EQ(c.cloud.pattern, clouds::Pattern::hexagonal);
  EXPECT_EQ(c.cloud.spacing, 0.25e-3);
  EXPECT_EQ(c.material("steel").elasticity.poisson, 0.3);
  EXPECT_FALSE(c.material("steel").hardening);
  EXPECT_EQ(c.material("steel").specific_heat, 0.0);
  EXPECT_EQ(c.initial.temperature, 293.15);
  EXPECT_EQ(c.method.name, "cnem");
  EXPECT_EQ(c.method.lagrangian, Method::Lagrangian::periodic);
  EXPECT_EQ(c.method.rereference_strain, 0.25);
  EXPECT_EQ(c.output.history_every, 20e-6 / 400.0);
  EXPECT_EQ(c.output.pictures, std::vector{20e-6});
  EXPECT_TRUE(c.tools.empty() && c.boundary.empty());
}

TEST(CaseReader, FullCaseInSI) {
  const Case c = read_case_text(full_case, "study/case.toml");
  EXPECT_EQ(c.name, "study");
  EXPECT_EQ(c.title, "Everything");
  EXPECT_TRUE(c.analysis.thermal);
  EXPECT_EQ(c.time.safety, 0.8);
  EXPECT_EQ(c.time.max_step, 5e-9);
  EXPECT_EQ(c.time.check_every, 20);
  EXPECT_EQ(c.domain.piece_names(), (std::vector<std::string>{"bottom", "side", "corner", "top", "left",
                                                              "round", "slot", "roof", "slit+", "slit-"}));
  EXPECT_GT(c.domain.outer.area(), 0.0);
  ASSERT_EQ(c.domain.holes.size(), 2U);
  EXPECT_NEAR(c.domain.holes[0].outline.area(), -std::numbers::pi * 1e-6, 1e-18);
  EXPECT_NEAR(c.domain.holes[1].outline.area(), -4e-6, 1e-18);
  ASSERT_EQ(c.domain.cracks.size(), 1U);
  EXPECT_EQ(c.domain.cracks[0].path[2], Vec2(0.017, 0.006));

  EXPECT_EQ(c.cloud.pattern, clouds::Pattern::jittered);
  EXPECT_EQ(c.cloud.jitter, 0.1);
  EXPECT_EQ(c.cloud.seed, 7U);
  ASSERT_EQ(c.cloud.refinements.size(), 2U);
  EXPECT_EQ(c.cloud.refinements[0].points[0], Vec2(0.012, 0.004));
  EXPECT_EQ(c.cloud.refinements[0].points[1], Vec2(0.014, 0.006));
  EXPECT_EQ(c.cloud.refinements[0].spacing, 0.25e-3);
  EXPECT_EQ(c.cloud.refinements[1].growth, 0.2);

  ASSERT_EQ(c.materials.size(), 2U);
  EXPECT_EQ(c.materials[0].name, "soft");
  EXPECT_EQ(c.materials[0].density, 2700.0);
  EXPECT_EQ(c.materials[0].hardening->as<plasticity::Linear>().hardening, 50e6);
  EXPECT_EQ(c.materials[0].expansion, 23e-6);
  EXPECT_EQ(c.materials[0].taylor_quinney, 0.9);
  EXPECT_EQ(c.materials[0].expansion_reference, 300.0);
  const auto& jc = c.materials[1].hardening->as<plasticity::JohnsonCook>();
  EXPECT_EQ(jc.A, 253e6);
  EXPECT_EQ(jc.C, 0.0);
  EXPECT_EQ(jc.rate0, 1.0);
  EXPECT_EQ(jc.Tmelt, 1698.0);

  ASSERT_EQ(c.boundary.size(), 4U);
  EXPECT_FALSE(c.boundary[0].velocity[0]);
  EXPECT_EQ((*c.boundary[0].velocity[1])(1.0), 0.0);
  EXPECT_DOUBLE_EQ((*c.boundary[1].traction[1])(0.5e-6), -5e6);
  EXPECT_DOUBLE_EQ((*c.boundary[1].temperature)(0.5e-6), 350.0);
  EXPECT_EQ((*c.boundary[2].pressure)(0.0), 1e5);
  EXPECT_DOUBLE_EQ(c.boundary[2].convection->ambient(0.0), 293.15);
  EXPECT_TRUE(c.boundary[3].symmetry);
  EXPECT_DOUBLE_EQ((*c.boundary[3].heat_flux)(2e-6), 1000.0);

  EXPECT_EQ(c.initial.velocity, Vec3(1, 2, 0));
  EXPECT_DOUBLE_EQ(c.initial.spin->rate, 20.0 * std::numbers::pi);
  EXPECT_EQ((*c.loads.body_force[1])(0.0), -9.81);

  ASSERT_EQ(c.tools.size(), 1U);
  const Tool& punch = c.tools[0];
  EXPECT_NEAR(punch.outline.area(), 10e-6 - (4.0 - std::numbers::pi) * 0.25e-6, 1e-17);
  for (const CurvePiece& piece : punch.outline.pieces) { // turned about its corner into x < 0
    EXPECT_LE(piece.from.x(), 1e-12);
    EXPECT_GE(piece.from.x(), -0.002 - 1e-12);
  }
  EXPECT_DOUBLE_EQ(punch.velocity[1].value()(1e-6), -5.5);
  EXPECT_EQ(punch.friction.as<contact::TrescaLimited>().coefficient, 0.2);
  EXPECT_EQ(punch.friction.as<contact::TrescaLimited>().shear_factor, 0.8);
  EXPECT_EQ(punch.thermal.temperature, 300.0);
  EXPECT_DOUBLE_EQ(punch.thermal.effusivity, std::sqrt(100.0 * 8000.0 * 450.0));

  EXPECT_EQ(c.method.name, "fe-triangles");
  EXPECT_EQ(c.method.options.functions, scni::Functions::laplace);
  EXPECT_EQ(c.method.options.gauss_points, 2);
  EXPECT_EQ(c.method.lagrangian, Method::Lagrangian::total);
  EXPECT_EQ(c.method.rereference_every, 50);
  EXPECT_EQ(c.method.viscosity_quadratic, 2.0);
  EXPECT_EQ(c.method.energy_tolerance, 0.01);
  EXPECT_EQ(c.output.pictures, (std::vector{2e-6, 4e-6}));
  EXPECT_EQ(c.output.windows[0].upper, Vec2(0.01, 0.005));
  ASSERT_EQ(c.output.notes.size(), 1U);
  EXPECT_EQ(c.output.notes[0].field, "temperature");
  EXPECT_EQ(c.output.notes[0].text, "hot");
  EXPECT_EQ(c.output.probes[0].fields, (std::vector<std::string>{"temperature", "velocity_x"}));
}

TEST(CaseReader, ResolvedCaseReadsBackToTheSameCase) {
  const auto body = [](const std::string& text) { return text.substr(text.find('\n')); };
  for (const std::string& text : {small_case, full_case, "analysis.type = \"static\"\n" + small_case}) {
    const Case first = read_case_text(text, "case.toml");
    const Case second = read_case_text(first.resolved, "case.resolved.toml");
    EXPECT_EQ(body(first.resolved), body(second.resolved));
    ASSERT_EQ(first.domain.outer.pieces.size(), second.domain.outer.pieces.size());
    for (std::size_t i = 0; i < first.domain.outer.pieces.size(); ++i)
      EXPECT_EQ(first.domain.outer.pieces[i].from, second.domain.outer.pieces[i].from);
    ASSERT_EQ(first.boundary.size(), second.boundary.size());
    for (std::size_t i = 0; i < first.boundary.size(); ++i) {
      EXPECT_EQ(first.boundary[i].name, second.boundary[i].name);
      EXPECT_EQ(first.boundary[i].pieces, second.boundary[i].pieces);
    }
    EXPECT_EQ(first.tools.size(), second.tools.size());
    EXPECT_EQ(first.time.end, second.time.end);
    EXPECT_EQ(first.output.history_every, second.output.history_every);
  }
}

TEST(CaseReader, ResolvedCaseSpellsOutDefaultsInSI) {
  expect_parts(read_small().resolved,
               {"end = \"2e-05 s\"", "safety = 0.9", "young = \"210000000000 Pa\"", "thermal = false",
                "[method.rereference]", "fields_every = \"8.333333333333334e-07 s\"",
                "temperature = \"293.15 K\""});
}

TEST(CaseReader, ResolvedTextKeepsOddCharacters) {
  const Case c = read_small("", {"title='a \"quote\", a back\\slash'"});
  EXPECT_EQ(c.title, "a \"quote\", a back\\slash");
  EXPECT_EQ(read_case_text(c.resolved, "again.toml").title, c.title);
}

TEST(CaseReader, OverridesReplaceAddAndAddressElements) {
  EXPECT_EQ(read_small("", {"time.end=3 us"}).time.end, 3e-6);
  EXPECT_EQ(read_small("", {"time.end=\"3 us\""}).time.end, 3e-6);
  EXPECT_EQ(read_small("", {"time.step.safety=0.5"}).time.safety, 0.5);
  EXPECT_EQ(read_small("", {"time.end=3 us", "time.end=4 us"}).time.end, 4e-6);
  EXPECT_EQ(read_small("", {"materials.steel.plastic={ law = \"perfect\", yield = \"1 MPa\" }"})
                .material("steel")
                .hardening->as<plasticity::Perfect>()
                .yield,
            1e6);
  const Case c = read_case_text(full_case, "case.toml",
                                {"domain.outer.path[1].fillet=2 mm", "tools.punch.velocity=0 -50 m/s",
                                 "boundary.bed.pieces=[\"bottom\", \"side\"]"});
  EXPECT_EQ(c.tools[0].velocity[1].value()(0.0), -50.0);
  EXPECT_EQ(c.boundary[0].pieces.size(), 2U);
  for (const CurvePiece& piece : c.domain.outer.pieces) EXPECT_TRUE(!piece.is_arc() || piece.radius == 0.002);
}

TEST(CaseReader, BadOverridesAreNamed) {
  expect_parts(refusal("", {"time.end"}), {"--set time.end: expected key=value"});
  expect_parts(refusal("", {"=3"}), {"--set =3: expected key=value"});
  expect_parts(refusal("", {"a..b=3"}), {"--set a..b=3: expected key=value"});
  expect_parts(refusal("", {"time.end=3 kg"}),
               {"--set time.end=3 kg: key 'time.end': found '3 kg', which is a mass, expected a time"});
  expect_parts(refusal("", {"time.ende=3 us"}),
               {"--set time.ende=3 us: key 'time.ende': unknown key", "did you mean 'time.end'?"});
  expect_parts(refusal("", {"time.end.x=3 us"}),
               {"--set time.end.x=3 us: key 'time.end': found \"20 us\", expected a table with a key 'x'"});
  expect_parts(refusal("", {"domain.outer[0]=3 us"}),
               {"key 'domain.outer': found a table, expected an array with an element [0]"});
  expect_parts(
      refusal_of(full_case, {"domain.outer.path[3].fillet=1 mm"}),
      {"--set domain.outer.path[3].fillet=1 mm: key 'domain.outer.path': found an array of 3 without an "
       "element [3]"});
  expect_parts(refusal("", {"cloud.spacing=1\ntime.end=2"}),
               {"--set cloud.spacing=1", "key 'cloud.spacing'"});
}

TEST(CaseReader, LaterErrorsKnowTheirPlace) {
  const Case c = read_small("", {"cloud.spacing=1 mm"});
  EXPECT_STREQ(c.error("domain.outer.rectangle.from", "does not fit").what(),
               "case.toml:6:21: key 'domain.outer.rectangle.from': does not fit");
  EXPECT_STREQ(c.error("cloud.spacing", "too large").what(),
               "--set cloud.spacing=1 mm: key 'cloud.spacing': too large");
  EXPECT_STREQ(c.error("time.step.max", "x").what(), "case.toml:1:2: key 'time.step.max': x");
  EXPECT_STREQ(c.error("output.probes.a", "x").what(), "case.toml: key 'output.probes.a': x");
  EXPECT_THROW(c.material("brass"), InputError);
}

TEST(CaseReader, NodeListsInlineAndFromFile) {
  const Case c = read_case_text(
      replaced(small_case, "spacing = \"0.25 mm\"",
               "pattern = \"list\"\nnodes = [\"0 0 mm\", \"10 0 mm\", [\"10 mm\", \"5 mm\"], \"0 5 mm\"]"),
      "case.toml");
  ASSERT_EQ(c.cloud.nodes.size(), 4U);
  EXPECT_EQ(c.cloud.nodes[2], Vec2(0.01, 0.005));

  const std::string folder = testing::TempDir() + "cnem_nodes";
  std::filesystem::create_directories(folder);
  std::ofstream(folder + "/cloud.csv") << "# corners\nx[mm], y [m]\n0,0\n10,0\r\n10,5e-3\n0,0.005\n";
  const std::string text =
      replaced(small_case, "spacing = \"0.25 mm\"", "pattern = \"list\"\nnodes_file = \"cloud.csv\"");
  std::ofstream(folder + "/case.toml") << text;
  const Case from_file = read_case(folder + "/case.toml");
  EXPECT_EQ(from_file.name, "cnem_nodes");
  EXPECT_EQ(from_file.cloud.nodes, c.cloud.nodes);
  // The resolved case stands alone.
  EXPECT_EQ(read_case_text(from_file.resolved, "elsewhere.toml").cloud.nodes, c.cloud.nodes);

  // A spreadsheet's mark of UTF-8 is no part of the first column.
  std::ofstream(folder + "/cloud.csv") << "\xef\xbb\xbfx[mm],y[mm]\n0,0\n10,0\n10,5\n0,5\n";
  EXPECT_EQ(read_case(folder + "/case.toml").cloud.nodes, c.cloud.nodes);

  const auto refusal_with = [&](const std::string& csv) {
    std::ofstream(folder + "/cloud.csv") << csv;
    return refusal_of(replaced(text, "cloud.csv", folder + "/cloud.csv"));
  };
  expect_parts(refusal_with("x,y\n0,0\n"),
               {"key 'cloud.nodes_file'", "cloud.csv:1", "a unit of length such as x[mm]"});
  expect_parts(refusal_with("x[mm],y[s]\n0,0\n"), {"cloud.csv:1", "column 'y[s]'"});
  expect_parts(refusal_with("x[mm],y[mm]\n0,0\n1,two\n"),
               {"cloud.csv:3", "found 'two', expected a finite number"});
  expect_parts(refusal_with("x[mm],y[mm]\n0,0,0\n"), {"cloud.csv:2", "two columns"});
  expect_parts(refusal_with("x[mm],y[mm]\n"), {"found no points"});
  expect_parts(refusal_of(replaced(text, "cloud.csv", "absent.csv")), {"case.toml:10:1", "found no file"});
}

TEST(CaseReader, WholeNumbersMayBeWrittenAsFloats) {
  EXPECT_EQ(read_small("", {"time.max_steps=1e5"}).time.max_steps, 100000);
  EXPECT_EQ(read_small("", {"adapt.indicator.max_nodes=2.0e4"}).adapt.max_nodes, 20000);
  EXPECT_EQ(read_small("", {"time.max_steps=1_000"}).time.max_steps, 1000);
  for (const char* wrong : {"1.5", "\"5\"", "-0.5"})
    expect_parts(refusal("", {std::string("time.max_steps=") + wrong}),
                 {std::string("found ") + wrong, "expected"});
  expect_parts(refusal("", {"time.max_steps=nan"}), {"found nan, expected a finite number"});
  expect_parts(refusal("", {"time.max_steps=-1e3"}), {"found -1000, expected"});
}

TEST(CaseReader, DamageThatTurnsBrittleIsAWarning) {
  const auto warnings = [](const std::string& more) {
    return read_small("plastic = { law = \"perfect\", yield = \"400 MPa\" }\n"
                      "damage = { law = \"johnson-cook\", D1 = -0.8, D2 = 2.1, D3 = -0.5, fracture_energy = "
                      "\"20 kJ/m2\"" +
                      more + " }\n")
        .warnings;
  };
  EXPECT_TRUE(warnings("").empty()) << "a known set: positive up to 1.9 times the flow stress in tension";
  EXPECT_TRUE(warnings(", D4 = -0.05, D5 = -0.5, Tmelt = \"1800 K\"").empty());
  ASSERT_EQ(warnings(", D4 = -0.1").size(), 1U);
  expect_parts(warnings(", D4 = -0.1")[0], {"materials.steel.damage.D4 = -0.1", "-0.382 times"});
  ASSERT_EQ(warnings(", D5 = -1.5, Tmelt = \"1800 K\"").size(), 1U);
  expect_parts(warnings(", D5 = -1.5, Tmelt = \"1800 K\"")[0], {"damage.D5 = -1.5", "-0.5 times"});
}

TEST(CaseReader, RefinementsOutsideMayReachIn) {
  const auto refined = [](const std::string& region, const std::string& growth) {
    return small_case + "[cloud.refine.band]\nspacing = \"0.1 mm\"\ngrowth = " + growth + "\n" + region +
           "\n";
  };
  for (const char* region : {"box = [\"4 -1 mm\", \"5 6 mm\"]", "box = [\"-1 -1 mm\", \"11 6 mm\"]",
                             "points = [\"4 -1 mm\", \"4 6 mm\"]", "box = [\"10 5 mm\", \"12 7 mm\"]",
                             "points = [\"10.2 5 mm\"]", "points = [\"5 2 mm\"]"})
    EXPECT_EQ(refusal_of(refined(region, "0.5")), "accepted") << region;
  for (const char* region : {"points = [\"10.4 5 mm\"]", "box = [\"10.4 0 mm\", \"12 5 mm\"]",
                             "points = [\"0 6 mm\", \"10 6 mm\"]"})
    expect_parts(refusal_of(refined(region, "0.5")),
                 {"case.toml:17:1", "outside the domain", "cloud.spacing"});
}

TEST(CaseReader, PaperCasesRead) {
  const std::string folder = CNEM_SOURCE_DIR "/cases/paper/";
  for (const char* name : {"shearing_sharp", "shearing_rounded"}) {
    const Case c = read_case(folder + name + "/case.toml", {"time.end=60 us"});
    EXPECT_EQ(c.name, name);
    EXPECT_EQ(c.time.end, 60e-6);
    EXPECT_TRUE(c.analysis.thermal);
    EXPECT_EQ(c.materials[0].conductivity, 5.86);
    EXPECT_EQ(c.material("304L").hardening->as<plasticity::JohnsonCook>().C, 0.0973);
    ASSERT_EQ(c.tools.size(), 2U);
    EXPECT_EQ(c.tools[0].velocity[1].value()(0.0), -11.0);
    double right = -1.0, left = 1.0;
    for (const CurvePiece& piece : c.tools[0].outline.pieces) right = std::max(right, piece.from.x());
    for (const CurvePiece& piece : c.tools[1].outline.pieces) left = std::min(left, piece.from.x());
    EXPECT_NEAR(right, 5e-3, 1e-15);
    EXPECT_NEAR(left - right, 0.2e-3, 1e-15);
    EXPECT_EQ(c.tools[0].outline.pieces.size(), std::string(name) == "shearing_sharp" ? 4U : 5U);
  }
}

} // namespace
} // namespace cnem::input
