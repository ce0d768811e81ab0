#include "results/fields.hpp"
#include "study/page.hpp"
#include "study/sweep.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>

namespace cnem::study {

namespace {

constexpr std::array<const char*, 5> zones{"rollover", "burnish", "broken", "fracture", "burr"};

std::optional<double> named(const std::vector<std::pair<std::string, double>>& list, std::string_view name) {
  const auto found = std::find_if(list.begin(), list.end(), [&](const auto& p) { return p.first == name; });
  return found == list.end() ? std::nullopt : std::optional(found->second);
}

} // namespace

std::optional<double> status_number(const results::RunStatus& status, const std::string& name) {
  if (name.starts_with("metrics.")) return named(status.metrics, name.substr(8));
  if (name.starts_with("wall_s.")) return named(status.wall_s, name.substr(7));
  return named({{"nodes", static_cast<double>(status.nodes)},
                {"points", static_cast<double>(status.points)},
                {"steps", static_cast<double>(status.steps)},
                {"node_steps", static_cast<double>(status.node_steps)},
                {"time", status.time},
                {"energy_residual", status.energy_residual},
                {"cpu_s", status.cpu_s},
                {"peak_rss_bytes", static_cast<double>(status.peak_rss_bytes)}},
               name);
}

std::string column_unit(const std::vector<RunRecord>& runs, const std::string& name) {
  if (name == "time" || name == "cpu_s" || name.starts_with("wall_s.")) return "s";
  if (!name.starts_with("metrics.")) return "";
  for (const RunRecord& run : runs)
    if (const std::string unit = run.status ? run.status->unit_of(name.substr(8)) : ""; !unit.empty())
      return unit;
  return "";
}

std::vector<std::string> cut_columns(const std::vector<RunRecord>& runs) {
  std::vector<std::string> columns;
  const auto add = [&](const std::string& metric) {
    if (const std::string name = "metrics." + metric;
        std::find(columns.begin(), columns.end(), name) == columns.end())
      columns.push_back(name);
  };
  const auto asked_for = [](const RunRecord& run, std::string_view metric) {
    for (const char* of_punch : {"largest_force", "stroke_at_largest_force", "work"})
      if (metric == fmt::format("blanking.{}.{}", of_punch, run.punch)) return true;
    const bool of_cut = metric.starts_with("blanking.");
    return of_cut && std::any_of(zones.begin(), zones.end(), [&](const char* zone) {
             return metric.ends_with(fmt::format(".{}", zone));
           });
  };
  for (const RunRecord& run : runs)
    if (run.status && !run.punch.empty())
      for (const auto& [name, value] : run.status->metrics)
        if (asked_for(run, name)) add(name);
  std::erase_if(columns, [&](const std::string& column) { // metal that is broken is closed in few cuts
    return column.ends_with(".broken") && std::none_of(runs.begin(), runs.end(), [&](const RunRecord& run) {
             return run.status && status_number(*run.status, column).value_or(0.0) > 0.0;
           });
  });
  return columns;
}

std::vector<std::string> table_columns(const Study& study, const std::vector<RunRecord>& runs) {
  if (!study.columns.empty()) return study.columns;
  std::vector<std::string> columns{"nodes", "steps", "energy_residual"};
  if (const std::vector<std::string> cut = cut_columns(runs); !cut.empty()) {
    columns.insert(columns.end(), cut.begin(), cut.end());
    return columns;
  }
  for (const RunRecord& run : runs) {
    if (!run.status) continue;
    for (const auto& metric : run.status->metrics)
      if (const std::string name = "metrics." + metric.first;
          std::find(columns.begin(), columns.end(), name) == columns.end())
        columns.push_back(name);
  }
  return columns;
}

std::string sweep_table(const Study& study, const std::vector<RunRecord>& runs) {
  std::vector<NumberColumn> columns;
  for (const std::string& name : table_columns(study, runs)) {
    columns.push_back({results::with_unit(name, column_unit(runs, name)), {}});
    for (const RunRecord& run : runs)
      columns.back().value.push_back(run.status ? status_number(*run.status, name) : std::nullopt);
  }
  return csv_table(study, runs, columns);
}

} // namespace cnem::study
