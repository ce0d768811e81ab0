// The parameter studies of the repository: what they set is understood by their cases.
#include "input/case_reader.hpp"
#include "study/study.hpp"

#include <filesystem>
#include <gtest/gtest.h>

namespace cnem::study {
namespace {

namespace fs = std::filesystem;

TEST(Studies, of_the_repository_have_cases_that_read) {
  int studies = 0;
  for (const fs::directory_entry& entry :
       fs::recursive_directory_iterator(fs::path(CNEM_SOURCE_DIR) / "cases")) {
    if (entry.path().filename() != "study.toml") continue;
    ++studies;
    const Study study = read_study(entry.path());
    for (const StudyRun& run : study.runs)
      EXPECT_NO_THROW(input::read_case_with(study.case_file.string(), run.changes()))
          << entry.path() << ": " << run.name;
  }
  EXPECT_GE(studies, 6);
}

} // namespace
} // namespace cnem::study
