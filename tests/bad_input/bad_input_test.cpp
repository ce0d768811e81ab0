// The catalogue of wrong cases: every .toml file of this folder begins with what the program must say about
// it.
#include "app/command_line.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <optional>
#include <regex>
#include <sstream>
#include <string>
#include <unistd.h>
#include <vector>

namespace cnem::app {
namespace {

namespace fs = std::filesystem;

const fs::path catalogue = fs::path(CNEM_SOURCE_DIR) / "tests/bad_input";

struct Refusal {
  int exit = 0;
  std::string message; ///< what went to stderr
};

/// Runs the program on a path, in this process, with a fresh folder of results.
Refusal call(const std::string& command, const fs::path& path, const std::vector<std::string>& set = {},
             const std::vector<std::string>& options = {}) {
  const fs::path results = fs::path(testing::TempDir()) / ("bad_input_" + std::to_string(getpid()));
  std::vector<std::string> words{"cnem", command, path.string(), "--output", results.string()};
  for (const std::string& change : set) words.insert(words.end(), {"--set", change});
  words.insert(words.end(), options.begin(), options.end());
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  Refusal refusal;
  refusal.exit = command_line(static_cast<int>(arguments.size()), arguments.data());
  refusal.message = testing::internal::GetCapturedStderr();
  testing::internal::GetCapturedStdout();
  fs::remove_all(results);
  return refusal;
}

void expect_message(const Refusal& refusal, const std::string& text) {
  EXPECT_NE(refusal.message.find(text), std::string::npos) << "no '" << text << "' in:\n" << refusal.message;
}

/// What the comments at the top of a file promise.
struct Promise {
  std::string command = "check";
  std::vector<std::string> set, options, expected;
  int exit = 0;
  std::optional<std::ptrdiff_t> lines; ///< how many there are of the message
};

Promise promise_of(const fs::path& file) {
  Promise promise;
  std::ifstream stream(file);
  const auto after = [](const std::string& line, const std::string& mark, auto&& act) {
    if (line.starts_with(mark)) act(line.substr(mark.size()));
  };
  for (std::string line; std::getline(stream, line) && line.starts_with('#');) {
    after(line, "# command: ", [&](const std::string& text) { promise.command = text; });
    after(line, "# set: ", [&](const std::string& text) { promise.set.push_back(text); });
    after(line, "# options: ", [&](const std::string& text) {
      std::istringstream words(text);
      for (std::string word; words >> word;) promise.options.push_back(word);
    });
    after(line, "# expect exit ", [&](const std::string& text) { promise.exit = std::stoi(text); });
    after(line, "# expect lines ", [&](const std::string& text) { promise.lines = std::stoi(text); });
    after(line, "# expect: ", [&](const std::string& text) { promise.expected.push_back(text); });
  }
  return promise;
}

std::vector<std::string> case_names() {
  std::vector<std::string> names;
  for (const fs::directory_entry& entry : fs::directory_iterator(catalogue))
    if (entry.path().extension() == ".toml") names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

class BadInput : public testing::TestWithParam<std::string> {};

TEST_P(BadInput, is_refused_as_promised) {
  const fs::path file = catalogue / (GetParam() + ".toml");
  const Promise promise = promise_of(file);
  ASSERT_FALSE(promise.expected.empty()) << file << " does not say what is expected";
  const Refusal refusal = call(promise.command, file, promise.set, promise.options);
  EXPECT_EQ(refusal.exit, promise.exit) << refusal.message;
  for (const std::string& text : promise.expected) expect_message(refusal, text);
  const std::ptrdiff_t told = std::count(refusal.message.begin(), refusal.message.end(), '\n');
  EXPECT_EQ(told, promise.lines.value_or(told)) << refusal.message;

  // Whatever is wrong: each line says where, and what was expected; at most three of a kind.
  static const std::regex place(
      R"(^(.*\.toml:\d+:\d+(, from \[cutting\])?|--(set|set-for|methods) .*): .*(expected|not TOML).*)");
  static const std::regex rest(
      R"(^(and \d+ more .*|in run '.*' of the study|in target '.*' of the calibration|in the run of method '.*')$)");
  std::istringstream lines(refusal.message);
  for (std::string line; std::getline(lines, line);)
    EXPECT_TRUE(std::regex_match(line, place) || std::regex_match(line, rest)) << line;
}

INSTANTIATE_TEST_SUITE_P(Catalogue, BadInput, testing::ValuesIn(case_names()),
                         [](const auto& entry) { return entry.param; });

TEST(BadInputFile, there_are_more_than_a_hundred_cases) { EXPECT_GT(case_names().size(), 100U); }

TEST(BadInputFile, is_absent) {
  for (const char* command : {"check", "run"}) {
    const Refusal refusal = call(command, catalogue / "nowhere.toml");
    EXPECT_EQ(refusal.exit, 2);
    expect_message(refusal, "nowhere.toml: no such file, expected a case such as case.toml");
  }
  const Refusal refusal = call("sweep", catalogue / "nowhere.toml");
  EXPECT_EQ(refusal.exit, 2);
  expect_message(refusal, "nowhere.toml: no such file, expected a study such as study.toml");
}

TEST(BadInputFile, is_a_folder_without_a_case) {
  const Refusal refusal = call("check", catalogue / "nodes");
  EXPECT_EQ(refusal.exit, 2);
  expect_message(refusal, "nodes/case.toml: no such file, expected a case such as case.toml");
}

/// A file that a test makes and that goes with it.
struct TemporaryFile {
  explicit TemporaryFile(const std::string& text)
      : path(fs::path(testing::TempDir()) / ("bad_input_" + std::to_string(getpid()) + ".toml")) {
    std::ofstream(path, std::ios::binary) << text;
  }
  ~TemporaryFile() { fs::remove(path); }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  fs::path path;
};

TEST(BadInputFile, is_empty) {
  const TemporaryFile file("");
  const Refusal refusal = call("check", file.path);
  EXPECT_EQ(refusal.exit, 2);
  expect_message(refusal, ".toml:1:1: key 'domain': missing, expected a table [domain]");
}

TEST(BadInputFile, begins_with_a_byte_order_mark_that_does_not_matter) {
  const TemporaryFile file("\xef\xbb\xbfspacing = 1\n");
  const Refusal refusal = call("check", file.path);
  EXPECT_EQ(refusal.exit, 2);
  expect_message(refusal, ".toml:1:1: key 'spacing': unknown key");
}

TEST(BadInputSet, is_no_text) {
  const Refusal refusal = call("check", catalogue / "empty_case.toml", {"title=caf\xe9"});
  EXPECT_EQ(refusal.exit, 2);
  expect_message(refusal, "--set title=caf\xe9: found bytes that are no UTF-8, expected a text");
}

TEST(BadInputFile, holds_zeros) {
  const TemporaryFile file(std::string(100, '\0'));
  const Refusal refusal = call("check", file.path);
  EXPECT_EQ(refusal.exit, 2);
  expect_message(refusal, ".toml:1:1: not TOML");
}

TEST(BadInputFile, has_keys_without_end) {
  std::string text;
  for (int k = 0; k <= 1000000; ++k) text.append("k").append(std::to_string(k)).append("=1\n");
  const TemporaryFile file(text);
  const Refusal refusal = call("check", file.path);
  EXPECT_EQ(refusal.exit, 2);
  expect_message(refusal, ".toml:1000001:9: not TOML: found more than 1000000 keys, expected fewer");
}

TEST(BadInputFile, may_not_be_read) {
  const TemporaryFile file("");
  fs::permissions(file.path, fs::perms::none);
  if (access(file.path.c_str(), R_OK) == 0) GTEST_SKIP() << "this user may read everything";
  const Refusal refusal = call("check", file.path);
  EXPECT_EQ(refusal.exit, 4);
  expect_message(refusal, "cannot be read, expected a readable case file");
}

TEST(BadInputFile, never_ends) {
  const Refusal refusal = call("check", "/dev/zero");
  EXPECT_EQ(refusal.exit, 2);
  expect_message(refusal, "/dev/zero: found more than 268435456 bytes, expected a case file");
}

TEST(BadInputFile, is_a_device_that_cannot_be_read) {
  const Refusal refusal = call("check", "/proc/self/mem");
  EXPECT_EQ(refusal.exit, 4);
  expect_message(refusal, "/proc/self/mem: cannot be read, expected a readable case file");
}

} // namespace
} // namespace cnem::app
