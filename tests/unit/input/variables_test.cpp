// Variables of a case: [let] and what is calculated from it.
#include "tests/unit/input/case_text.hpp"

namespace cnem::input {
namespace {

const std::string cut = R"(
[let]
clearance = "share * sheet"
share = 0.07
sheet = "2 mm"
speed = "5 m/s"
rows = 3

[tools.punch]
rectangle = { from = ["1 mm + clearance", "5 mm"], to = "9 mm - clearance, 5 mm + sheet" }
velocity = { times = ["0 s", "sheet / speed"], values = ["0 m/s, 0 m/s", "0 m/s, -speed"] }

[time]
max_steps = "100 * rows"

[output]
pictures = "5 us, 2 * 5 us"

[domain]
material = "steel"
outer.start = "0 mm, 0 mm"
outer.path = [{ to = ["5 * sheet", "0 mm"] }, { to = "5 * sheet, 5 mm" }, { to = "0 5 mm" }]

[cloud]
spacing = "sheet / 8"

[materials.steel]
density = "7850 kg/m3"
elastic = { young = "210 GPa", poisson = "share + 0.23" }
)";

Case read_cut(const std::vector<std::string>& overrides = {}) {
  std::vector<std::string> all{"time.end=\"20 us\""};
  all.insert(all.end(), overrides.begin(), overrides.end());
  return read_case_text(cut, "case.toml", all);
}

std::string refusal_of_cut(const std::vector<std::string>& overrides) {
  try {
    read_cut(overrides);
  } catch (const InputError& error) { return error.what(); }
  return "accepted";
}

TEST(Variables, stand_wherever_a_value_stands) {
  const Case c = read_cut();
  EXPECT_EQ(c.cloud.spacing, 0.00025);
  EXPECT_EQ(c.time.max_steps, 300);
  EXPECT_EQ(c.output.pictures, (std::vector<double>{5e-6, 1e-5}));
  ASSERT_EQ(c.tools.size(), 1u);
  EXPECT_EQ(c.tools[0].velocity[1]->times(), (std::vector<double>{0.0, 0.0004}));
  EXPECT_EQ(c.tools[0].velocity[1]->values(), (std::vector<double>{0.0, -5.0}));
  expect_parts(c.resolved, {"from = \"0.00114 0.005 m\"\nto = \"0.00886 0.007 m\"", "to = \"0.01 0.005 m\"",
                            "poisson = 0.3",
                            "[let]\nclearance = \"0.00014 m\"\nshare = 0.07\nsheet = \"0.002 m\"\n"
                            "speed = \"5 m/s\"\nrows = 3\n"});
}

TEST(Variables, give_the_bits_of_the_same_case_in_numbers) {
  std::string plain = replaced(cut, "\"share * sheet\"", "\"0.14 mm\"");
  plain = replaced(plain, "[\"1 mm + clearance\", \"5 mm\"]", "\"1.14 5 mm\"");
  plain = replaced(plain, "\"9 mm - clearance, 5 mm + sheet\"", "\"8.86 7 mm\"");
  plain = replaced(plain, "\"sheet / 8\"", "\"0.25 mm\"");
  plain = replaced(plain, "\"share + 0.23\"", "0.3");
  EXPECT_EQ(read_case_text(plain, "case.toml", {"time.end=\"20 us\""}).resolved, read_cut().resolved);
}

TEST(Variables, are_listed_with_their_values) {
  const Case c = read_cut();
  ASSERT_EQ(c.variables.size(), 5u);
  EXPECT_EQ(c.variables[0].name, "clearance");
  EXPECT_EQ(c.variables[0].value, 0.00014);
  EXPECT_EQ(c.variables[0].unit, "m");
  EXPECT_EQ(c.variables[0].expression, "share * sheet");
  EXPECT_EQ(c.variables[1].unit, "");
  EXPECT_TRUE(c.warnings.empty());
}

TEST(Variables, of_a_resolved_case_are_kept_and_not_missed) {
  const std::string once = read_cut().resolved;
  const Case again = read_case_text(once, "case.toml", {});
  EXPECT_EQ(again.resolved, once);
  EXPECT_EQ(again.variables.size(), 5u);
  EXPECT_TRUE(again.warnings.empty());
}

TEST(Variables, are_set_on_the_command_line) {
  const Case c = read_cut({"let.clearance=\"0.2 mm\"", "let.sheet=3 mm"});
  expect_parts(c.resolved, {"from = \"0.0012 0.005 m\"\nto = \"0.0088 0.008 m\""});
  EXPECT_EQ(
      refusal_of_cut({"let.clearence=\"0.2 mm\""}),
      "--set let.clearence=\"0.2 mm\": key 'let.clearence': the case does not define it, expected one of "
      "the variables clearance, share, sheet, speed, rows (did you mean 'clearance'?)");
  EXPECT_EQ(
      refusal("", {"let.gap=\"1 mm\""}),
      "--set let.gap=\"1 mm\": key 'let.gap': the case does not define it, expected a variable of [let]");
}

TEST(Variables, that_nothing_uses_are_warned_of) {
  const std::string text = replaced(cut, "rows = 3", "rows = 3\nstray = \"share\"");
  const Case c = read_case_text(text, "case.toml", {"time.end=\"20 us\""});
  EXPECT_EQ(c.warnings,
            (std::vector<std::string>{"variable 'stray' (case.toml:8:1) is defined and nothing uses it"}));
  // "stray" was a part of what is replaced, perhaps
  EXPECT_EQ(read_case_text(text, "case.toml", {"time.end=\"20 us\"", "let.rows=4"}).warnings,
            std::vector<std::string>{});
}

TEST(Variables, that_nothing_uses_may_not_be_set) {
  const std::string expected =
      "--set let.clearance=0.2 mm: key 'let.clearance': found a value for a variable that "
      "nothing in the case uses, expected it in an expression; a resolved case holds values "
      "alone";
  try {
    read_case_text(read_cut().resolved, "case.toml", {"let.clearance=0.2 mm"});
    FAIL();
  } catch (const InputError& error) { EXPECT_EQ(error.what(), expected); }
}

TEST(Variables, may_be_read_in_degrees_below_zero) {
  const Case c = read_case_text(replaced(cut, "rows = 3", "rows = 3\ncold = \"-20 degC\""), "case.toml",
                                {"time.end=\"20 us\"", "initial.temperature=cold"});
  EXPECT_DOUBLE_EQ(c.initial.temperature, 253.15);
}

TEST(Variables, commas_in_numbers_are_told_how_they_are_written) {
  expect_parts(refusal_of_cut({"let.sheet=0,5 mm"}),
               {"found '0,5 mm' with a comma, expected a point in a number: '0.5 mm'"});
  expect_parts(refusal_of_cut({"output.pictures=0,5 1,5 us"}), {"found '0,5 1,5 us' with a comma"});
  expect_parts(refusal_of_cut({"domain.outer.start=-12, -3 mm"}),
               {"found '-12, -3 mm' with a comma, expected spaces between numbers: '-12 -3 mm'"});
}

TEST(Variables, that_are_wrong_are_told_once_in_drawings_too) {
  const std::string drawing = std::string(CNEM_SOURCE_DIR) + "/cases/blanking/drawing/case.toml";
  try {
    read_case(drawing, {"let.sheet=0,1 mm"});
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(
        std::string(error.what()),
        "--set let.sheet=0,1 mm: key 'let.sheet': found \"0,1 mm\", found '0,1 mm' with a comma, expected "
        "a point in a number: '0.1 mm'");
  }
}

TEST(Variables, that_are_wrong_are_told_once) {
  EXPECT_EQ(
      refusal_of_cut({"let.sheet=\"2 mm + 3 s\""}),
      "--set let.sheet=\"2 mm + 3 s\": key 'let.sheet': found \"2 mm + 3 s\", which adds a length (m) and "
      "a time (s) at character 6, expected quantities of one kind");
  EXPECT_EQ(
      refusal_of_cut({"let.sheet=\"clearance\""}),
      "--set let.sheet=\"clearance\": key 'let.sheet': found \"clearance\", which names 'clearance' at "
      "character 1, expected variables that do not follow from themselves: clearance from sheet, sheet from "
      "clearance");
  EXPECT_EQ(
      refusal_of_cut({"let.sheet=[1]"}),
      "--set let.sheet=[1]: key 'let.sheet': found an array of 1, which is no quantity, expected one such "
      "as \"2 mm\", a number, or an expression such as \"0.08 * sheet\"");
  EXPECT_EQ(
      refusal("[let]\nt = \"2 mm\"\n"),
      "case.toml:15:1: key 'let': found the name \"t\", which is a unit, of a mass, expected another name "
      "such as 't_'");
  std::string chain = "[let]\na0 = \"1 mm\"\n";
  for (int k = 1; k < 200; ++k)
    chain = replaced(chain, "[let]\n", fmt::format("[let]\na{} = \"a{}\"\n", k, k - 1));
  expect_parts(refusal(chain), {"key 'let.a", "expected one that fewer variables lead to"});
}

TEST(Variables, values_that_do_not_fit_say_where_they_come_from) {
  EXPECT_EQ(
      refusal_of_cut({"cloud.spacing=\"shet / 8\""}),
      "--set cloud.spacing=\"shet / 8\": key 'cloud.spacing': found \"shet / 8\", which names 'shet' at "
      "character 1, expected one of the variables clearance, share, sheet, speed, rows (did you mean "
      "'sheet'?)");
  EXPECT_EQ(refusal_of_cut({"cloud.spacing=\"sheet * sheet\""}),
            "--set cloud.spacing=\"sheet * sheet\": key 'cloud.spacing': found '4e-06 m2', which is an area, "
            "expected a length such as \"0.2 mm\" (it comes from \"sheet * sheet\")");
  EXPECT_EQ(refusal_of_cut({"cloud.spacing=\"clearance - sheet\""}),
            "--set cloud.spacing=\"clearance - sheet\": key 'cloud.spacing': found \"-0.00186 m\" (from "
            "\"clearance - sheet\"), expected a length > 0 m");
  EXPECT_EQ(
      refusal_of_cut({"time.max_steps=\"rows / 2\""}),
      "--set time.max_steps=\"rows / 2\": key 'time.max_steps': found \"rows / 2\", which is 1.5, expected "
      "a whole number");
  expect_parts(refusal_of_cut({"domain.outer.start=\"clearance sheet\""}),
               {"expected an operator such as '*'"});
}

TEST(Variables, leave_mistakes_in_units_to_their_keys) {
  EXPECT_EQ(refusal_of_cut({"cloud.spacing=\"0.5 mn\""}),
            "--set cloud.spacing=\"0.5 mn\": key 'cloud.spacing': unknown unit 'mn' (did you mean 'mm'?), "
            "expected a length such as \"0.2 mm\"");
}

} // namespace
} // namespace cnem::input
