#pragma once
// The folder a run writes to, and how its files are written: never half.
#include <filesystem>
#include <string>
#include <string_view>

namespace cnem::io {

namespace files {
inline constexpr const char* resolved_case = "case.resolved.toml";
inline constexpr const char* history = "history.csv";
inline constexpr const char* fields = "fields.pvd";
inline constexpr const char* fields_folder = "fields";     ///< .vtu files
inline constexpr const char* pictures_folder = "pictures"; ///< .png files and their index.json
inline constexpr const char* lines_folder = "lines";       ///< fields along lines, .csv
inline constexpr const char* checkpoint = "checkpoint.h5";
inline constexpr const char* status = "status.json";
inline constexpr const char* report = "report.html";
} // namespace files

/// Writes `content` beside `path`, flushes it to the disk and renames it over `path`: readers, and whoever
/// looks after a crash, see the old file or the new one. Throws IoError with the path and the system's
/// reason.
void write_atomically(const std::filesystem::path& path, std::string_view content);

/// For writers that need a file name of their own (HDF5): they write to temporary(), commit() renames it over
/// the target. Without commit() the destructor removes the temporary file.
class AtomicFile {
public:
  explicit AtomicFile(std::filesystem::path target);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  const std::filesystem::path& temporary() const { return temporary_; }
  /// Flushes and renames. Throws IoError.
  void commit();

private:
  std::filesystem::path target_, temporary_;
  bool committed_ = false;
};

/// The whole file. Throws IoError.
std::string read_file(const std::filesystem::path& path);

/// Whether `folder` holds files of a run.
bool holds_run(const std::filesystem::path& folder);

/// Makes `folder` ready for a new run: creates it with its parents and checks that files can be written.
/// Throws InputError when it holds a run and `force` is false; with `force` the files that a run makes are
/// removed, and no others. Throws IoError when it cannot be created or written.
void prepare_output_folder(const std::filesystem::path& folder, bool force);

} // namespace cnem::io
