// Files that a case includes.
#include "core/error.hpp"
#include "tests/unit/input/case_text.hpp"

#include <filesystem>
#include <fstream>

namespace cnem::input {
namespace {

namespace fs = std::filesystem;

/// A folder with files that goes when the test ends.
class IncludedFiles : public testing::Test {
protected:
  IncludedFiles() { fs::create_directories(folder / "shared"); }
  ~IncludedFiles() override { fs::remove_all(folder); }

  void write(const std::string& name, const std::string& text) const { std::ofstream(folder / name) << text; }
  Case read(const std::vector<std::string>& overrides = {}) const {
    return read_case((folder / "case.toml").string(), overrides);
  }
  std::string refusal_here(const std::vector<std::string>& overrides = {}) const {
    try {
      (void)read(overrides);
    } catch (const InputError& error) {
      std::string text = error.what();
      const std::string prefix = folder.string() + "/";
      for (auto at = text.find(prefix); at != std::string::npos; at = text.find(prefix))
        text.erase(at, prefix.size());
      return text;
    }
    return "accepted";
  }

  fs::path folder =
      fs::path(testing::TempDir()) / testing::UnitTest::GetInstance()->current_test_info()->name();
};

const std::string metal = R"([materials.steel]
density = "7850 kg/m3"
elastic = { young = "210 GPa", poisson = 0.3 }

[materials.copper]
density = "8960 kg/m3"
elastic = { young = "124 GPa", poisson = 0.34 }
)";

const std::string block = R"([domain]
material = "steel"
outer.rectangle = { from = "0 0 mm", to = "10 mm, sheet" }
)";

const std::string end = "[time]\nend = \"20 us\"\n[cloud]\nspacing = \"0.25 mm\"\n";

TEST_F(IncludedFiles, are_merged_and_the_case_itself_holds) {
  write("shared/metal.toml", metal);
  write("shared/press.toml", "include = \"metal.toml\"\n[let]\nsheet = \"3 mm\"\n" + block);
  write("case.toml", "include = [\"shared/press.toml\"]\n" + end +
                         "[let]\nsheet = \"5 mm\"\n[materials.steel]\ndensity = \"7800 kg/m3\"\n");
  const Case c = read();
  ASSERT_EQ(c.materials.size(), 2u);
  EXPECT_EQ(c.materials[0].density, 7800.0);
  expect_parts(c.resolved, {"to = \"0.01 0.005 m\"", "young = \"210000000000 Pa\""});
  EXPECT_EQ(c.location.at("materials.copper.density"), (folder / "shared/metal.toml").string() + ":6:1");
  EXPECT_EQ(c.resolved.find("include ="), std::string::npos);
}

TEST_F(IncludedFiles, later_ones_hold) {
  write("a.toml", metal);
  write("b.toml", "[let]\nsheet = \"3 mm\"\n[materials.copper]\ndensity = \"8900 kg/m3\"\n");
  write("case.toml", "include = [\"a.toml\", \"b.toml\"]\n" + end + block);
  EXPECT_EQ(read().materials[1].density, 8900.0);
  EXPECT_EQ(read({"let.sheet=\"2 mm\"", "materials.copper.density=\"9000 kg/m3\""}).materials[1].density,
            9000.0);
}

TEST_F(IncludedFiles, mistakes_in_them_are_told_by_their_lines) {
  write("shared/metal.toml", replaced(metal, "kg/m3", "kg/m2"));
  write("case.toml", "include = \"shared/metal.toml\"\n" + end + replaced(block, "sheet", "5 mm"));
  expect_parts(refusal_here(), {"shared/metal.toml:2:11: key 'materials.steel.density': found '7850 kg/m2'"});
  write("shared/metal.toml", "[materials\n");
  expect_parts(refusal_here(), {"shared/metal.toml:1:", "not TOML"});
}

TEST_F(IncludedFiles, must_exist_and_not_include_themselves) {
  write("case.toml", "include = [\"metal.toml\"]\n" + end + block);
  EXPECT_EQ(refusal_here(), "case.toml:1:12: key 'include': found \"metal.toml\", expected a file, seen from "
                            "the folder of the file that includes it: there is no metal.toml");
  write("metal.toml", "include = \"shared/other.toml\"\n" + metal);
  write("shared/other.toml", "include = \"../metal.toml\"\n");
  EXPECT_EQ(refusal_here(), "shared/other.toml:1:11: key 'include': found \"../metal.toml\", expected a file "
                            "that does not include itself: metal.toml does");
  write("case.toml", "include = [3]\n" + end + block);
  EXPECT_EQ(refusal_here(),
            "case.toml:1:12: key 'include': found 3, expected the name of a file such as \"materials.toml\"");
  write("case.toml", "include = true\n" + end + block);
  EXPECT_EQ(refusal_here(),
            "case.toml:1:11: key 'include': found true, expected the name of a file or an array "
            "of them, such as [\"materials.toml\"]");
  write("case.toml", end + replaced(block, "sheet", "5 mm"));
  EXPECT_EQ(refusal_here({"include=metal.toml"}),
            "--set include=metal.toml: key 'include': goes into the file of a case, expected none beside it");
}

} // namespace
} // namespace cnem::input
