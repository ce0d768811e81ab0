#include "report/report_tables.hpp"

#include "core/index.hpp"
#include "input/schema/document.hpp"
#include "report/html.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace cnem::report {
namespace {

double wall(const results::RunStatus& status, std::string_view phase) {
  for (const auto& [name, seconds] : status.wall_s)
    if (name == phase) return seconds;
  return 0.0;
}

ReportTable run_table(const results::RunStatus& status) {
  ReportTable table{"Run", {}};
  auto& rows = table.rows;
  rows.emplace_back("Version", status.version);
  rows.emplace_back("Exit code", std::to_string(status.exit));
  rows.emplace_back("Threads", std::to_string(status.threads));
  rows.emplace_back("Nodes", grouped(status.nodes));
  if (status.points > 0) rows.emplace_back("Stress points", grouped(status.points));
  rows.emplace_back("Steps", grouped(status.steps));
  rows.emplace_back("Node-steps", grouped(status.node_steps));
  if (wall(status, "step") > 0.0)
    rows.emplace_back("Node-steps per second of stepping",
                      grouped(std::llround(static_cast<double>(status.node_steps) / wall(status, "step"))));
  if (status.cpu_s > 0.0) rows.emplace_back("CPU time", results::duration_format(status.cpu_s));
  rows.emplace_back("Peak memory", results::bytes_format(static_cast<double>(status.peak_rss_bytes)));
  return table;
}

ReportTable wall_table(const results::RunStatus& status) {
  ReportTable table{"Wall time", {}};
  const double total = wall(status, "total");
  for (const auto& [phase, seconds] : status.wall_s)
    if (seconds > 0.0)
      table.rows.emplace_back(
          words(phase),
          phase == "total" || !(total > 0.0)
              ? results::duration_format(seconds)
              : fmt::format("{}  ({:.1f} %)", results::duration_format(seconds), 100.0 * seconds / total));
  return table;
}

/// The texts of a key that holds one or several.
std::string joined_texts(const input::Value& value) {
  std::string text = value.text;
  for (const input::Value& element : value.elements) text += (text.empty() ? "" : "; ") + element.text;
  return text;
}

const input::Value* value_at(const input::Value& root, const char* table, const char* key) {
  const input::Member* found = root.find(table);
  const input::Member* member = found ? found->value.find(key) : nullptr;
  return member ? &member->value : nullptr;
}

/// What [let] names.
ReportTable variable_table(const input::Value& root) {
  ReportTable table{"Variables", {}};
  if (const input::Member* let = root.find("let"))
    for (const input::Member& variable : let->value.members) {
      const bool text = variable.value.kind == input::Value::Kind::text;
      table.rows.emplace_back(variable.key, text ? variable.value.text : input::toml_text(variable.value));
    }
  return table;
}

/// Which materials come from the library.
ReportTable origin_table(const input::Value& root) {
  ReportTable table{"Materials of the library", {}};
  if (const input::Member* materials = root.find("materials"))
    for (const input::Member& material : materials->value.members)
      if (const input::Member* origin = material.value.find("origin"))
        table.rows.emplace_back(material.key, origin->value.text);
  return table;
}

/// Which earlier run has left a workpiece of milling.
ReportTable workpiece_table(const input::Value& root) {
  ReportTable table{"Workpiece", {}};
  const input::Value* workpiece = value_at(root, "milling", "workpiece");
  if (!workpiece) return table;
  for (const auto& [key, says] : {std::pair{"run", "left by the run in"}, {"content", "checksum of it"}})
    if (const input::Member* member = workpiece->find(key); member && workpiece->find("run"))
      table.rows.emplace_back(says, member->value.text);
  return table;
}

/// Where the constants of damage laws come from.
ReportTable damage_table(const input::Value& root) {
  ReportTable table{"Constants of damage", {}};
  const input::Member* materials = root.find("materials");
  if (!materials) return table;
  for (const input::Member& material : materials->value.members)
    if (const input::Member* damage = material.value.find("damage")) {
      const input::Member* source = damage->value.find("source");
      const input::Member* calibration = damage->value.find("calibration");
      std::string text = source ? joined_texts(source->value) : "generic: the case names no source for them";
      if (calibration && !text.starts_with(calibration->value.text))
        text = calibration->value.text + ": " + text;
      table.rows.emplace_back(material.key, text);
    }
  return table;
}

} // namespace

std::string grouped(std::int64_t count) {
  std::string digits = std::to_string(count);
  for (auto at = std::ssize(digits) - 3; at > (count < 0 ? 1 : 0); at -= 3)
    digits.insert(index_of(at), "\u202f"); // narrow no-break space
  return digits;
}

ReportTable result_table(const results::RunStatus& status, const results::ShownUnits& units) {
  ReportTable table{"Results", {}};
  for (const auto& [name, value] : status.metrics) {
    const bool elsewhere = name.starts_with("cutting.") || name.starts_with("blanking.") ||
                           name.starts_with("springback.") || name.starts_with("experiment.");
    if (elsewhere) continue;
    const bool flag = std::find(status.flags.begin(), status.flags.end(), name) != status.flags.end();
    table.rows.emplace_back(words(name), flag ? (value != 0.0 ? "yes" : "no")
                                              : units.format(value, status.unit_of(name), 6));
  }
  return table;
}

ReportTable energy_table(const results::HistoryTable& history, const results::ShownUnits& units) {
  ReportTable table{"Energies at the end", {}};
  std::string zero;
  for (std::size_t k = 0; k < history.names.size() && history.rows() > 0; ++k) {
    const results::ColumnName column = results::split_column_name(history.names[k]);
    if (!column.name.starts_with("energy.")) continue;
    const std::string term = words(column.name.substr(7));
    double most = 0.0;
    for (const double value : history.column[k])
      if (std::isfinite(value)) most = std::max(most, std::abs(value));
    if (most == 0.0) {
      zero += (zero.empty() ? "" : ", ") + term;
      continue;
    }
    const double last = history.column[k].back();
    std::string text = units.format(last, column.unit);
    if (most > 1.001 * std::abs(last)) text += fmt::format("  (at most {})", units.format(most, column.unit));
    table.rows.emplace_back(term, text);
  }
  if (!zero.empty() && !table.rows.empty()) table.rows.emplace_back("zero all the time", zero);
  return table;
}

std::vector<ReportTable> run_tables(const results::RunStatus& status) {
  std::vector<ReportTable> tables{run_table(status)};
  if (!status.wall_s.empty()) tables.push_back(wall_table(status));
  ReportTable limits{"What limited the step", {}};
  for (const auto& [what, share] : status.step_limits)
    limits.rows.emplace_back(words(what), fmt::format("{:.1f} % of the steps", 100.0 * share));
  if (!limits.rows.empty()) tables.push_back(std::move(limits));
  return tables;
}

CaseWords case_words(const std::string& resolved) {
  const input::Value root = input::parse_document(resolved, "case.resolved.toml");
  CaseWords said;
  if (const input::Member* title = root.find("title")) said.title = title->value.text;
  if (const input::Value* kinematics = value_at(root, "analysis", "kinematics")) {
    if (kinematics->text == "axisymmetric")
      said.kinematics = "axisymmetric: x is the radius, totals of the whole body";
    if (kinematics->text == "three-dimensional") said.kinematics = "three-dimensional";
  }
  if (const input::Value* mechanical = value_at(root, "analysis", "mechanical"))
    said.moves = mechanical->kind != input::Value::Kind::boolean || mechanical->boolean;
  for (ReportTable table :
       {variable_table(root), origin_table(root), damage_table(root), workpiece_table(root)})
    if (!table.rows.empty()) said.tables.push_back(std::move(table));
  return said;
}

} // namespace cnem::report
