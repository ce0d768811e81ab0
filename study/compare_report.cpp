// compare.html.
#include "core/index.hpp"
#include "report/html.hpp"
#include "report/report_style.hpp"
#include "results/output_folder.hpp"
#include "results/si_format.hpp"
#include "study/compare.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace cnem::study {

namespace {

using State = RunRecord::State;
using Shown = ComparedNumber::Shown;

constexpr const char* style = R"css(
main { max-width: 2000px; }
.hint { color: var(--soft); margin: 10px 0 14px; font-size: 13px; }
.pictures.side { grid-template-columns: repeat(auto-fit, minmax(min(360px, 100%), 1fr)); margin-bottom: 16px; }
.side figcaption { color: var(--ink); font-weight: 600; padding: 8px 14px 0; }
.side p { color: var(--soft); padding: 0 14px; }
.side + h3 { margin-top: 26px; }
.runs td:first-child { color: var(--soft); }
.runs th { color: var(--ink); font-weight: 600; }
.warnings li { white-space: pre-line; }
)css";

std::string show(const ComparedNumber& number, double value, const results::ShownUnits& units) {
  switch (number.shown) {
  case Shown::count:
    return fmt::format("{:.0f}", value);
  case Shown::unit:
    return units.format(value, number.unit);
  case Shown::duration:
    return results::duration_format(value);
  case Shown::percent:
    return results::number_format(100.0 * value, 2) + " %";
  case Shown::plain:
    break;
  }
  return results::number_format(value, 6);
}

std::string number_rows(const std::vector<ComparedNumber>& numbers, const results::ShownUnits& units) {
  std::string html;
  for (const ComparedNumber& number : numbers) {
    if (std::none_of(number.value.begin(), number.value.end(), [](const auto& v) { return v.has_value(); }))
      continue;
    html += "<tr>" + cell(number.label);
    for (const std::optional<double>& value : number.value)
      html += cell(value && std::isfinite(*value) ? show(number, *value, units) : "");
    html += "</tr>\n";
  }
  return html;
}

std::string state_cell(const Outcome& outcome) {
  const RunRecord& record = outcome.record;
  if (record.state == State::done) return cell("done");
  return fmt::format(
      "<td class=\"bad\">{}</td>",
      record.state == State::failed && record.exit == Exit::diverged ? "diverged" : state_name(record.state));
}

std::string head_row(const Compared& compared) {
  std::string html = "<tr>" + cell("", "th");
  for (std::size_t k = 0; k < compared.outcome.size(); ++k) {
    const std::string name = report::html_escape(compared.study.runs[k].name);
    const std::string page = fmt::format("{}/{}", compared.study.runs[k].name, results::files::report);
    html += std::filesystem::exists(compared.folder / page)
                ? fmt::format("<th><a href=\"{}\">{}</a></th>", report::html_escape(page), name)
                : fmt::format("<th>{}</th>", name);
  }
  return html + "</tr>\n";
}

std::string table(const Compared& compared) {
  std::string html = "<section id=\"numbers\">\n<h2>Cost and result</h2>\n<div class=\"runs\"><table>\n" +
                     head_row(compared) + "<tr>" + cell("Status");
  for (const Outcome& outcome : compared.outcome) html += state_cell(outcome);
  html += "</tr>\n";
  for (const std::string& key : compared.study.keys) {
    html += "<tr>" + cell(key);
    for (const StudyRun& run : compared.study.runs) {
      const input::Value* value = run.find(key);
      html += cell(value ? plain_text(*value) : "as in the case");
    }
    html += "</tr>\n";
  }
  return html + number_rows(compared_numbers(compared), shown_units(compared.study, compared.folder)) +
         "</table></div>\n<p class=\"hint\">Cost of a node-step: wall time of steps and new references. "
         "Largest force: of "
         "the low-passed curve below.</p>\n</section>\n";
}

std::string metrics(const Compared& compared) {
  const std::string rows =
      number_rows(compared_metrics(compared), shown_units(compared.study, compared.folder));
  return rows.empty() ? ""
                      : "<section id=\"metrics\">\n<h2>Results</h2>\n<div class=\"runs\"><table>\n" +
                            head_row(compared) + rows + "</table></div>\n</section>\n";
}

/// What methods were refused or failed for, and what a reader must know of the others.
std::string warnings(const Compared& compared) {
  std::string html;
  for (std::size_t k = 0; k < compared.outcome.size(); ++k) {
    const Outcome& outcome = compared.outcome[k];
    const std::string name = report::html_escape(compared.study.runs[k].name);
    if (outcome.record.state == State::failed || outcome.record.state == State::refused)
      html += fmt::format("<li>{} {}: {}</li>\n", name, state_name(outcome.record.state),
                          report::html_escape(outcome.record.reason));
    if (outcome.status)
      for (const std::string& warning : outcome.status->warnings)
        html += fmt::format("<li>{}: {}</li>\n", name, report::html_escape(warning));
  }
  return html.empty() ? "" : "<ul class=\"warnings\">\n" + html + "</ul>\n";
}

report::Chart force_chart(const Compared& compared) {
  const evaluate::LeadingForce& force = *compared.force;
  report::Chart chart;
  const std::string who = in_words(force.of);
  chart.title = fmt::format("Force of {} against {}", who, force.over_stroke ? "stroke" : "time");
  if (force.over_stroke) {
    chart.x_label = "stroke of " + who;
    chart.x_unit = "m";
  }
  chart.y_label = "force of " + who;
  double sigma = 0.0;
  for (std::size_t k = 0; k < compared.outcome.size(); ++k) {
    const results::HistoryTable& history = compared.outcome[k].history;
    if (history.rows() < 2) continue;
    const evaluate::ForceCurve curve = evaluate::force_curve(history, force);
    chart.y_unit =
        results::split_column_name(history.names[index_of(history.find(force.of + ".force_x"))]).unit;
    sigma = std::max(sigma, evaluate::force_filter(curve.time));
    report::ChartSeries raw, smooth;
    raw.x = force.over_stroke ? curve.stroke : curve.time;
    raw.y = curve.force;
    raw.faint = true;
    smooth.x = force.over_stroke ? curve.even_stroke : curve.even_time;
    smooth.y = curve.smooth;
    smooth.label = compared.study.runs[k].name;
    raw.colour = smooth.colour = static_cast<int>(k);
    chart.series.push_back(std::move(raw));
    chart.series.push_back(std::move(smooth));
  }
  chart.note = fmt::format(
      "On the workpiece, {}, {}. Pale: every recorded value; full: Gaussian low-pass in time, σ = {}.",
      force.over_stroke ? "along the way of the tool" : "along the axis of its largest impulse",
      chart.y_unit == "N" ? "of the whole body" : "per unit thickness, of the part that is modelled",
      results::si_format(sigma, "s", 3));
  return chart;
}

bool changes(const report::Chart& chart) {
  for (const report::ChartSeries& line : chart.series)
    for (const double value : line.y)
      if (value != line.y.front()) return true;
  return false;
}

/// No step is behind the row at time 0.
void leave_out_the_first(report::Chart& chart) {
  for (report::ChartSeries& line : chart.series) line.y.front() = std::nan("");
}

/// Columns of histories that are worth a look whatever the case.
std::vector<std::string> columns_to_show(const results::HistoryTable& history) {
  std::vector<std::string> columns;
  for (const std::string& header : history.names) {
    const std::string name = results::split_column_name(header).name;
    const bool energy = name == "energy.kinetic" || name == "energy.plastic" || name == "energy.residual";
    if (energy || name == "dt" || name == "max.plastic_strain" || name == "max.temperature" ||
        name == "max.damage" || name.starts_with("probe."))
      columns.push_back(name);
  }
  return columns;
}

std::vector<report::Chart> charts(const Compared& compared) {
  std::vector<results::HistoryTable> histories;
  std::vector<std::string> labels, columns;
  for (std::size_t k = 0; k < compared.outcome.size(); ++k) {
    labels.push_back(compared.study.runs[k].name);
    const results::HistoryTable& history = compared.outcome[k].history;
    histories.push_back(history.rows() < 2 ? results::HistoryTable() : history);
    if (columns.empty()) columns = columns_to_show(histories.back());
  }
  std::vector<report::Chart> list;
  if (compared.force && !columns.empty()) list.push_back(force_chart(compared));
  for (const std::string& column : columns)
    if (report::Chart chart = history_chart(histories, labels, column); changes(chart)) {
      if (column == "dt") leave_out_the_first(chart);
      chart.title = chart.y_label = column == "dt" ? "time step" : in_words(column);
      list.push_back(std::move(chart));
    }
  return list;
}

} // namespace

std::string compare_report(const Compared& compared) {
  const auto count = [&](State state) {
    return std::count_if(compared.outcome.begin(), compared.outcome.end(),
                         [&](const Outcome& outcome) { return outcome.record.state == state; });
  };
  const auto all = std::ssize(compared.outcome);
  std::string verdict = fmt::format("{} of {} methods done", count(State::done), all);
  for (const State state : {State::failed, State::refused})
    if (count(state) > 0) verdict += fmt::format(", {} {}", count(state), state_name(state));
  if (count(State::pending) > 0) verdict += fmt::format(", {} not run yet", count(State::pending));
  const std::string title = compared.study.title.empty() ? compared.study.name : compared.study.title;
  return page({.title = title,
               .version = compared.version,
               .verdict = verdict,
               .good = count(State::done) == all,
               .style = style},
              warnings(compared) + table(compared) +
                  chart_section(charts(compared), shown_units(compared.study, compared.folder)) +
                  compare_pictures(compared) + metrics(compared) +
                  fmt::format("<dialog><img alt=\"enlarged picture\"/></dialog>\n<script>{}</script>\n",
                              report::report_script));
}

} // namespace cnem::study
