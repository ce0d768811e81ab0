#include "study/page.hpp"
#include "study/sweep.hpp"

#include "report/chart.hpp"
#include "report/html.hpp"
#include "results/output_folder.hpp"
#include "results/si_format.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <limits>
#include <map>
#include <numeric>

namespace cnem::study {

namespace {

using State = RunRecord::State;

/// The own values of a run except that of `without`: what a curve is called.
std::string label_of(const StudyRun& run, const std::string& without) {
  std::string label;
  for (const input::Override& change : run.own)
    if (change.key != without)
      label += fmt::format("{}{} = {}", label.empty() ? "" : ", ",
                           change.key.substr(change.key.rfind('.') + 1), plain_text(change.value));
  return label;
}

/// Place of a run along x; not-a-number when it has none.
double abscissa(const StudyRun& run, const RunRecord& result, const std::string& x) {
  double number = std::numeric_limits<double>::quiet_NaN();
  std::string unit;
  if (const input::Value* value = run.find(x))
    split_number(*value, number, unit);
  else if (result.status)
    number = status_number(*result.status, x).value_or(number);
  return number;
}

std::string x_label(const Study& study, const std::string& x) {
  double number = 0.0;
  std::string unit;
  for (const StudyRun& run : study.runs)
    if (const input::Value* value = run.find(x); value && split_number(*value, number, unit))
      return x.substr(x.rfind('.') + 1) + (unit.empty() ? "" : " [" + unit + "]");
  return column_name(x);
}

/// Continues a curve to x = 0, and says where it comes to; nothing where it has no two points to go by.
std::string extrapolate(report::ChartSeries& line, const std::string& name) {
  std::vector<std::size_t> known;
  for (std::size_t k = 0; k < line.x.size(); ++k)
    if (line.x[k] > 0.0 && line.y[k] == line.y[k] && (known.empty() || line.x[k] > line.x[known.back()]))
      known.push_back(k);
  if (known.size() < 2) return "";
  const double x = line.x[known[0]], y = line.y[known[0]], dx = line.x[known[1]] - x,
               dy = line.y[known[1]] - y, limit = y - dy / dx * x;
  line.x.insert(line.x.begin(), 0.0);
  line.y.insert(line.y.begin(), limit);
  return fmt::format("{}: {} at 0, from {} at {} and {} at {}\n", name, results::number_format(limit, 5),
                     results::number_format(y, 5), results::number_format(x, 5),
                     results::number_format(y + dy, 5), results::number_format(x + dx, 5));
}

/// One curve per column and per value of the other keys of a grid.
report::Chart column_chart(const Study& study, const std::vector<RunRecord>& runs, const StudyChart& wanted) {
  report::Chart chart;
  chart.x_label = x_label(study, wanted.x);
  chart.x_unit = "";
  chart.y_label = wanted.y.size() == 1 ? column_name(wanted.y.front()) : "";
  const bool along_key = std::find(study.keys.begin(), study.keys.end(), wanted.x) != study.keys.end();
  std::vector<std::string> groups;
  std::map<std::string, std::vector<std::size_t>> members;
  for (std::size_t k = 0; k < runs.size(); ++k) {
    if (!runs[k].status) continue;
    const std::string group = along_key ? label_of(study.runs[k], wanted.x) : "";
    if (!members.contains(group)) groups.push_back(group);
    members[group].push_back(k);
  }
  for (const std::string& group : groups) {
    std::vector<std::size_t>& list = members[group];
    std::vector<double> x(runs.size());
    for (const std::size_t k : list) x[k] = abscissa(study.runs[k], runs[k], wanted.x);
    std::erase_if(list, [&](std::size_t k) { return !(x[k] == x[k]); });
    std::stable_sort(list.begin(), list.end(), [&](std::size_t a, std::size_t b) { return x[a] < x[b]; });
    for (const std::string& column : wanted.y) {
      report::ChartSeries line;
      line.label = wanted.y.size() == 1 ? group : column_name(column) + (group.empty() ? "" : ", " + group);
      line.colour = curve_colour(chart.series.size());
      line.dashed = is_dashed(chart.series.size());
      for (const std::size_t k : list) {
        line.x.push_back(x[k]);
        line.y.push_back(
            status_number(*runs[k].status, column).value_or(std::numeric_limits<double>::quiet_NaN()));
      }
      if (wanted.extrapolate)
        chart.note += extrapolate(line, column_name(column) + (group.empty() ? "" : ", " + group));
      chart.series.push_back(std::move(line));
    }
  }
  std::string title;
  for (const std::string& column : wanted.y) title += (title.empty() ? "" : ", ") + column_name(column);
  chart.title = title + " against " + wanted.x.substr(wanted.x.rfind('.') + 1);
  return chart;
}

std::string run_table(const Study& study, const std::vector<RunRecord>& runs) {
  const std::vector<std::string> columns = table_columns(study, runs);
  std::string html =
      "<section id=\"runs\">\n<h2>Runs</h2>\n<div class=\"runs\"><table>\n<tr>" + cell("run", "th");
  for (const std::string& key : study.keys) html += cell(key.substr(key.rfind('.') + 1), "th");
  for (const std::string& column : columns) html += cell(column_name(column), "th");
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
      for (const std::string& column : columns) {
        const std::optional<double> value = status_number(*runs[k].status, column);
        html += cell(value ? results::number_format(*value, 6) : "");
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
  if (mixed) html += "<li>The runs come from several versions of the program.</li>\n";
  return html.empty() ? "" : "<ul class=\"warnings\">\n" + html + "</ul>\n";
}

} // namespace

std::string extrapolations(const Study& study, const std::vector<RunRecord>& runs) {
  std::string text;
  for (const StudyChart& wanted : study.charts)
    if (wanted.extrapolate) text += column_chart(study, runs, wanted).note;
  return text;
}

std::string sweep_report(const Study& study, const std::vector<RunRecord>& runs,
                         const std::filesystem::path& folder, const std::string& version) {
  const auto count = [&](State state) {
    return std::count_if(runs.begin(), runs.end(), [&](const RunRecord& run) { return run.state == state; });
  };
  std::vector<report::Chart> charts;
  for (const StudyChart& wanted : study.charts) charts.push_back(column_chart(study, runs, wanted));
  if (!study.history.empty()) {
    std::vector<results::HistoryTable> histories(runs.size());
    for (std::size_t k = 0; k < runs.size(); ++k)
      if (runs[k].status)
        histories[k] = results::read_history(folder / study.runs[k].name / results::files::history);
    std::vector<std::string> labels;
    for (const StudyRun& run : study.runs) {
      const std::string label = label_of(run, "");
      labels.push_back(label.empty() || run.own.size() > 2 ? run.name : label);
    }
    for (const std::string& column : study.history)
      charts.push_back(history_chart(histories, labels, column));
  }
  const std::string title = study.title.empty() ? study.name : study.title;
  std::string verdict = fmt::format("{} of {} runs done", count(State::done), runs.size());
  if (count(State::failed) > 0) verdict += fmt::format(", {} failed", count(State::failed));
  if (count(State::pending) > 0) verdict += fmt::format(", {} not run yet", count(State::pending));
  return page({.title = title,
               .version = version,
               .verdict = verdict,
               .good = count(State::done) == static_cast<std::ptrdiff_t>(runs.size())},
              warnings(study, runs) + chart_section(charts) + run_table(study, runs) +
                  fmt::format("<section id=\"study\">\n<h2>The study</h2>\n<pre "
                              "tabindex=\"0\">{}</pre>\n</section>\n",
                              report::html_escape(study.text)));
}

} // namespace cnem::study
