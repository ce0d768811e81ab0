#pragma once
// A calibration in a folder of its own: a pressed block, and curves of single points by the formula itself.
#include "study/calibration.hpp"

#include "core/error.hpp"
#include "input/schema/document.hpp"
#include "results/history_writer.hpp"
#include "results/output_folder.hpp"
#include "tests/temporary_folder.hpp"

#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <fmt/format.h>
#include <fstream>
#include <functional>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace cnem::study {

namespace fs = std::filesystem;
using Json = nlohmann::json;

inline constexpr const char* block = R"toml(
[let]
spacing = "0.2 mm"
[time]
end = "20 us"
[domain]
material = "steel"
outer.rectangle = { from = "0 0 mm", to = "1 1 mm" }
[cloud]
spacing = "spacing"
[materials.steel]
density = "7850 kg/m3"
elastic = { young = "210 GPa", poisson = 0.3 }
plastic = { law = "johnson-cook", A = "250 MPa", B = "500 MPa", n = 0.4, C = 0.01, rate0 = "1 /s", m = 1.0, T0 = "293 K", Tmelt = "1800 K" }
heat = { specific_heat = "460 J/(kg K)", conductivity = "0 W/(m K)" }
[boundary]
left = { pieces = ["left"], symmetry = true }
bottom = { pieces = ["bottom"], symmetry = true }
[initial]
temperature = "293 K"
[tools.punch]
rectangle = { from = "-1 1 mm", to = "3 2 mm" }
velocity = { y = { value = "-12 m/s", ramp = "2 us", smooth = true } }
[output]
history_every = "0.1 us"
fields_every = "0 s"
pictures = "1 ms"
)toml";

inline constexpr const char* experiment =
    "[report.experiment]\nfile = \"press.csv\"\ncut_length = \"20 mm\"\n";

/// Johnson and Cook's stress, MPa, at 293 K.
inline double stress(double strain, double rate, double A, double B, double n, double C) {
  return (A + B * std::pow(strain, n)) * (1.0 + C * std::log(std::max(1.0, rate)));
}

inline std::string constant(const std::string& name, const std::string& start, const std::string& low,
                            const std::string& high, const std::string& scale = "linear") {
  return fmt::format("[parameters.{0}]\nkey = \"materials.steel.plastic.{0}\"\nstart = {1}\nlow = {2}\n"
                     "high = {3}\nscale = \"{4}\"\n",
                     name, start, low, high, scale);
}

inline std::string curve(const std::string& name, double rate) {
  return fmt::format("[targets.{0}]\nfile = \"{0}.csv\"\nstrain = \"plastic\"\nrate = \"{1} /s\"\n"
                     "temperature = \"293 K\"\n",
                     name, rate);
}

class Calibrate : public ::testing::Test {
protected:
  void SetUp() override {
    write("case.toml", std::string(block) + experiment);
    write("press.csv", "stroke[mm];force[kN]\n0;0\n0,1;12\n");
  }

  void write(const std::string& name, const std::string& text) const { std::ofstream(folder / name) << text; }
  /// A measured curve of a single point by the formula itself.
  void write_curve(const std::string& name, double rate, double A, double B, double n, double C) const {
    std::string text = "plastic strain;stress[MPa]\n";
    for (int k = 0; k <= 40; ++k) {
      const double strain = 0.002 + 0.4 * k / 40.0;
      text += fmt::format("{:.5f};{:.4f}\n", strain, stress(strain, rate, A, B, n, C));
    }
    write(name + ".csv", text);
  }
  int run(const std::string& text, const std::string& output = "results") {
    write("fit.toml", "case = \"case.toml\"\n" + text);
    ::testing::internal::CaptureStdout();
    ::testing::internal::CaptureStderr();
    std::exception_ptr problem;
    int code = -1;
    try {
      code =
          calibrate(read_calibration(folder / "fit.toml"),
                    {.output = folder / output, .force = force, .program = program_file, .version = "test"});
    } catch (...) { problem = std::current_exception(); }
    printed = ::testing::internal::GetCapturedStdout();
    message = ::testing::internal::GetCapturedStderr();
    if (problem) std::rethrow_exception(problem);
    return code;
  }
  Json result(const std::string& output = "results") const {
    return Json::parse(results::read_file(folder / output / "calibration.json"));
  }
  /// What a press would measure of the block of 350 MPa + 400 MPa ε̄pⁿ, from a run on a cloud of a spacing.
  void press_block(const std::string& spacing) const {
    write("truth.toml", std::string(block));
    ASSERT_EQ(program({"run", (folder / "truth.toml").string(), "--output", (folder / "truth").string(),
                       "--set", "let.spacing=" + spacing, "--set", "materials.steel.plastic.A=350 MPa",
                       "--set", "materials.steel.plastic.B=400 MPa"}),
              0);
    const results::HistoryTable history = results::read_history(folder / "truth/history.csv");
    std::string press = "stroke[mm],force[kN]\n";
    for (std::size_t k = 0; k < history.rows(); k += 2) {
      const auto at = [&](const char* name) { return history.column[std::size_t(history.find(name))][k]; };
      press += fmt::format("{},{}\n", 1e3 * at("punch.stroke"), -20e-6 * at("punch.force_y"));
    }
    write("press.csv", press);
  }
  /// Runs the program to the end, or until it shall be killed.
  int program(const std::vector<std::string>& words, const std::function<bool()>& kill_when = {}) const {
    const pid_t child = fork();
    if (child == 0) {
      std::vector<char*> arguments{const_cast<char*>(CNEM_PROGRAM)};
      for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
      arguments.push_back(nullptr);
      if (!std::freopen((folder / "log").c_str(), "w", stdout)) _exit(126);
      execv(CNEM_PROGRAM, arguments.data());
      _exit(127);
    }
    int status = 0;
    while (kill_when && waitpid(child, &status, WNOHANG) == 0) {
      if (kill_when()) kill(child, SIGKILL);
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    if (!kill_when) waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  }
  std::size_t runs(const std::string& output) const {
    std::size_t count = 0;
    if (fs::exists(folder / output / "runs"))
      for (const auto& entry : fs::directory_iterator(folder / output / "runs"))
        count += fs::exists(entry.path() / results::files::status);
    return count;
  }

  const cnem::testing::TemporaryFolder temporary{"calibrate"};
  const fs::path& folder = temporary.path();
  std::string printed, message;
  bool force = false;
  fs::path program_file = CNEM_PROGRAM;
};

} // namespace cnem::study
