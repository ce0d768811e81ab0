#include "app/sweep.hpp"

#include "io/units.hpp"

#include <algorithm>
#include <cmath>

namespace cnem::app {

namespace {

std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

const char* state_name(SweepRun::State state) {
  switch (state) {
  case SweepRun::State::done:
    return "done";
  case SweepRun::State::failed:
    return "failed";
  case SweepRun::State::pending:
    break;
  }
  return "pending";
}

std::optional<double> named(const std::vector<std::pair<std::string, double>>& list, std::string_view name) {
  const auto found = std::find_if(list.begin(), list.end(), [&](const auto& p) { return p.first == name; });
  return found == list.end() ? std::nullopt : std::optional(found->second);
}

} // namespace

std::optional<double> status_number(const io::RunStatus& status, const std::string& name) {
  if (name.starts_with("metrics.")) return named(status.metrics, name.substr(8));
  if (name.starts_with("wall_s.")) return named(status.wall_s, name.substr(7));
  return named({{"nodes", static_cast<double>(status.nodes)},
                {"steps", static_cast<double>(status.steps)},
                {"node_steps", static_cast<double>(status.node_steps)},
                {"time", status.time},
                {"energy_residual", status.energy_residual},
                {"peak_rss_bytes", static_cast<double>(status.peak_rss_bytes)}},
               name);
}

std::vector<std::string> table_columns(const io::Study& study, const std::vector<SweepRun>& runs) {
  if (!study.columns.empty()) return study.columns;
  std::vector<std::string> columns{"nodes", "steps", "energy_residual"};
  for (const SweepRun& run : runs) {
    if (!run.status) continue;
    for (const auto& metric : run.status->metrics)
      if (const std::string name = "metrics." + metric.first;
          std::find(columns.begin(), columns.end(), name) == columns.end())
        columns.push_back(name);
  }
  return columns;
}

std::string sweep_table(const io::Study& study, const std::vector<SweepRun>& runs) {
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
      const io::Value* value = study.runs[k].find(key);
      add(value ? io::plain_text(*value) : "");
    }
    add(state_name(runs[k].state));
    add(runs[k].state == SweepRun::State::pending ? "" : std::to_string(runs[k].exit));
    for (const std::string& column : columns) {
      const std::optional<double> value =
          runs[k].status ? status_number(*runs[k].status, column) : std::nullopt;
      add(value && std::isfinite(*value) ? io::format_number(*value) : "");
    }
  }
  return csv + "\n";
}

} // namespace cnem::app
