#include "study/page.hpp"
#include "study/sweep.hpp"

#include "report/html.hpp"
#include "results/output_folder.hpp"
#include "results/si_format.hpp"
#include "study/sweep_charts.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace cnem::study {

namespace {

using State = RunRecord::State;

/// The largest size of a column.
double largest(const std::vector<RunRecord>& runs, const std::string& column) {
  double size = 0.0;
  for (const RunRecord& run : runs)
    if (const std::optional<double> value = run.status ? status_number(*run.status, column) : std::nullopt;
        value && std::isfinite(*value))
      size = std::max(size, std::abs(*value));
  return size;
}

std::string run_table(const Study& study, const std::vector<RunRecord>& runs,
                      const results::ShownUnits& shown) {
  const std::vector<std::string> columns = table_columns(study, runs);
  std::vector<results::DisplayUnit> units;
  std::string html =
      "<section id=\"runs\">\n<h2>Runs</h2>\n<div class=\"runs\"><table>\n<tr>" + cell("run", "th");
  for (const std::string& key : study.keys) html += cell(key.substr(key.rfind('.') + 1), "th");
  for (const std::string& column : columns) {
    units.push_back(shown.of(largest(runs, column), column_unit(runs, column)));
    const std::string& unit = units.back().unit;
    html += cell(column_name(column) + (unit.empty() ? "" : " [" + unit + "]"), "th");
  }
  html += "</tr>\n";
  for (std::size_t k = 0; k < runs.size(); ++k) {
    const std::string name = report::html_escape(study.runs[k].name);
    html += runs[k].state == State::pending
                ? fmt::format("<tr><td>{}</td>", name)
                : fmt::format("<tr><td><a href=\"{0}/{1}\">{0}</a></td>", name, results::files::report);
    for (const std::string& key : study.keys) {
      const input::Value* value = study.runs[k].find(key);
      html += cell(value ? plain_text(*value) : "");
    }
    if (runs[k].status)
      for (std::size_t c = 0; c < columns.size(); ++c) {
        const std::optional<double> value = status_number(*runs[k].status, columns[c]);
        html += cell(value && !std::isnan(*value) ? results::number_format(units[c].shown(*value), 5) : "");
      }
    else
      html +=
          fmt::format("<td class=\"{}\" colspan=\"{}\">{}</td>", runs[k].state == State::failed ? "bad" : "",
                      columns.size(), runs[k].state == State::failed ? "failed" : "not run yet");
    html += "</tr>\n";
  }
  return html + "</table></div>\n</section>\n";
}

std::string warnings(const Study& study, const std::vector<RunRecord>& runs) {
  std::string html, version;
  bool mixed = false;
  for (std::size_t k = 0; k < runs.size(); ++k) {
    if (runs[k].state == State::failed)
      html += fmt::format("<li>{} failed: {}</li>\n", report::html_escape(study.runs[k].name),
                          report::html_escape(runs[k].reason));
    if (!runs[k].status) continue;
    mixed = mixed || (!version.empty() && version != runs[k].status->version);
    version = runs[k].status->version;
  }
  for (const std::string& warning : warnings_of_runs(study, runs))
    html += fmt::format("<li>{}</li>\n", report::html_escape(warning));
  if (mixed) html += "<li>The runs come from several versions of the program.</li>\n";
  return html.empty() ? "" : "<ul class=\"warnings\">\n" + html + "</ul>\n";
}

} // namespace

std::vector<std::string> warnings_of_runs(const Study& study, const std::vector<RunRecord>& runs) {
  std::vector<std::pair<std::string, std::vector<std::string>>> told; // text, names of runs
  for (std::size_t k = 0; k < runs.size(); ++k) {
    if (!runs[k].status) continue;
    for (const std::string& text : runs[k].status->warnings) {
      auto known = std::find_if(told.begin(), told.end(), [&](const auto& one) { return one.first == text; });
      if (known == told.end()) known = told.insert(told.end(), {text, {}});
      known->second.push_back(study.runs[k].name);
    }
  }
  std::vector<std::string> list;
  for (const auto& [text, names] : told)
    list.push_back(fmt::format(
        "{}{}: {}", names.front(),
        names.size() > 1 ? fmt::format(" and {} more of {} runs", names.size() - 1, runs.size()) : "", text));
  return list;
}

std::string sweep_report(const Study& study, const std::vector<RunRecord>& runs,
                         const std::filesystem::path& folder, const std::string& version,
                         const std::string& first) {
  const auto count = [&](State state) {
    return std::count_if(runs.begin(), runs.end(), [&](const RunRecord& run) { return run.state == state; });
  };
  std::vector<report::Chart> charts = column_charts(study, runs);
  for (report::Chart& chart : history_charts(study, runs, folder)) charts.push_back(std::move(chart));
  const results::ShownUnits units = shown_units(study, folder);
  const std::string title = study.title.empty() ? study.name : study.title;
  std::string verdict = fmt::format("{} of {} runs done", count(State::done), runs.size());
  if (count(State::failed) > 0) verdict += fmt::format(", {} failed", count(State::failed));
  if (count(State::pending) > 0) verdict += fmt::format(", {} not run yet", count(State::pending));
  return page({.title = title,
               .version = version,
               .verdict = verdict,
               .good = count(State::done) == static_cast<std::ptrdiff_t>(runs.size())},
              warnings(study, runs) + first + chart_section(charts, units) + run_table(study, runs, units) +
                  fmt::format("<section id=\"study\">\n<h2>The study</h2>\n<pre "
                              "tabindex=\"0\">{}</pre>\n</section>\n",
                              report::html_escape(study.text)));
}

} // namespace cnem::study
