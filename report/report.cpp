#include "report/report.hpp"

#include "report/blanking_page.hpp"
#include "report/html.hpp"
#include "report/milling_page.hpp"
#include "report/picture_album.hpp"
#include "report/removal_page.hpp"
#include "report/stability_page.hpp"
#include "results/output_folder.hpp"
#include "results/si_format.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace cnem::report {
namespace fs = std::filesystem;
namespace {

std::string verdict(const results::RunStatus& status) {
  const char* how = status.exit == 0   ? "Finished"
                    : status.exit == 3 ? "Diverged"
                    : status.exit == 5 ? "Stopped, can be resumed"
                                       : "Failed";
  return status.reason.empty() ? how : fmt::format("{}: {}", how, status.reason);
}

/// How the run went, in one line: what it is judged by, not what was asked of it.
std::string run_line(const results::RunStatus& status, const CaseWords& said,
                     const results::ShownUnits& units) {
  std::vector<std::string> parts;
  if (std::isfinite(status.time) && status.steps > 0)
    parts.push_back(units.format(status.time, "s") + " simulated");
  if (status.nodes > 0) parts.push_back(grouped(status.nodes) + " nodes");
  if (status.steps > 0) parts.push_back(grouped(status.steps) + " steps");
  for (const auto& [phase, seconds] : status.wall_s)
    if (phase == "total" && seconds > 0.0) parts.push_back(results::duration_format(seconds));
  if (std::isfinite(status.energy_residual))
    parts.push_back(fmt::format("{} residual {} %{}", said.moves ? "energy" : "heat",
                                results::number_format(100.0 * status.energy_residual, 2),
                                said.moves ? "" : " of the heat moved"));
  std::string line;
  for (const std::string& part : parts) line += (line.empty() ? "" : " · ") + part;
  return line;
}

void collect_pictures(ReportData& report, const fs::path& folder, const results::RunStatus& status) {
  const PictureAlbum album(folder);
  for (const AlbumEntry& entry : album.entries()) {
    ReportPicture picture{results::read_file(album.path(entry)), entry.field, entry.time, entry.caption,
                          entry.note};
    if (status.post_mortem && entry.file == status.post_mortem->picture)
      report.place = std::move(picture);
    else
      report.pictures.push_back(std::move(picture));
  }
}

/// Throws IoError where the page would have less than the run has written.
void check_history(const fs::path& folder, const results::RunStatus& status) {
  if (status.steps == 0) return;
  const fs::path path = folder / results::files::history;
  const std::string stays = "the report that may be there stays";
  if (!fs::exists(path)) throw IoError(fmt::format("{} is missing: {}", path.string(), stays));
  const results::HistoryTable history = results::read_history(path);
  constexpr double rows = 2.0; // between the last row and the end
  const int at = history.find("time");
  const std::vector<double> time = at < 0 ? std::vector<double>() : history.column[index_of(at)];
  const double last = time.empty() ? 0.0 : time.back();
  double apart = time.size() > 1 ? 0.0 : status.time;
  for (std::size_t k = 1; k < time.size(); ++k) apart = std::max(apart, time[k] - time[k - 1]);
  if (status.time - last > rows * apart)
    throw IoError(fmt::format("{} is cut short: it ends at t = {:.4g} s, the run at {:.4g} s: {}",
                              path.string(), last, status.time, stays));
}

} // namespace

ReportData collect_report(const fs::path& folder) {
  return collect_report(folder, results::read_status(folder));
}

ReportData collect_report(const fs::path& folder, const results::RunStatus& status) {
  ReportData report;
  CaseWords said;
  if (fs::exists(folder / results::files::resolved_case)) {
    report.case_text = results::read_file(folder / results::files::resolved_case);
    report.units = results::ShownUnits::of_case(report.case_text);
    said = case_words(report.case_text);
  }
  const std::string name = status.case_name.empty()
                               ? fs::absolute(folder).lexically_normal().filename().string()
                               : status.case_name;
  report.title = said.title.empty() ? name : said.title;
  report.subtitle = "cnem " + status.version;
  if (!said.title.empty()) report.subtitle += " · " + name;
  if (!said.kinematics.empty()) report.subtitle += " · " + said.kinematics;
  report.failed = status.exit != 0 && status.exit != 5;
  report.verdict = verdict(status);
  report.run_line = run_line(status, said, report.units);
  report.warnings = status.warnings;
  report.post_mortem = status.post_mortem;

  std::optional<results::HistoryTable> history;
  if (fs::exists(folder / results::files::history))
    history = results::read_history(folder / results::files::history);
  if (history) report.charts = history_charts(*history, report.units);
  report.blanking = evaluate::read_blanking(folder);
  if (report.blanking && history)
    report.blanking_forces = force_stroke_chart(*report.blanking, *history, report.units);
  report.cutting = evaluate::read_cutting(folder);
  report.experiments = evaluate::read_experiments(folder);
  report.figures = headline({.status = status,
                             .history = history ? &*history : nullptr,
                             .blanking = report.blanking ? &*report.blanking : nullptr,
                             .cutting = report.cutting ? &*report.cutting : nullptr,
                             .units = report.units});
  if (auto lobes = stability_lobes(folder, status)) {
    report.charts.push_back(std::move(*lobes));
    if (auto along = stability_along(folder, status)) report.charts.push_back(std::move(*along));
    report.charts_title = "Stability";
    report.figures = stability_figures(status, report.units);
  }
  if (history)
    if (std::vector<Chart> charts = milling_charts(folder, *history, status); !charts.empty()) {
      report.charts = std::move(charts);
      report.charts_title = "Milling";
      report.figures = milling_figures(status, report.units);
    }
  if (history)
    if (std::vector<Chart> charts = removal_charts(*history); !charts.empty()) {
      report.charts = std::move(charts);
      report.charts_title = "Removal";
    }
  collect_pictures(report, folder, status);

  const auto add = [&](ReportTable table) {
    if (!table.rows.empty()) report.tables.push_back(std::move(table));
  };
  add(result_table(status, report.units));
  if (history) add(energy_table(*history, report.units));
  for (ReportTable& table : run_tables(status)) add(std::move(table));
  for (ReportTable& table : said.tables) add(std::move(table));
  return report;
}

fs::path write_report(const fs::path& folder) {
  if (!fs::exists(folder / results::files::status))
    throw InputError(
        fmt::format("{} holds no run to report of: expected the output folder of `cnem run`, with its {}",
                    folder.string(), results::files::status));
  const results::RunStatus status = results::read_status(folder);
  check_history(folder, status);
  return write_report(folder, status);
}

fs::path write_report(const fs::path& folder, const results::RunStatus& status) {
  fs::path path = folder / results::files::report;
  results::write_atomically(path, render_report(collect_report(folder, status)));
  return path;
}

} // namespace cnem::report
