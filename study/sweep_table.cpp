#include "core/index.hpp"
#include "study/sweep.hpp"

#include "input/schema/units.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace cnem::study {

namespace {

/// Whether a text is numbers with their unit ("-11 m/s", "-1 5 mm"), as quantities of a case are written.
bool is_quantity(std::string_view text) {
  bool any = false;
  while (!text.empty()) {
    const std::size_t sign = text.front() == '+' ? 1 : 0;
    double number = 0.0;
    const auto [end, error] = std::from_chars(text.data() + sign, text.data() + text.size(), number);
    if (error != std::errc{}) break;
    any = true;
    text.remove_prefix(index_of(end - text.data()));
    text.remove_prefix(std::min(text.find_first_not_of(' '), text.size()));
  }
  if (!any || text.empty()) return any;
  try {
    input::parse_unit(text);
    return true;
  } catch (const input::UnitError&) { return false; }
}

/// A spreadsheet takes a text that begins like a formula for one, and may act on it: an apostrophe keeps it a
/// text.
std::string csv_field(const std::string& text) {
  const bool like_formula = text.find_first_of("=+-@\t\r") == 0 && !is_quantity(text);
  const std::string shown = like_formula ? "'" + text : text;
  if (shown.find_first_of(",\"\r\n") == std::string::npos) return shown;
  std::string quoted = "\"";
  for (const char c : shown) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
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

std::optional<double> status_number(const results::RunStatus& status, const std::string& name) {
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

std::vector<std::string> table_columns(const Study& study, const std::vector<SweepRun>& runs) {
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

std::string sweep_table(const Study& study, const std::vector<SweepRun>& runs) {
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
    add(runs[k].state == SweepRun::State::pending ? "" : std::to_string(runs[k].exit));
    for (const std::string& column : columns) {
      const std::optional<double> value =
          runs[k].status ? status_number(*runs[k].status, column) : std::nullopt;
      add(value && std::isfinite(*value) ? input::format_number(*value) : "");
    }
  }
  return csv + "\n";
}

} // namespace cnem::study
