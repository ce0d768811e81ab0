#pragma once
// The folder a run writes to, and how its files are written: never half.
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace cnem::results {

namespace files {
inline constexpr const char* resolved_case = "case.resolved.toml";
inline constexpr const char* history = "history.csv";
inline constexpr const char* adaptation = "adaptation.csv"; ///< a row for every change of the cloud
inline constexpr const char* fields = "fields.pvd";
inline constexpr const char* tool_fields = "tools.pvd";    ///< of tools that conduct
inline constexpr const char* fields_folder = "fields";     ///< .vtu files
inline constexpr const char* pictures_folder = "pictures"; ///< .png files and their index.json
inline constexpr const char* lines_folder = "lines";       ///< fields along lines, .csv
inline constexpr const char* checkpoint = "checkpoint.h5";
inline constexpr const char* refused_checkpoint = "checkpoint.refused"; ///< how names of such files begin
inline constexpr const char* blanking = "blanking.json";
inline constexpr const char* cutting = "cutting.json";
inline constexpr const char* cutting_course = "cutting.csv"; ///< chip and contact over the cut
inline constexpr const char* cutting_folder = "cutting";     ///< tables of a cut, .csv
inline constexpr const char* experiment = "experiment.json"; ///< computed forces beside measured ones
inline constexpr const char* stability = "stability.csv";    ///< limits of a milling cut over speeds
inline constexpr const char* stability_chart = "stability_chart.csv"; ///< spectral radii over speed and depth
inline constexpr const char* stability_places = "stability_places.csv"; ///< limits over speed and place
inline constexpr const char* stability_picture = "stability.svg";       ///< the limits
inline constexpr const char* modes = "modes.csv";                       ///< of parts and shafts
inline constexpr const char* mode_shapes = "modes.vtk";                 ///< of a part
inline constexpr const char* machined_surface = "surface.csv";          ///< of a milling cut
inline constexpr const char* machined_surface_grid = "surface.vtk";     ///< the same in space
inline constexpr const char* spectra = "spectra.csv"; ///< of forces and vibrations of a milling cut
inline constexpr const char* status = "status.json";
inline constexpr const char* report = "report.html";
} // namespace files

/// The file of that name in `folder`; the empty path, which stands for no file, where `folder` is that.
std::filesystem::path file_in(const std::filesystem::path& folder, const char* name);

/// Writes `content` beside `path`, flushes it to the disk and renames it over `path`: readers, and whoever
/// looks after a crash, see the old file or the new one. Throws IoError with the path and the system's
/// reason.
void write_atomically(const std::filesystem::path& path, std::string_view content);

struct FileContent {
  std::filesystem::path path;
  std::string content;
};

/// The same for several files, which wait for the disk together and appear in their order. Throws IoError;
/// the files before the one that failed may have appeared then.
void write_atomically(std::span<const FileContent> files);

/// The two halves of write_atomically, for whoever has something to do between them: the constructor writes
/// beside the target and flushes, commit() renames. Without commit() nothing is left. Both throw IoError.
class AtomicFile {
public:
  AtomicFile(std::filesystem::path target, std::string_view content);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  void commit();

private:
  void discard();
  std::filesystem::path target_, temporary_;
  bool committed_ = false;
};

/// Waits until what was appended to a file is on the disk. Throws IoError.
void flush_file(const std::filesystem::path& path);

/// The whole file. Throws IoError.
std::string read_file(const std::filesystem::path& path);

/// Whether `folder` holds files of a run.
bool holds_run(const std::filesystem::path& folder);

/// Removes the files that a run makes, and no others, but for the resolved case and checkpoints that were set
/// aside. Throws IoError.
void clear_results(const std::filesystem::path& folder);

/// Removes what a killed run left half-written.
void clear_leftovers(const std::filesystem::path& folder);

/// Makes `folder` ready for a new run: creates it with its parents and checks that files can be written.
/// Throws InputError when it holds a run and `force` is false; with `force` the files that a run makes are
/// removed, and no others; not where there are only such as may be somebody else's pictures. Throws IoError
/// when it cannot be created or written.
void prepare_output_folder(const std::filesystem::path& folder, bool force);

/// Throws IoError when no file can be written in the folder.
void check_writable(const std::filesystem::path& folder);

} // namespace cnem::results
