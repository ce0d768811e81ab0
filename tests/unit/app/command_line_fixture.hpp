#pragma once
// A small run, called as a user calls the program.
#include "app/command_line.hpp"
#include "tests/shared_cases.hpp"
#include "tests/temporary_folder.hpp"

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <string>
#include <vector>

namespace cnem::app {

inline const std::string block = testing::steel_304l + R"toml(
[time]
end = "2 us"
[domain]
material = "steel"
outer.rectangle = { from = "0 0 mm", to = "4 2 mm" }
[cloud]
spacing = "0.4 mm"
[boundary.base]
pieces = ["bottom"]
symmetry = true
[tools.punch]
rectangle = { from = "-1 2 mm", to = "1.1 4 mm" }
velocity = "0 -30 m/s"
[output]
history_every = "0.1 us"
)toml";

/// A folder with block.toml, and what the program answered to a call last.
class CommandLine : public ::testing::Test {
protected:
  void SetUp() override { std::ofstream(folder / "block.toml") << block; }

  int call(std::vector<std::string> words) {
    words.insert(words.begin(), "cnem");
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    ::testing::internal::CaptureStderr();
    ::testing::internal::CaptureStdout();
    const int code = command_line(static_cast<int>(argv.size()), argv.data());
    printed = ::testing::internal::GetCapturedStdout();
    message = ::testing::internal::GetCapturedStderr();
    return code;
  }
  std::string file() const { return (folder / "block.toml").string(); }
  std::string pulled() const {
    const std::filesystem::path path = folder / "pulled.toml";
    std::ofstream(path) << testing::pulled_block;
    return path.string();
  }
  std::string results() const { return (folder / "results").string(); }

  const cnem::testing::TemporaryFolder temporary{"command_line"};
  const std::filesystem::path& folder = temporary.path();
  std::string message, printed;
};

} // namespace cnem::app
