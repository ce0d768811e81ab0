#include "study/page.hpp"
#include "study/sweep.hpp"

#include "input/schema/units.hpp"

#include <algorithm>
#include <cmath>

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
  const std::vector<std::string> columns = table_columns(study, runs);
  std::string csv = "run";
  const auto add = [&](const std::string& text) {
    csv += ',';
    csv += csv_field(text);
  };
  for (const std::string& key : study.keys) add(key);
  csv += ",state,exit";
  for (const std::string& column : columns) add(column);
  for (std::size_t k = 0; k < runs.size(); ++k) {
    csv += '\n';
    csv += csv_field(study.runs[k].name);
    for (const std::string& key : study.keys) {
      const input::Value* value = study.runs[k].find(key);
      add(value ? plain_text(*value) : "");
    }
    add(state_name(runs[k].state));
    add(runs[k].state == RunRecord::State::pending ? "" : std::to_string(runs[k].exit));
    for (const std::string& column : columns) {
      const std::optional<double> value =
          runs[k].status ? status_number(*runs[k].status, column) : std::nullopt;
      add(value && std::isfinite(*value) ? input::format_number(*value) : "");
    }
  }
  return csv + "\n";
}

} // namespace cnem::study
