#pragma once
// status.json: how a run ended, for programs.
#include <cstdint>
#include <filesystem>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace cnem::results {

/// Where and how a run left the range in which it means anything.
struct PostMortem {
  std::int64_t step = 0;
  double time = 0.0; ///< s
  int node = -1;
  double x = std::numeric_limits<double>::quiet_NaN(); ///< m
  double y = std::numeric_limits<double>::quiet_NaN(); ///< m
  double z = std::numeric_limits<double>::quiet_NaN(); ///< m; in the plane none
  std::string field;
  std::string text;
  std::vector<std::string> causes; ///< likely ones, in plain words
  std::string last_good;           ///< the last good state on disk
  std::string picture;             ///< file in the folder of pictures: the surroundings; may be empty
};

/// Numbers that are not finite are written as null and read back as not-a-number.
struct RunStatus {
  int exit = 0;
  std::string reason;
  std::string version;
  std::string case_name;
  double time = 0.0; ///< s, reached
  std::int64_t steps = 0;
  std::int64_t nodes = 0;
  std::int64_t points = 0; ///< that carry stress
  std::int64_t node_steps = 0;
  int threads = 1;
  std::vector<std::pair<std::string, double>> wall_s; ///< "total", "step", "rebuild", "output", … in s
  double cpu_s = 0.0;                                 ///< s, of processors, by all threads
  std::uint64_t peak_rss_bytes = 0;
  double energy_residual = std::numeric_limits<double>::quiet_NaN(); ///< –
  std::vector<std::pair<std::string, double>> metrics; ///< "K_I.right" becomes {"K_I": {"right": …}}
  std::map<std::string, std::string> metric_units;     ///< SI, of metrics that have one
  std::vector<std::string> flags;                      ///< names of metrics that are true or false, 1 or 0
  std::vector<std::pair<std::string, double>> step_limits; ///< what limited the step → fraction of the steps
  std::vector<std::string> warnings;
  std::optional<PostMortem> post_mortem;

  /// A metric by its name with its unit, as columns of histories have it: "peak_force.punch[N/m]".
  void add_metric(std::string_view column, double value);
  /// The value of a metric by its name, if there is one.
  std::optional<double> metric(std::string_view name) const;
  /// The unit of a metric; "" for a number.
  std::string unit_of(const std::string& metric) const;
};

/// The JSON text of a status.
std::string status_json(const RunStatus& status);

/// Written atomically to `folder`/status.json. Throws IoError.
void write_status(const std::filesystem::path& folder, const RunStatus& status);

/// Throws IoError when the file is absent or not a status.
RunStatus read_status(const std::filesystem::path& folder);

/// Largest memory this process has held, bytes.
std::uint64_t peak_rss_bytes();

} // namespace cnem::results
