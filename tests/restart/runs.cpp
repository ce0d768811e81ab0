#include "tests/restart/runs.hpp"

#include "results/output_folder.hpp"
#include "results/status.hpp"

#include <fmt/format.h>
#include <set>

namespace cnem::app {

namespace fs = std::filesystem;

namespace {

std::set<std::string> files_of(const fs::path& folder) {
  std::set<std::string> names;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) names.insert(fs::relative(entry.path(), folder).string());
  return names;
}

/// Files that hold when, how fast or where a run was made.
bool is_result(const std::string& file) {
  return !file.starts_with("checkpoint") && file != results::files::status &&
         file != results::files::report && file != results::files::resolved_case;
}

std::string outcome(const fs::path& folder) {
  const results::RunStatus status = results::read_status(folder);
  std::string text =
      fmt::format("exit {} steps {} nodes {} node_steps {} time {} residual {}", status.exit, status.steps,
                  status.nodes, status.node_steps, status.time, status.energy_residual);
  for (const auto& [name, value] : status.metrics) text += fmt::format(" {} {}", name, value);
  for (const auto& [name, value] : status.step_limits) text += fmt::format(" {} {}", name, value);
  return text;
}

} // namespace

std::string difference(const fs::path& a, const fs::path& b) {
  std::string text;
  for (const auto& [from, to] : {std::pair(a, b), std::pair(b, a)})
    for (const std::string& file : files_of(from))
      if (is_result(file) && !fs::exists(to / file)) text += fmt::format("{} lacks {}\n", to.string(), file);
  for (const std::string& file : files_of(a))
    if (is_result(file) && fs::exists(b / file) &&
        results::read_file(a / file) != results::read_file(b / file))
      text += fmt::format("{} differs\n", file);
  if (outcome(a) != outcome(b)) text += fmt::format("{}\n{}\n", outcome(a), outcome(b));
  return text;
}

} // namespace cnem::app
