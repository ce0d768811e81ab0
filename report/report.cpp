#include "report/report.hpp"
#include "core/index.hpp"

#include "input/schema/document.hpp"
#include "report/blanking_page.hpp"
#include "report/html.hpp"
#include "report/picture_album.hpp"
#include "results/output_folder.hpp"
#include "results/si_format.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace cnem::report {
namespace fs = std::filesystem;
namespace {

std::string grouped(std::int64_t count) {
  std::string digits = std::to_string(count);
  for (auto at = std::ssize(digits) - 3; at > (count < 0 ? 1 : 0); at -= 3)
    digits.insert(index_of(at), "\u202f"); // narrow no-break space
  return digits;
}

double wall(const results::RunStatus& status, std::string_view phase) {
  for (const auto& [name, seconds] : status.wall_s)
    if (name == phase) return seconds;
  return 0.0;
}

std::string verdict(const results::RunStatus& status) {
  const char* how = status.exit == 0   ? "Finished"
                    : status.exit == 3 ? "Diverged"
                    : status.exit == 5 ? "Stopped, can be resumed"
                                       : "Failed";
  return status.reason.empty() ? how : fmt::format("{}: {}", how, status.reason);
}

double largest(const results::HistoryTable& history, int column) {
  double most = -INFINITY;
  for (const double value : history.column[index_of(column)])
    if (std::isfinite(value)) most = std::max(most, value);
  return most;
}

void collect_figures(ReportData& report, const results::RunStatus& status,
                     const results::HistoryTable* history) {
  auto& figures = report.figures;
  if (std::isfinite(status.time)) figures.emplace_back("Simulated", results::si_format(status.time, "s"));
  figures.emplace_back("Nodes", grouped(status.nodes));
  figures.emplace_back("Steps", grouped(status.steps));
  if (wall(status, "total") > 0.0)
    figures.emplace_back("Wall time", results::duration_format(wall(status, "total")));
  if (std::isfinite(status.energy_residual))
    figures.emplace_back("Energy residual", results::number_format(100.0 * status.energy_residual, 2) + " %");
  if (!history || history->rows() == 0) return;
  for (int k = 0; k < static_cast<int>(history->names.size()); ++k) {
    const results::ColumnName column = results::split_column_name(history->names[index_of(k)]);
    if (!column.name.starts_with("max.") || !std::isfinite(largest(*history, k))) continue;
    figures.emplace_back("Largest " + words(column.name.substr(4)),
                         results::si_format(largest(*history, k), column.unit));
  }
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

/// The texts of a key that holds one or several.
std::string joined_texts(const input::Value& value) {
  std::string text = value.text;
  for (const input::Value& element : value.elements) text += (text.empty() ? "" : "; ") + element.text;
  return text;
}

/// What forces and lengths are of, where they are not per thickness, read from the resolved case.
std::string kinematics_words(const std::string& case_text) {
  const input::Value root = input::parse_document(case_text, "case.resolved.toml");
  const input::Member* analysis = root.find("analysis");
  const input::Member* kinematics = analysis ? analysis->value.find("kinematics") : nullptr;
  if (!kinematics) return "";
  if (kinematics->value.text == "axisymmetric")
    return " · axisymmetric: x is the radius, totals of the whole body";
  return kinematics->value.text == "three-dimensional" ? " · three-dimensional" : "";
}

/// What [let] names, read from the resolved case.
std::optional<ReportTable> variable_table(const std::string& case_text) {
  const input::Value root = input::parse_document(case_text, "case.resolved.toml");
  const input::Member* let = root.find("let");
  if (!let || let->value.members.empty()) return {};
  ReportTable table{"Variables", {}};
  for (const input::Member& variable : let->value.members) {
    const bool text = variable.value.kind == input::Value::Kind::text;
    table.rows.emplace_back(variable.key, text ? variable.value.text : input::toml_text(variable.value));
  }
  return table;
}

/// Which materials come from the library, read from the resolved case.
std::optional<ReportTable> origin_table(const std::string& case_text) {
  const input::Value root = input::parse_document(case_text, "case.resolved.toml");
  const input::Member* materials = root.find("materials");
  if (!materials) return {};
  ReportTable table{"Materials of the library", {}};
  for (const input::Member& material : materials->value.members)
    if (const input::Member* origin = material.value.find("origin"))
      table.rows.emplace_back(material.key, origin->value.text);
  if (table.rows.empty()) return {};
  return table;
}

/// Where the constants of damage laws come from, read from the resolved case.
std::optional<ReportTable> damage_table(const std::string& case_text) {
  const input::Value root = input::parse_document(case_text, "case.resolved.toml");
  const input::Member* materials = root.find("materials");
  if (!materials) return {};
  ReportTable table{"Constants of damage", {}};
  for (const input::Member& material : materials->value.members)
    if (const input::Member* damage = material.value.find("damage")) {
      const input::Member* source = damage->value.find("source");
      const input::Member* calibration = damage->value.find("calibration");
      std::string text = source ? joined_texts(source->value) : "generic: the case names no source for them";
      if (calibration && !text.starts_with(calibration->value.text))
        text = calibration->value.text + ": " + text;
      table.rows.emplace_back(material.key, text);
    }
  if (table.rows.empty()) return {};
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

} // namespace

ReportData collect_report(const fs::path& folder) {
  return collect_report(folder, results::read_status(folder));
}

ReportData collect_report(const fs::path& folder, const results::RunStatus& status) {
  ReportData report;
  report.title = status.case_name.empty() ? fs::absolute(folder).lexically_normal().filename().string()
                                          : status.case_name;
  report.subtitle = "cnem " + status.version;
  report.failed = status.exit != 0 && status.exit != 5;
  report.verdict = verdict(status);
  report.warnings = status.warnings;
  report.post_mortem = status.post_mortem;

  std::optional<results::HistoryTable> history;
  if (fs::exists(folder / results::files::history))
    history = results::read_history(folder / results::files::history);
  collect_figures(report, status, history ? &*history : nullptr);
  if (history) report.charts = history_charts(*history);

  report.blanking = evaluate::read_blanking(folder);
  if (report.blanking && history) report.blanking_forces = force_stroke_chart(*report.blanking, *history);

  report.cutting = evaluate::read_cutting(folder);
  report.experiments = evaluate::read_experiments(folder);

  const PictureAlbum album(folder);
  for (const AlbumEntry& entry : album.entries()) {
    ReportPicture picture{results::read_file(album.path(entry)), entry.field, entry.time, entry.caption,
                          entry.note};
    if (status.post_mortem && entry.file == status.post_mortem->picture)
      report.place = std::move(picture);
    else
      report.pictures.push_back(std::move(picture));
  }

  if (!status.metrics.empty()) {
    ReportTable metrics{"Results", {}};
    for (const auto& [name, value] : status.metrics)
      if (!name.starts_with("cutting.") &&
          !name.starts_with("experiment.")) // sections of their own have them
        metrics.rows.emplace_back(words(name), results::si_format(value, status.unit_of(name), 6));
    report.tables.push_back(std::move(metrics));
  }
  report.tables.push_back(run_table(status));
  if (!status.wall_s.empty()) report.tables.push_back(wall_table(status));
  if (!status.step_limits.empty()) {
    ReportTable limits{"What limited the step", {}};
    for (const auto& [what, share] : status.step_limits)
      limits.rows.emplace_back(words(what), fmt::format("{:.1f} % of the steps", 100.0 * share));
    report.tables.push_back(std::move(limits));
  }
  if (fs::exists(folder / results::files::resolved_case)) {
    report.case_text = results::read_file(folder / results::files::resolved_case);
    report.subtitle += kinematics_words(report.case_text);
    for (const auto& read : {variable_table, origin_table, damage_table})
      if (auto table = read(report.case_text)) report.tables.push_back(std::move(*table));
  }
  return report;
}

fs::path write_report(const fs::path& folder) { return write_report(folder, results::read_status(folder)); }

fs::path write_report(const fs::path& folder, const results::RunStatus& status) {
  fs::path path = folder / results::files::report;
  results::write_atomically(path, render_report(collect_report(folder, status)));
  return path;
}

} // namespace cnem::report
