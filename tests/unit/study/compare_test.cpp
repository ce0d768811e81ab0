// A comparison of methods as a user calls it: runs as `cnem run` makes them, one scale for all pictures, what
// a method refuses, failures, going on after a stop, wrong usage.
#include "study/compare.hpp"

#include "core/error.hpp"
#include "results/output_folder.hpp"
#include "tests/temporary_folder.hpp"

#include <cstdlib>
#include <fmt/format.h>
#include <fstream>
#include <gtest/gtest.h>
#include <png.h>
#include <sys/wait.h>

namespace cnem::study {
namespace {

namespace fs = std::filesystem;

constexpr const char* upsetting = R"toml(
title = "Upsetting"
[analysis]
thermal = false
[time]
end = "4 us"
[domain]
material = "metal"
outer.rectangle = { from = "0 0 mm", to = "4 2 mm" }
[cloud]
spacing = "0.5 mm"
[materials.metal]
density = "8930 kg/m3"
elastic = { young = "117 GPa", poisson = 0.35 }
plastic = { law = "linear", yield = "100 MPa", hardening = "100 MPa" }
[boundary.base]
pieces = ["bottom"]
symmetry = true
[tools.punch]
start = "-1 2 mm"
path = [{ to = "5 2 mm" }, { to = "5 3 mm" }, { to = "-1 3 mm" }]
velocity = "0 -20 m/s"
[method]
lagrangian = "total"
[output]
fields_every = "2 us"
pictures = "2 4 us"
picture_fields = ["plastic_strain", "pressure"]
[output.probes.top]
at = "2 2 mm"
fields = ["displacement_y"]
)toml";

std::string decoded(std::string_view base64) {
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  std::uint32_t bits = 0;
  int count = 0;
  for (const char c : base64) {
    if (c == '=') break;
    bits = bits << 6 | static_cast<std::uint32_t>(digits.find(c));
    if ((count += 6) < 8) continue;
    count -= 8;
    bytes += static_cast<char>(bits >> count & 0xFFU);
  }
  return bytes;
}

/// What stands right of the plot: the colour bar with its numbers.
std::string colour_bar(const std::string& png) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  EXPECT_TRUE(png_image_begin_read_from_memory(&image, png.data(), png.size())) << image.message;
  image.format = PNG_FORMAT_RGB;
  std::vector<png_byte> pixels(PNG_IMAGE_SIZE(image));
  EXPECT_TRUE(png_image_finish_read(&image, nullptr, pixels.data(), 0, nullptr)) << image.message;
  constexpr std::size_t bar = 180; // px
  std::string right;
  for (std::size_t y = 0; y < image.height; ++y)
    right.append(reinterpret_cast<const char*>(&pixels[3 * ((y + 1) * image.width - bar)]), 3 * bar);
  return right;
}

class Compare : public ::testing::Test {
protected:
  void SetUp() override { write(upsetting); }
  void write(const std::string& text) const { std::ofstream(file()) << text; }
  static std::string periodic() {
    std::string text = upsetting;
    return text.replace(text.find("\"total\""), 7, "\"periodic\"");
  }
  /// Which triangles refuse.
  static std::string exchanging() {
    const std::string table = "[method]\n";
    std::string text = periodic();
    return text.insert(text.find(table) + table.size(), "pressure_exchange = 0.3\n");
  }
  fs::path file() const { return folder / "upsetting.toml"; }
  fs::path out() const { return folder / "results"; }

  Comparison comparison(const std::string& methods,
                        std::vector<std::pair<std::string, std::string>> set_for = {}) const {
    return {.case_file = file(), .methods = methods, .set = {}, .set_for = std::move(set_for), .threads = 1};
  }
  int run(const Comparison& input, bool force = false) {
    ::testing::internal::CaptureStdout();
    ::testing::internal::CaptureStderr();
    std::exception_ptr problem;
    int code = -1;
    try {
      code = compare(input, {.output = out(), .force = force, .program = CNEM_PROGRAM, .version = "test"});
    } catch (...) { problem = std::current_exception(); }
    printed = ::testing::internal::GetCapturedStdout();
    message = ::testing::internal::GetCapturedStderr();
    if (problem) std::rethrow_exception(problem);
    return code;
  }
  std::string refusal(const Comparison& input) {
    try {
      run(input);
    } catch (const InputError& error) { return error.what(); }
    return "accepted";
  }
  int shell(const std::string& command) const {
    const int status = std::system((command + " > /dev/null 2>&1").c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  /// A run of its own, and its history.
  std::string history_of(const std::string& method, const std::string& options = "") const {
    EXPECT_EQ(shell(fmt::format("'{}' run {} --output {} --force --set method.name={} {}", CNEM_PROGRAM,
                                file().string(), (folder / "alone").string(), method, options)),
              0);
    return results::read_file(folder / "alone" / "history.csv");
  }
  std::string text(const std::string& name) const { return results::read_file(out() / name); }
  void expect_parts(const std::string& all, const std::vector<std::string>& parts) {
    for (const std::string& part : parts)
      EXPECT_NE(all.find(part), std::string::npos) << part << "\nin " << all.substr(0, 4000);
  }
  struct Shown {
    std::string what, png;
  };
  std::vector<Shown> pictures() const {
    const std::string html = text("compare.html"), data = "src=\"data:image/png;base64,";
    std::vector<Shown> list;
    for (std::size_t at = html.find(data); at != std::string::npos; at = html.find(data, at)) {
      const std::size_t alt = html.rfind("alt=\"", at) + 5;
      std::string what = html.substr(alt, html.find('"', alt) - alt);
      at += data.size();
      if (what.find(" at ") == std::string::npos) continue;
      list.push_back({std::move(what), decoded(std::string_view(html).substr(at, html.find('"', at) - at))});
    }
    return list;
  }

  const cnem::testing::TemporaryFolder temporary{"compare"};
  const fs::path& folder = temporary.path();
  std::string printed, message;
};

TEST_F(Compare, runs_are_those_of_cnem_run_and_stand_side_by_side) {
  ASSERT_EQ(run(comparison("cnem, fe-triangles, sph")), 0) << printed << message;
  for (const char* method : {"cnem", "fe-triangles", "sph"}) {
    for (const char* name : {"status.json", "history.csv", "report.html", "pictures/pressure_001.png"})
      EXPECT_TRUE(fs::exists(out() / method / name)) << method << ' ' << name;
    EXPECT_EQ(text(std::string(method) + "/history.csv"), history_of(method, "--threads 2"));
  }
  const std::string table = text("compare.csv");
  EXPECT_TRUE(
      table.starts_with("run,state,exit,nodes,points,steps,time[s],mean_step[s],wall[s],cpu[s],cost[ns],"
                        "energy_residual,largest_force[N/m],work[J/m],"))
      << table;
  expect_parts(table, {"\ncnem,done,0,", "\nfe-triangles,done,0,", "\nsph,done,0,"});
  const std::string report = text("compare.html");
  expect_parts(report, {"3 of 3 methods done", "Upsetting", "href=\"fe-triangles/report.html\"",
                        "Force of punch against stroke", "Largest force of punch", "Stress points",
                        "probe top displacement y at the end"});
  EXPECT_EQ(report.find("http"), std::string::npos) << "it needs nothing from elsewhere";
  EXPECT_EQ(pictures().size(), 12U) << "two fields at two times";

  const auto written = fs::last_write_time(out() / "sph" / "status.json");
  ASSERT_EQ(run(comparison("cnem,fe-triangles,sph")), 0);
  expect_parts(printed, {"3 done before, 0 to do"});
  EXPECT_EQ(fs::last_write_time(out() / "sph" / "status.json"), written);
  ASSERT_EQ(run(comparison("cnem,fe-triangles,sph"), true), 0);
  expect_parts(printed, {"0 done before, 3 to do"});
}

TEST_F(Compare, pictures_of_a_row_have_one_scale_of_colours) {
  // A faster punch: more strain.
  ASSERT_EQ(run(comparison("cnem,sph", {{"sph", "tools.punch.velocity=\"0 -60 m/s\""}})), 0) << message;
  const std::vector<Shown> all = pictures();
  ASSERT_EQ(all.size(), 8U);
  for (std::size_t row = 0; row < 4; row += 2) { // of the strain: no value is beyond its scale
    EXPECT_EQ(all[row].what.substr(0, 32), "equivalent plastic strain of cne") << all[row].what;
    EXPECT_EQ(colour_bar(all[row].png), colour_bar(all[row + 1].png)) << all[row].what;
  }
  const std::string own = results::read_file(out() / "cnem" / "pictures" / "plastic_strain_001.png");
  EXPECT_NE(colour_bar(all[2].png), colour_bar(own)) << "the scale of the run alone";
  expect_parts(text("compare.csv"), {"run,tools.punch.velocity,state,", "\nsph,0 -60 m/s,done,0,"});
}

TEST_F(Compare, references_are_renewed_by_all_methods_of_the_plane) {
  write(periodic());
  ASSERT_EQ(run(comparison("cnem,fe-triangles,sph", {{"cnem", "method.rereference.every=20"},
                                                     {"fe-triangles", "method.rereference.every=20"},
                                                     {"sph", "method.rereference.every=20"}})),
            0)
      << message;
  for (const char* method : {"cnem", "fe-triangles", "sph"}) {
    const results::RunStatus status = results::read_status(out() / method);
    const auto references = std::find_if(status.metrics.begin(), status.metrics.end(),
                                         [](const auto& metric) { return metric.first == "references"; });
    ASSERT_NE(references, status.metrics.end());
    EXPECT_GT(references->second, 2.0) << method;
  }
}

TEST_F(Compare, a_method_that_refuses_the_case_is_told_and_stops_no_other) {
  write(exchanging());
  EXPECT_EQ(run(comparison("cnem,fe-triangles")), 2) << printed;
  expect_parts(message, {"refused: fe-triangles: ", "upsetting.toml:24:", "one stress point per node",
                         "--set-for fe-triangles KEY=VALUE"});
  expect_parts(printed, {"1 refused", "cnem: done"});
  expect_parts(text("compare.csv"), {"\ncnem,done,0,", "\nfe-triangles,refused,2,"});
  expect_parts(text("compare.html"), {"1 of 2 methods done, 1 refused", "one stress point per node"});
  EXPECT_FALSE(fs::exists(out() / "fe-triangles"));

  ASSERT_EQ(run(comparison("cnem,fe-triangles", {{"fe-triangles", "method.pressure_exchange=0"}})), 0)
      << message;
  expect_parts(printed, {"1 done before, 1 to do", "fe-triangles: done"});
  expect_parts(text("compare.html"), {"as in the case", "<td>0</td>"});
}

TEST_F(Compare, what_all_methods_refuse_or_is_wrong_is_refused_before_anything_is_written) {
  write(exchanging());
  expect_parts(refusal(comparison("fe-triangles")), {"upsetting.toml:24:", "one stress point per node"});
  write(upsetting);
  expect_parts(
      refusal(comparison("cnem,sph", {{"sph", "cloud.spacng=1"}})),
      {"--set-for sph cloud.spacng=1", "did you mean 'cloud.spacing'?", "in the run of method 'sph'"});
  expect_parts(refusal(comparison("cnem,fe-tetrahedra")), {"--methods cnem,fe-tetrahedra", "fe-triangles"});
  expect_parts(refusal(comparison("cnem,fe-triangle")),
               {"--methods cnem,fe-triangle", "found 'fe-triangle'", "did you mean 'fe-triangles'?"});
  expect_parts(refusal(comparison("cnem,sph,cnem")), {"found 'cnem' twice"});
  expect_parts(refusal(comparison("cnem,")), {"found ''"});
  expect_parts(refusal(comparison("cnem,sph", {{"spf", "time.end=\"1 us\""}})),
               {"found method 'spf'", "did you mean 'sph'?"});
  expect_parts(refusal(comparison("cnem,sph", {{"sph", "method.name=cnem"}})), {"expected another key"});
  EXPECT_FALSE(fs::exists(out()));
}

TEST_F(Compare, a_method_that_fails_is_shown_and_loses_no_other) {
  const Comparison input = comparison("sph,cnem", {{"sph", "time.step.fixed=\"0.4 us\""}});
  EXPECT_EQ(run(input), 3) << printed;
  expect_parts(message, {"failed: sph: ", "exit code 3"});
  expect_parts(text("compare.csv"), {"\nsph,0.4 us,failed,3,54,54,", "\ncnem,,done,0,"});
  expect_parts(text("compare.html"),
               {"1 of 2 methods done, 1 failed", ">diverged<", "ended at t = ", "sph failed: "});
  EXPECT_EQ(run(input), 3) << "it is tried again";
  expect_parts(printed, {"1 done before, 1 to do"});
}

TEST_F(Compare, a_comparison_that_is_terminated_goes_on_with_the_same_bits) {
  const std::string fine = "cloud.spacing=0.05 mm", longer = "time.end=12 us";
  const std::string command = fmt::format(
      "'{}' compare {} --methods cnem,sph --threads 1 --set-for sph '{}' --set-for sph '{}' --output {} "
      "> /dev/null 2>&1 & comparison=$!; tries=0; until [ -e {} ] || [ $tries -gt 400 ]; do sleep "
      "0.05; tries=$((tries + 1)); done; kill -TERM $comparison; wait $comparison",
      CNEM_PROGRAM, file().string(), fine, longer, out().string(),
      (out() / "sph" / "checkpoint.h5").string());
  ASSERT_EQ(shell(command), 5);
  expect_parts(text("compare.csv"), {"\ncnem,,,done,0,", "\nsph,0.05 mm,12 us,pending,,"});
  ASSERT_EQ(run(comparison("cnem,sph", {{"sph", fine}, {"sph", longer}})), 0) << message;
  expect_parts(printed, {"1 done before, 1 to do", "1 from the last checkpoint"});
  EXPECT_EQ(text("sph/history.csv"), history_of("sph", fmt::format("--set '{}' --set '{}'", fine, longer)));
}

TEST_F(Compare, folders_that_hold_something_else_are_left_alone) {
  history_of("sph");
  fs::create_directories(out());
  fs::rename(folder / "alone", out() / "sph");
  expect_parts(refusal(comparison("cnem,sph")), {"holds a run that no comparison has made", "--force"});
  EXPECT_EQ(run(comparison("cnem,sph"), true), 0) << message;
  std::ofstream(folder / "study.toml") << "case = \"upsetting.toml\"\n[[run]]\nname = \"a\"\n";
  EXPECT_EQ(shell(fmt::format("'{}' sweep {} --output {}", CNEM_PROGRAM, folder.string(), out().string())),
            2);
  std::ofstream(out() / "manifest.json") << "{";
  EXPECT_THROW(run(comparison("cnem,sph")), IoError);
  std::ofstream(out() / "status.json") << "{}";
  expect_parts(refusal(comparison("cnem,sph")), {"holds a single run", "--output"});
}

TEST_F(Compare, wrong_usage_exits_with_2_and_a_folder_that_cannot_be_made_with_4) {
  const std::string program = fmt::format("'{}' compare ", CNEM_PROGRAM), input = file().string();
  EXPECT_EQ(shell(program + input), 2) << "no methods";
  EXPECT_EQ(shell(program + (folder / "absent.toml").string() + " --methods cnem"), 2);
  EXPECT_EQ(shell(program + input + " --methods cnem --threads 0"), 2);
  EXPECT_EQ(shell(program + input + " --methods cnem --set-for cnem"), 2);
  EXPECT_EQ(shell(program + input + " --methods cnem --output " + (file() / "below").string()), 4);
}

} // namespace
} // namespace cnem::study
