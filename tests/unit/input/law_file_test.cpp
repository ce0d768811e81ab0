// Files of cutting laws that milling cases name.
#include "input/case_machining.hpp"
#include "tests/unit/input/case_text.hpp"

#include <filesystem>
#include <fstream>

namespace cnem::input {
namespace {

namespace fs = std::filesystem;

const std::string law = R"(law = "linear"
[range]
thickness = "0.02 0.2 mm"
speed = "4 6 m/s"
[linear]
Ktc = "767 MPa"
Kte = "27.7 N/mm"
[kienzle]
Kt1 = "1.1 GPa"
mt = 0.2
[table]
thickness = "0.02 0.1 mm"
rakes = "0 10 deg"
Ft = "40 70 20 50 N/mm"
Fr = "30 35 20 25 N/mm"
[errors.linear]
Ktc = "3 MPa"
)";

const std::string milling = R"([analysis]
type = "milling"
[cutter]
diameter = "12 mm"
teeth = 3
[cutting]
law = "law.toml"
[milling]
speed = "8000 rpm"
feed = "0.1 mm"
axial_depth = "2 mm"
)";

/// A folder with a case and a law that goes when the test ends.
class LawFiles : public testing::Test {
protected:
  LawFiles() {
    fs::create_directories(folder / "laws");
    write("law.toml", law);
    write("case.toml", milling);
  }
  ~LawFiles() override { fs::remove_all(folder); }

  void write(const std::string& name, const std::string& text) const { std::ofstream(folder / name) << text; }
  Case read(const std::vector<std::string>& overrides = {}) const {
    return read_case((folder / "case.toml").string(), overrides);
  }
  double force(const std::vector<std::string>& overrides = {}) const {
    return read(overrides).machining->cut.law.at({.thickness = 1e-4, .speed = 5.0}).force[0];
  }

  fs::path folder =
      fs::path(testing::TempDir()) / testing::UnitTest::GetInstance()->current_test_info()->name();
};

TEST_F(LawFiles, GiveTheLawThatTheyName) {
  EXPECT_DOUBLE_EQ(force(), 767e6 * 1e-4 + 27.7e3);
  const machining::LawRange range = read().machining->law_range;
  EXPECT_DOUBLE_EQ(range.thickness.low, 2e-5);
  EXPECT_DOUBLE_EQ(range.speed.high, 6.0);
  EXPECT_FALSE(range.rake.bounded());
}

TEST_F(LawFiles, GiveAnotherOfTheirLawsThatTheCaseNames) {
  EXPECT_NEAR(force({"cutting.forces.law=kienzle"}), 1.1e9 * 1e-4 * std::pow(0.1, -0.2), 1e-6);
  EXPECT_NEAR(force({"cutting.forces.law=table", "cutter.rake=5 deg"}), 60e3, 1e-6);
}

TEST_F(LawFiles, StandBehindWhatTheCaseSays) {
  EXPECT_DOUBLE_EQ(force({"cutting.forces.Kte=0 N/mm"}), 767e6 * 1e-4);
  EXPECT_EQ(read({"cutting.forces.range.thickness=0.1 0.2 mm"}).machining->law_range.thickness.low, 1e-4);
}

TEST_F(LawFiles, AreNotNeededOnceACaseIsResolved) {
  const std::string resolved = read().resolved;
  EXPECT_EQ(resolved.find("law.toml"), std::string::npos);
  const Case again = read_case_text(resolved, "resolved.toml");
  EXPECT_EQ(again.machining->cut.law.at({.thickness = 1e-4}).force[0], force());
  EXPECT_EQ(again.resolved.substr(again.resolved.find('\n')), resolved.substr(resolved.find('\n')));
}

TEST_F(LawFiles, AreSeenFromTheFileThatNamesThem) {
  fs::rename(folder / "law.toml", folder / "laws/law.toml");
  write("laws/cut.toml", "[cutting]\nlaw = \"law.toml\"\n");
  std::string without = replaced(milling, "[cutting]\nlaw = \"law.toml\"\n", "");
  write("case.toml", "include = \"laws/cut.toml\"\n" + without);
  EXPECT_DOUBLE_EQ(force(), 767e6 * 1e-4 + 27.7e3);
}

} // namespace
} // namespace cnem::input
