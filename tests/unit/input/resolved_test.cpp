// The resolved case of every case in the repository reads back to itself: what a restart starts from.
#include "input/case_reader.hpp"

#include <filesystem>
#include <gtest/gtest.h>

namespace cnem::input {
namespace {

namespace fs = std::filesystem;

std::string without_first_line(const std::string& text) { return text.substr(text.find('\n') + 1); }

TEST(ResolvedCase, of_every_case_in_the_repository_reads_back_to_itself) {
  int cases = 0;
  for (const fs::directory_entry& entry :
       fs::recursive_directory_iterator(fs::path(CNEM_SOURCE_DIR) / "cases")) {
    const bool beside = entry.path().filename() == "compared.toml" ||
                        (entry.path().parent_path().filename() == "practice" &&
                         entry.path().extension() == ".toml"); // of docs/tutorial.md and docs/practice.md
    if (entry.path().filename() != "case.toml" && !beside) continue;
    ++cases;
    const std::string once = read_case(entry.path().string()).resolved;
    std::string twice;
    ASSERT_NO_THROW(twice = read_case_text(once, "case.resolved.toml").resolved) << entry.path();
    EXPECT_EQ(without_first_line(once), without_first_line(twice)) << entry.path();
  }
  EXPECT_GE(cases, 8);
}

} // namespace
} // namespace cnem::input
