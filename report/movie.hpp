#pragma once
// A film of a run: one field over all times of fields.pvd, with one range of colours and one view.
#include <filesystem>
#include <optional>
#include <string>

namespace cnem::report {

struct MovieOptions {
  std::filesystem::path folder; ///< of results
  std::string field;            ///< "": the first of output.picture_fields
  std::string window;           ///< of output.windows; "": the whole
  std::filesystem::path output; ///< ends in .gif, .webp or .mp4; "": FIELD.gif in the folder
  double frames_per_second = 10.0;
  int width = 800;                ///< px
  std::optional<double> from, to; ///< s
  bool mirror = false;            ///< even where the case does not ask for it
};

/// Returns the film's path. Throws InputError for what the run has not, IoError.
std::filesystem::path make_movie(const MovieOptions& options);

} // namespace cnem::report
