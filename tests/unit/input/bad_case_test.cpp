// Wrong cases and what their authors are told.
#include "core/error.hpp"
#include "tests/unit/input/case_text.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>

namespace cnem::input {
namespace {

TEST(BadCase, AbsentFileAndFolder) {
  try {
    read_case("nowhere/case.toml");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "nowhere/case.toml: no such file, expected a case such as case.toml");
  }
  const std::string folder = testing::TempDir();
  try {
    read_case(folder);
    FAIL();
  } catch (const InputError& error) { expect_parts(error.what(), {"is a folder", "case.toml"}); }
}

TEST(BadCase, SyntaxAndDuplicateKeys) {
  expect_parts(refusal("[boundary\n"), {"case.toml:14:", "not TOML"});
  expect_parts(refusal("x = \n"), {"case.toml:14:", "not TOML"});
  expect_parts(refusal("[cloud.refine]\n[time]\nend = \"1 s\"\n"), {"case.toml:15:", "not TOML", "time"});
  expect_parts(refusal_of(replaced(small_case, "end = \"20 us\"", "end = \"20 us\"\nend = \"3 us\"")),
               {"case.toml:3:", "not TOML", "end"});
  expect_parts(refusal_of("\xff\xfe"), {"case.toml:1:1", "not TOML"});
}

TEST(BadCase, EmptyFileListsWhatIsMissing) {
  expect_parts(refusal_of(""), {"key 'domain': missing", "key 'cloud': missing", "key 'materials': missing",
                                "and 1 more missing keys"});
}

TEST(BadCase, ExplicitAnalysesNeedAnEnd) {
  expect_parts(
      refusal_of("[time]\nstep.safety = 0.5\n"
                 "[domain]\nmaterial = \"m\"\nouter.rectangle = { from = \"0 0 mm\", to = \"1 1 mm\" }\n"
                 "[cloud]\nspacing = \"0.1 mm\"\n"
                 "[materials.m]\ndensity = \"1 kg/m3\"\nelastic = { young = \"1 MPa\", poisson = 0.3 }\n"),
      {"case.toml:1:1: key 'time.end': missing, expected a time such as"});
}

TEST(BadCase, StaticAnalysesRefuseWhatMoves) {
  const std::string head = "[analysis]\ntype = \"static\"\n";
  expect_parts(refusal(head + "[boundary.b]\npieces = \"left\"\nvelocity = \"1 0 m/s\"\n"),
               {"key 'boundary.b.velocity': found a velocity in a static analysis, expected a displacement"});
  expect_parts(refusal(head + "[initial]\nvelocity = \"1 0 m/s\"\n"),
               {"key 'initial.velocity': found in a static"});
  expect_parts(
      refusal("[analysis]\nkinematics = \"plane stress\"\n[method]\npressure_exchange = 1.0\n"),
      {"key 'method.pressure_exchange': found an exchange of volume in an explicit analysis of plane "
       "stress, expected 0"});
}

TEST(BadCase, ThermalToolsNeedAThermalAnalysis) {
  expect_parts(refusal("[tools.t]\ncircle = { centre = \"5 7 mm\", radius = \"1 mm\" }\nheat.conductance = "
                       "\"1 W/(m2 K)\"\n"),
               {"key 'tools.t.heat': found the thermal side of a tool"});
}

TEST(BadCase, UnknownKeysWithTheNearestOne) {
  EXPECT_EQ(refusal("[boundary.b]\npeices = \"left\"\npieces = \"left\"\nsymmetry = true\n"),
            "case.toml:15:1: key 'boundary.b.peices': unknown key, expected one of pieces, points, symmetry, "
            "velocity, "
            "displacement, traction, pressure, temperature, heat_flux, convection (did you mean "
            "'boundary.b.pieces'?)");
  expect_parts(refusal("[tool.punch]\n"), {"case.toml:14:2", "key 'tool'", "did you mean 'tools'?"});
  expect_parts(refusal_of("spacing = 3\n" + small_case),
               {"case.toml:1:1: key 'spacing': unknown key", "did you mean 'cloud.spacing'?"});
  expect_parts(refusal_of(replaced(small_case, "from =", "form =")),
               {"case.toml:6:21: key 'domain.outer.rectangle.form'",
                "did you mean 'domain.outer.rectangle.from'?", "key 'domain.outer.rectangle.from': missing"});
  expect_parts(
      refusal("[tools.a]\ncircle = { centre = \"0 9 mm\", radius = \"1 mm\" }\nvelocity = { value = \"0 1 "
              "m/s\", rmp = \"1 us\" }\n"),
      {"case.toml:16:33: key 'tools.a.velocity': unknown part 'rmp'", "did you mean 'ramp'?"});
}

TEST(BadCase, ThreeOfAKindThenACount) {
  const std::string message = refusal("[q1]\n[q2]\n[q3]\n[q4]\n[q5]\n[time2]\n", {"time.end=3 kg"});
  EXPECT_EQ(std::count(message.begin(), message.end(), '\n'), 4) << message;
  expect_parts(message, {"key 'q1'", "key 'q2'", "key 'q3'", "and 3 more unknown keys", "key 'time.end'"});
}

TEST(BadCase, TypesAndUnits) {
  const auto with_end = [](const std::string& value) {
    return refusal_of(replaced(small_case, "\"20 us\"", value));
  };
  EXPECT_EQ(with_end("20"),
            "case.toml:2:7: key 'time.end': found 20 without a unit, expected a time such as \"12 us\"");
  expect_parts(with_end("\"20\""),
               {"case.toml:2:7: key 'time.end': found '20' without a unit, expected a time"});
  expect_parts(with_end("\"20 m\""), {"which is a length, expected a time such as \"12 us\""});
  expect_parts(with_end("true"), {"found true, expected a time"});
  expect_parts(with_end("[1, 2]"), {"found an array of 2, expected a time"});
  expect_parts(with_end("1979-05-27"), {"found a date or time of day, expected a time"});
  expect_parts(with_end("\"1 2 us\""), {"found 2 numbers"});
  expect_parts(with_end("{ a = 1 }"), {"found a table, expected a time"});

  expect_parts(refusal("[analysis]\nthermal = \"yes\"\n"),
               {"case.toml:15:11: key 'analysis.thermal'", "true or false"});
  expect_parts(refusal("[method]\ngauss_points = 1.5\n"), {"found 1.5, expected a whole number"});
  expect_parts(
      refusal("[method]\nfunctions = \"sibsen\"\n"),
      {"found \"sibsen\", expected one of \"sibson\", \"laplace\", \"mls\" (did you mean 'sibson'?)"});
  expect_parts(refusal("title = 3\n", {}), {"key 'materials.steel.title'"}); // belongs to the table above
  expect_parts(refusal("", {"title=3"}), {"--set title=3: key 'title': found 3, expected a text"});
  expect_parts(refusal("", {"time=3"}), {"key 'time': found 3, expected a table [time]"});
  expect_parts(refusal("", {"tools=3"}), {"found 3, expected tables [tools.NAME]"});
  expect_parts(refusal("", {"tools.a=3"}), {"key 'tools.a': found 3, expected a table"});
  expect_parts(refusal("", {"domain.outer.path=3"}), {"found 3, expected an array of tables"});
  expect_parts(refusal("", {"domain.outer.path=[3]"}),
               {"key 'domain.outer.path[0]': found 3, expected a table"});
  expect_parts(refusal("[tools.\"a b\"]\n"),
               {"key 'tools.\"a b\"': found the name \"a b\", expected at most 100 letters"});
  expect_parts(refusal("[initial]\nvelocity = \"1 m/s\"\n"), {"found 1 numbers in \"1 m/s\", expected 2"});
  expect_parts(refusal("[initial]\nvelocity = [\"1 m/s\", \"2 m\"]\n"), {"case.toml:15:22", "found '2 m'"});
  expect_parts(refusal("[output]\npicture_fields = [\"presure\"]\n"),
               {"found \"presure\"", "did you mean 'pressure'?"});
}

TEST(BadCase, TimeFunctions) {
  const auto with = [](const std::string& velocity) {
    return refusal("[boundary.b]\npieces = \"top\"\nvelocity = " + velocity + "\n");
  };
  expect_parts(with("{ ramp = \"1 us\" }"),
               {"case.toml:16:12", "either { value, ramp, from, smooth }", "{ times, values }"});
  expect_parts(with("{ value = \"0 1 m/s\", times = \"0 1 s\", values = [] }"), {"either { value"});
  expect_parts(with("{ x = \"1 m\" }"), {"found '1 m', which is a length, expected a velocity"});
  expect_parts(with("{ x = \"1 m/s\", value = \"0 1 m/s\" }"), {"unknown part 'value', expected x, y"});
  expect_parts(with("{ x = { value = \"1 m/s\", ramp = \"0 us\" } }"),
               {"found a ramp of \"0 us\", expected a time > 0 s"});
  expect_parts(with("{ x = { value = \"1 m/s\", from = \"0 m/s\" } }"), {"'from' without 'ramp'"});
  expect_parts(with("{ x = { times = \"0 1 us\", values = \"0 1 2 m/s\" } }"), {"as many times as values"});
  expect_parts(with("{ x = { times = \"0 0 us\", values = \"0 1 m/s\" } }"), {"must increase"});
}

TEST(BadCase, Ranges) {
  const auto with = [](const std::string& from, const std::string& to) {
    return refusal_of(replaced(small_case, from, to));
  };
  expect_parts(with("\"20 us\"", "\"-1 us\""),
               {"case.toml:2:7: key 'time.end': found \"-1 us\", expected a time > 0 s"});
  expect_parts(with("poisson = 0.3", "poisson = 0.5"), {"found 0.5, expected a plain number in (-1, 0.5)"});
  expect_parts(with("poisson = 0.3", "poisson = nan"), {"found nan, expected a finite number"});
  expect_parts(with("\"7850 kg/m3\"", "\"0 kg/m3\""), {"expected a density > 0 kg/m3"});
  expect_parts(with("\"0.25 mm\"", "\"0 mm\""), {"key 'cloud.spacing'", "expected a length > 0 m"});
  expect_parts(refusal("", {"method.gauss_points=4"}), {"found 4", "in [1, 3]"});
  expect_parts(refusal("", {"initial.temperature=-1 K"}), {"a temperature ≥ 0 K"});
  expect_parts(
      refusal("", {"materials.steel.plastic={law=\"johnson-cook\", A=\"1 MPa\", B=\"1 MPa\", n=1, T0=\"300 "
                   "K\", Tmelt=\"299 K\"}"}),
      {"key 'materials.steel.plastic.Tmelt': found 299 K, expected more than T0 = 300 K"});
  expect_parts(refusal("", {"materials.steel.plastic={law=\"johnson-cook\", A=\"0 MPa\", B=\"0 MPa\", n=1}"}),
               {"expected some strength"});
  expect_parts(refusal("[boundary.b]\npieces = \"top\"\nvelocity = { x = \"1e999 m/s\" }\n"),
               {"beyond what a number"});
}

TEST(BadCase, KeysThatGoWithAChoice) {
  const auto with = [](const std::string& plastic) {
    return refusal("[materials.steel.plastic]\n" + plastic);
  };
  expect_parts(with("law = \"linear\"\nyield = \"1 MPa\"\n"),
               {"case.toml:14:", "plastic.hardening': missing"});
  expect_parts(with("law = \"perfect\"\nyield = \"1 MPa\"\nA = \"1 MPa\"\n"),
               {"case.toml:17:1: key 'materials.steel.plastic.A': goes with law = \"johnson-cook\" or "
                "\"calamaz\", expected none "
                "with law = \"perfect\""});
  expect_parts(with("law = \"johnson\"\nA = \"1 MPa\"\n"), {"did you mean 'johnson-cook'?"});
  expect_parts(refusal("[tools.a]\ncircle = { centre = \"0 9 mm\", radius = \"1 mm\" }\nfriction = { law = "
                       "\"coulomb\" }\n"),
               {"key 'tools.a.friction.coefficient': missing"});
  expect_parts(refusal("", {"time.step.fixed=1 ns", "time.step.max=1 ns"}),
               {"fixed step and a largest step"});
  expect_parts(refusal("", {"time.step.fixed=1 ns", "time.step.min=1 ns"}), {"fixed step and a least step"});
  for (const char* key : {"output.checkpoint.keep=3", "time.max_steps=5"})
    expect_parts(refusal("", {"analysis.type=static", key}), {"found in a static analysis"});
}

TEST(BadCase, References) {
  EXPECT_EQ(
      refusal("", {"domain.material=steal"}),
      "--set domain.material=steal: key 'domain.material': found \"steal\", expected one of the materials "
      "steel (did you mean 'steel'?)");
  expect_parts(refusal("", {"domain.material=steel.elastic"}), {"found \"steel.elastic\""});
  expect_parts(
      refusal("[boundary.b]\npieces = [\"left\", \"botom\"]\nsymmetry = true\n"),
      {"case.toml:15:19: key 'boundary.b.pieces': found \"botom\", expected a boundary piece: bottom, right, "
       "top, left or all (did you mean 'bottom'?)"});
  expect_parts(refusal("[analysis]\nthermal = true\n"),
               {"case.toml:11:12: key 'materials.steel.heat': missing", "analysis.thermal is true"});
}

TEST(BadCase, ConditionsThatFight) {
  const auto with = [](const std::string& first, const std::string& second) {
    return refusal("[boundary.one]\npieces = \"top\"\n" + first + "\n[boundary.two]\npieces = [\"all\"]\n" +
                   second + "\n");
  };
  EXPECT_EQ(with("velocity = { y = \"0 m/s\" }", "displacement = \"0 0 mm\""),
            "case.toml:19:1: key 'boundary.two.displacement': sets motion along y on piece 'top', where "
            "boundary.one.velocity sets motion along y already, expected one of them");
  EXPECT_EQ(with("velocity = { y = \"0 m/s\" }", "displacement = { x = \"0 mm\" }"), "accepted");
  expect_parts(with("traction = \"1 0 Pa\"", "velocity = { x = \"0 m/s\" }"),
               {"sets motion along x on piece 'top', where boundary.one.traction sets traction along x"});
  EXPECT_EQ(with("traction = { y = \"1 Pa\" }", "velocity = { x = \"0 m/s\" }"), "accepted");
  expect_parts(with("symmetry = true", "velocity = { x = \"0 m/s\" }"),
               {"boundary.one.symmetry sets symmetry"});
  expect_parts(with("pressure = \"1 Pa\"", "pressure = \"2 Pa\""), {"sets pressure on piece 'top'"});
  expect_parts(with("pressure = \"1 Pa\"", "temperature = \"2 K\""), {"with analysis.thermal = true only"});
  expect_parts(with("pressure = \"1 Pa\"", "symmetry = false"), {"key 'boundary.two': sets nothing"});
  const std::string heat =
      "[materials.steel.heat]\nspecific_heat = \"1 J/(kg K)\"\nconductivity = \"1 W/(m K)\"\n";
  expect_parts(
      refusal(heat + "[boundary.b]\npieces = \"all\"\ntemperature = \"3 K\"\nheat_flux = \"1 W/m2\"\n"),
      {"sets heat flux on piece 'bottom', where boundary.b.temperature sets temperature already"});
}

TEST(BadCase, ToolHeatAndOutputs) {
  const std::string tool = "[tools.a]\ncircle = { centre = \"0 9 mm\", radius = \"1 mm\" }\n";
  expect_parts(
      refusal(tool + "heat = { conductivity = \"1 W/(m K)\" }\n"),
      {"case.toml:16:1: key 'tools.a.heat': expected either effusivity, or conductivity, density and"});
  expect_parts(
      refusal("[output.probes.p]\nat = \"11 1 mm\"\nfields = \"temperature\"\n"),
      {"case.toml:15:1: key 'output.probes.p.at': the probe at (0.011, 0.001) m is outside domain.outer"});
  expect_parts(refusal("[output.windows.w]\nbox = [\"0 0 mm\", \"1 0 mm\"]\n"), {"has no area"});
  expect_parts(refusal("[output.windows.w]\nbox = [\"0 0 mm\"]\n"),
               {"found 1 points, expected two opposite corners"});
}

TEST(BadCase, Clouds) {
  const auto with = [](const std::string& cloud) {
    return refusal_of(replaced(small_case, "spacing = \"0.25 mm\"", cloud));
  };
  const std::string no_offsets = "has no effect with pattern = \"hexagonal\", whose nodes have no random";
  expect_parts(with("spacing = \"1 mm\"\nseed = 2"), {"case.toml:10:1: key 'cloud.seed': " + no_offsets});
  expect_parts(with("spacing = \"1 mm\"\njitter = 0.1"), {"key 'cloud.jitter': " + no_offsets});
  expect_parts(with("spacing = \"1 mm\"\npattern = \"regular\"\nseed = 2"),
               {"with pattern = \"regular\"", "expected it with \"jittered\""});
  EXPECT_EQ(with("spacing = \"1 mm\"\npattern = \"jittered\"\njitter = 0.1\nseed = 2"), "accepted");
  EXPECT_EQ(with("spacing = \"1 mm\"\njitter = 0.2\nseed = 1"), "accepted") << "resolved cases held them";
  expect_parts(with("seed = 1"), {"case.toml:8:2: key 'cloud.spacing': missing, expected a length"});
  expect_parts(with("pattern = \"list\""), {"found none of nodes and nodes_file"});
  expect_parts(with("spacing = \"1 mm\"\nnodes = []"), {"goes with pattern = \"list\""});
  expect_parts(with("pattern = \"list\"\nnodes = []\nnodes_file = \"a\""),
               {"found both of nodes and nodes_file"});
  const auto refine = [](const std::string& keys) { return refusal("[cloud.refine.r]\n" + keys); };
  expect_parts(refine("spacing = \"1 mm\"\n"),
               {"case.toml:14:", "found none of box, points and tips, expected one"});
  expect_parts(refine("box = [\"0 0 mm\", \"1 1 mm\"]\n"), {"found none of spacing and factor"});
  expect_parts(refine("points = []\nfactor = 0.5\n"), {"found no points"});
  expect_parts(refine("points = [\"0 0 mm\"]\nfactor = 1.5\n"), {"in (0, 1]"});
}

/// Any prefix of a case, and any case with a character struck out, is refused or accepted, never crashed on.
TEST(BadCase, MutilatedTextNeverCrashes) {
  std::ifstream stream(CNEM_SOURCE_DIR "/cases/paper/shearing_rounded/case.toml");
  const std::string text((std::istreambuf_iterator<char>(stream)), {});
  ASSERT_GT(text.size(), 1000U);
  for (std::size_t i = 0; i < text.size(); i += 11) {
    (void)refusal_of(text.substr(0, i));
    (void)refusal_of(text.substr(0, i) + text.substr(i + 1));
  }
}

TEST(BadCase, KeysWithoutEndAreRefusedAtOnce) {
  std::string text = small_case;
  for (int k = 0; k < 20000; ++k) text += "key_" + std::to_string(k) + " = 1\n";
  expect_parts(refusal_of(text), {"case.toml:11:1: found a table of 20002 keys, expected at most 10000"});
}

} // namespace
} // namespace cnem::input
