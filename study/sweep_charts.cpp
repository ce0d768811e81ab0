#include "study/sweep_charts.hpp"

#include "evaluate/force_stroke.hpp"
#include "results/history_writer.hpp"
#include "results/output_folder.hpp"
#include "results/si_format.hpp"
#include "study/page.hpp"
#include "study/sweep.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <limits>
#include <map>

namespace cnem::study {

namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// The own values of a run except that of one axis: what a curve is called.
std::string label_of(const Study& study, const StudyRun& run, const StudyAxis* without) {
  std::string label;
  for (const StudyAxis& axis : study.axes)
    if (const input::Value* value = &axis == without ? nullptr : run.find(axis.keys.front()))
      label += fmt::format("{}{} = {}", label.empty() ? "" : ", ", axis.name, plain_text(*value));
  return label;
}

/// Places of the runs along x.
struct Abscissa {
  std::string label, unit;   ///< the unit is in the label where the study writes one
  std::vector<double> value; ///< [run], not-a-number where it is not known
};

/// As the study writes them: numbers of one unit. Empty where they are not, or not for all runs.
Abscissa written_abscissa(const Study& study, const std::string& key) {
  Abscissa result;
  std::string first;
  for (const StudyRun& run : study.runs) {
    const input::Value* value = run.find(key);
    std::string unit;
    if (!value || !split_number(*value, result.value.emplace_back(), unit)) return {};
    if (result.value.size() > 1 && unit != first) return {};
    first = unit;
  }
  const StudyAxis* axis = study.axis_of(key);
  const std::string name = axis && axis->keys.front() == key ? axis->name : key.substr(key.rfind('.') + 1);
  result.label = name + (first.empty() ? "" : " [" + first + "]");
  return result;
}

Abscissa abscissa_of(const Study& study, const std::vector<RunRecord>& runs, const std::string& x) {
  if (Abscissa written = written_abscissa(study, x); !written.value.empty()) return written;
  Abscissa result{column_name(x), column_unit(runs, x), {}};
  for (std::size_t k = 0; k < runs.size(); ++k) {
    double& place = result.value.emplace_back(unknown);
    std::string unit;
    if (is_variable(x)) {
      for (const input::Variable& variable : runs[k].variables)
        if ("let." + variable.name == x) {
          place = variable.value;
          result.label = variable.name;
          result.unit = variable.unit;
        }
    } else if (const input::Value* value = study.runs[k].find(x)) {
      if (!split_number(*value, place, unit)) place = unknown;
    } else if (runs[k].status) {
      place = status_number(*runs[k].status, x).value_or(unknown);
    }
  }
  return result;
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

/// The unit of all of the columns; empty where they have several, and then each says its own.
std::string shared_unit(const std::vector<RunRecord>& runs, const std::vector<std::string>& columns) {
  const std::string unit = column_unit(runs, columns.front());
  const bool shared = std::all_of(columns.begin(), columns.end(), [&](const std::string& column) {
    return column_unit(runs, column) == unit;
  });
  return shared ? unit : "";
}

/// One curve per column and per value of the other axes.
report::Chart column_chart(const Study& study, const std::vector<RunRecord>& runs, const StudyChart& wanted) {
  const Abscissa x = abscissa_of(study, runs, wanted.x);
  const StudyAxis* axis = study.axis_of(wanted.x);
  report::Chart chart;
  chart.x_label = x.label;
  chart.x_unit = x.unit;
  chart.y_label = wanted.y.size() == 1 && wanted.title.empty() ? column_name(wanted.y.front()) : wanted.title;
  chart.y_unit = wanted.y.empty() ? "" : shared_unit(runs, wanted.y);
  const bool along_axis = axis || is_variable(wanted.x);
  std::vector<std::string> groups;
  std::map<std::string, std::vector<std::size_t>> members;
  for (std::size_t k = 0; k < runs.size(); ++k) {
    if (!runs[k].status) continue;
    const bool derived = is_variable(wanted.x) && !axis && study.axes.size() == 1;
    const std::string group =
        along_axis ? label_of(study, study.runs[k], derived ? &study.axes.front() : axis) : "";
    if (!members.contains(group)) groups.push_back(group);
    members[group].push_back(k);
  }
  for (const std::string& group : groups) {
    std::vector<std::size_t>& list = members[group];
    std::erase_if(list, [&](std::size_t k) { return !(x.value[k] == x.value[k]); });
    std::stable_sort(list.begin(), list.end(),
                     [&](std::size_t a, std::size_t b) { return x.value[a] < x.value[b]; });
    for (std::size_t c = 0; c < wanted.y.size(); ++c) {
      const std::string& column = wanted.y[c];
      report::ChartSeries line;
      const std::string unit = column_unit(runs, column);
      const std::string name = (wanted.names.empty() ? column_name(column) : wanted.names[c]) +
                               (unit == chart.y_unit ? "" : " [" + unit + "]");
      line.label = wanted.y.size() == 1 ? group : name + (group.empty() ? "" : ", " + group);
      line.colour = static_cast<int>(chart.series.size());
      for (const std::size_t k : list) {
        line.x.push_back(x.value[k]);
        line.y.push_back(status_number(*runs[k].status, column).value_or(unknown));
      }
      if (wanted.extrapolate)
        chart.note += extrapolate(line, column_name(column) + (group.empty() ? "" : ", " + group));
      chart.series.push_back(std::move(line));
    }
  }
  std::string title = wanted.title;
  if (title.empty())
    for (const std::string& column : wanted.y) title += (title.empty() ? "" : ", ") + column_name(column);
  chart.title =
      title + " against " +
      (axis && axis->keys.front() == wanted.x ? axis->name : wanted.x.substr(wanted.x.rfind('.') + 1));
  return chart;
}

std::string words_of(std::string name) {
  for (char& c : name)
    if (c == '_' || c == '.') c = ' ';
  return name;
}

/// A chart of each number of the cut over the first axis, for faces one of each body: its sides together.
std::vector<StudyChart> cut_charts(const Study& study, const std::vector<RunRecord>& runs) {
  if (study.axes.empty()) return {};
  constexpr std::string_view prefix = "blanking.";
  std::vector<StudyChart> charts;
  for (const std::string& column : cut_columns(runs)) {
    const std::string name = column_name(column).substr(prefix.size());
    const std::size_t dot = name.rfind('.');
    const bool of_punch = std::any_of(
        runs.begin(), runs.end(), [&](const RunRecord& run) { return run.punch == name.substr(dot + 1); });
    const std::string face = name.substr(0, dot); // "slug", "left.slug"
    const std::size_t side = face.find('.');
    const std::string title = words_of(of_punch ? face + " of " + name.substr(dot + 1)
                                                : name.substr(dot + 1) + " of the " + face.substr(side + 1));
    auto chart = std::find_if(charts.begin(), charts.end(),
                              [&](const StudyChart& known) { return known.title == title; });
    if (chart == charts.end())
      chart = charts.insert(chart, {study.axes.front().keys.front(), {}, {}, false, title, {}});
    chart->y.push_back(column);
    chart->names.push_back(of_punch ? title : words_of(face.substr(0, side)));
  }
  return charts;
}

/// Zeros alone are none.
bool has_a_curve(const report::Chart& chart) {
  return std::any_of(chart.series.begin(), chart.series.end(), [](const report::ChartSeries& line) {
    return line.x.size() > 1 && std::any_of(line.y.begin(), line.y.end(), [](double y) { return y != 0.0; });
  });
}

/// The low-passed force of the punch over its stroke.
report::Chart force_chart(std::span<const results::HistoryTable> histories,
                          std::span<const std::string> labels, const std::vector<RunRecord>& runs,
                          const std::vector<std::filesystem::path>& folders) {
  report::Chart chart;
  chart.title = "Force of the punch over its stroke";
  chart.x_label = "stroke";
  chart.x_unit = "m";
  chart.y_label = "force";
  for (std::size_t k = 0; k < runs.size(); ++k) {
    if (histories[k].rows() < 2 || !runs[k].status) continue;
    const std::optional<evaluate::BlankingResult> cut = evaluate::read_blanking(folders[k]);
    if (!cut || cut->punch.empty()) continue;
    const evaluate::ForceCurve curve = evaluate::force_curve(histories[k], evaluate::leading_force(*cut));
    chart.y_unit = cut->force_unit;
    chart.series.push_back({.label = labels[k],
                            .x = curve.even_stroke,
                            .y = curve.smooth,
                            .colour = static_cast<int>(chart.series.size())});
  }
  chart.note = "Low-passed, as in the report of each run.";
  return chart;
}

} // namespace

std::vector<report::Chart> column_charts(const Study& study, const std::vector<RunRecord>& runs) {
  std::vector<report::Chart> charts;
  for (const StudyChart& wanted : study.charts) charts.push_back(column_chart(study, runs, wanted));
  if (!study.charts.empty()) return charts;
  for (const StudyChart& chart : cut_charts(study, runs)) charts.push_back(column_chart(study, runs, chart));
  std::erase_if(charts, [](const report::Chart& chart) { return !has_a_curve(chart); });
  return charts;
}

std::vector<report::Chart> history_charts(const Study& study, const std::vector<RunRecord>& runs,
                                          const std::filesystem::path& folder) {
  const bool cut =
      std::any_of(runs.begin(), runs.end(), [](const RunRecord& run) { return !run.punch.empty(); });
  if (study.history.empty() && !cut) return {};
  std::vector<results::HistoryTable> histories(runs.size());
  std::vector<std::filesystem::path> folders;
  std::vector<std::string> labels;
  for (std::size_t k = 0; k < runs.size(); ++k) {
    const StudyRun& run = study.runs[k];
    folders.push_back(folder / run.name);
    if (runs[k].status) histories[k] = results::read_history(folders[k] / results::files::history);
    const std::string label = label_of(study, run, nullptr);
    labels.push_back(label.empty() || study.axes.size() > 2 ? run.name : label);
  }
  std::vector<report::Chart> charts;
  for (const StudyHistory& wanted : study.history)
    charts.push_back(history_chart(histories, labels, wanted.y, wanted.x));
  if (!study.history.empty()) return charts;
  charts.push_back(force_chart(histories, labels, runs, folders));
  if (charts.back().series.empty()) charts.clear();
  return charts;
}

std::string extrapolations(const Study& study, const std::vector<RunRecord>& runs) {
  std::string text;
  for (const StudyChart& wanted : study.charts)
    if (wanted.extrapolate) text += column_chart(study, runs, wanted).note;
  return text;
}

} // namespace cnem::study
