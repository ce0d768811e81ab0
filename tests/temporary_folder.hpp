#pragma once
// A folder for the files of one test.
#include <filesystem>
#include <string>
#include <unistd.h>

namespace cnem::testing {

/// Made empty, and gone with the object; its name is that of the test and of the process.
class TemporaryFolder {
public:
  explicit TemporaryFolder(const std::string& test)
      : path_(std::filesystem::temp_directory_path() / ("cnem_" + test + "_" + std::to_string(::getpid()))) {
    std::filesystem::remove_all(path_);
    std::filesystem::create_directories(path_);
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

private:
  std::filesystem::path path_;
};

} // namespace cnem::testing
