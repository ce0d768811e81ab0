// `cnem materials`: what is printed and written, and how it fails.
#include "app/command_line.hpp"

#include "input/library.hpp"
#include "report/materials.hpp"
#include "tests/temporary_folder.hpp"

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>

namespace cnem::app {
namespace {

class MaterialsCommand : public ::testing::Test {
protected:
  int call(std::vector<std::string> words) {
    words.insert(words.begin(), {"cnem", "materials"});
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    ::testing::internal::CaptureStderr();
    ::testing::internal::CaptureStdout();
    const int code = command_line(static_cast<int>(argv.size()), argv.data());
    printed = ::testing::internal::GetCapturedStdout();
    message = ::testing::internal::GetCapturedStderr();
    return code;
  }
  void expect_printed(const std::vector<std::string>& parts) const {
    for (const std::string& part : parts) EXPECT_NE(printed.find(part), std::string::npos) << part << printed;
  }

  const cnem::testing::TemporaryFolder temporary{"materials"};
  std::string message, printed;
};

TEST_F(MaterialsCommand, lists_every_material) {
  ASSERT_EQ(call({}), 0) << message;
  for (const std::string& name : input::library_names()) EXPECT_NE(printed.find(name), std::string::npos);
  expect_printed(
      {"johnson-cook", "thermal", "generic", "plastic strain rate 0 to 4000 1/s", "range not stated"});
}

TEST_F(MaterialsCommand, shows_constants_with_units_sources_and_ranges) {
  ASSERT_EQ(call({"show", "AA6061-T6"}), 0) << message;
  expect_printed({"EN AW-6061", "young", "68.9 GPa", "A ", "324 MPa", "0.002", "933.6 K", "166.9 W/(m K)",
                  "UCRL-JC-134118", "0 to 4000 1/s", "Notes"});
  ASSERT_EQ(call({"show", "lib:4340"}), 0) << "as a case writes it";
  expect_printed({"fracture_energy", "generic", "Johnson and Cook 1985"});
}

TEST_F(MaterialsCommand, writes_a_page_that_needs_nothing_else) {
  const std::filesystem::path file = temporary.path() / "page.html";
  ASSERT_EQ(call({"show", "C45", "--output", file.string()}), 0) << message;
  std::ifstream stream(file);
  const std::string page{std::istreambuf_iterator<char>(stream), {}};
  for (const char* part :
       {"<svg", "flow stress", "Flow curves", "553.1 MPa", "Jaspers 1999", "materials/C45.toml"})
    EXPECT_NE(page.find(part), std::string::npos) << part;
  EXPECT_EQ(page.find("http"), page.find("http://www.w3.org")) << "nothing is fetched";
  EXPECT_EQ(page.find("nan"), std::string::npos);
}

TEST_F(MaterialsCommand, draws_every_material) {
  for (const std::string& name : input::library_names()) {
    const report::ReportData page = report::material_report(input::library_material(name), "test");
    ASSERT_EQ(page.charts.size(), 2U) << name;
    for (const report::Chart& chart : page.charts)
      for (const report::ChartSeries& curve : chart.series)
        for (const double stress : curve.y) EXPECT_GT(stress, 0.0) << name << ' ' << curve.label;
  }
}

TEST_F(MaterialsCommand, refuses_a_name_that_is_not_there) {
  EXPECT_EQ(call({"show", "304-L"}), 2);
  EXPECT_NE(message.find("found \"304-L\", expected a material of the library: lib:304L, "),
            std::string::npos)
      << message;
  EXPECT_NE(message.find("(did you mean 'lib:304L'?)"), std::string::npos) << message;
  EXPECT_EQ(call({"show"}), 2) << "without a name";
}

TEST_F(MaterialsCommand, tells_of_a_file_that_cannot_be_written) {
  EXPECT_EQ(call({"show", "C45", "--output", (temporary.path() / "nowhere" / "page.html").string()}), 4);
  EXPECT_NE(message.find("page.html"), std::string::npos) << message;
}

TEST_F(MaterialsCommand, is_not_needed_to_read_a_result_later) {
  const std::filesystem::path file = temporary.path() / "block.toml", folder = temporary.path() / "results";
  std::ofstream(file) << R"toml(
[time]
end = "0.2 us"
[domain]
material = "sheet"
outer.rectangle = { from = "0 0 mm", to = "4 2 mm" }
[cloud]
spacing = "0.5 mm"
[materials.sheet]
base = "lib:4340"
density = "7800 kg/m3"
)toml";
  std::vector<std::string> words{"cnem", "run", file.string(), "--output", folder.string(), "--threads", "1"};
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  ::testing::internal::CaptureStdout();
  ::testing::internal::CaptureStderr();
  EXPECT_EQ(command_line(static_cast<int>(argv.size()), argv.data()), 0);
  ::testing::internal::GetCapturedStdout();
  ::testing::internal::GetCapturedStderr();
  const auto text_of = [&](const char* name) {
    std::ifstream stream(folder / name);
    return std::string{std::istreambuf_iterator<char>(stream), {}};
  };
  for (const char* part : {"origin = \"lib:4340; changed by the case: density\"", "A = \"792000000 Pa\"",
                           "Johnson and Cook 1985", "calibration = \"generic\""})
    EXPECT_NE(text_of("case.resolved.toml").find(part), std::string::npos) << part;
  for (const char* part : {"lib:4340; changed by the case: density", "generic: D1, D2, D3, D4, D5: Johnson"})
    EXPECT_NE(text_of("report.html").find(part), std::string::npos) << part;
}

TEST_F(MaterialsCommand, makes_the_committed_reference) {
  std::ifstream stream(CNEM_SOURCE_DIR "/docs/materials.md");
  const std::string committed((std::istreambuf_iterator<char>(stream)), {});
  EXPECT_TRUE(committed == report::materials_reference())
      << "regenerate it: build/cnem materials --markdown > docs/materials.md";
}

} // namespace
} // namespace cnem::app
