#include "study/page.hpp"
#include "study/sweep.hpp"

#include <algorithm>

namespace cnem::study {

namespace {

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

std::vector<std::string> table_columns(const Study& study, const std::vector<RunRecord>& runs) {
  if (!study.columns.empty()) return study.columns;
  std::vector<std::string> columns{"nodes", "steps", "energy_residual"};
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
    columns.push_back({name, {}});
    for (const RunRecord& run : runs)
      columns.back().value.push_back(run.status ? status_number(*run.status, name) : std::nullopt);
  }
  return csv_table(study, runs, columns);
}

} // namespace cnem::study
