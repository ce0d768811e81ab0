#include "report/removal_page.hpp"

#include "core/index.hpp"

#include <algorithm>

namespace cnem::report {

namespace {

Chart over_time(const char* title, const char* label, const char* unit) {
  return {.title = title,
          .x_label = "time",
          .x_unit = "s",
          .y_label = label,
          .y_unit = unit,
          .series = {},
          .note = ""};
}

} // namespace

std::vector<Chart> removal_charts(const results::HistoryTable& history) {
  if (history.find("energy.chips") < 0 || history.find("tool") < 0 || history.rows() < 2) return {};
  const std::vector<double>& time = history.column[index_of(history.find("time"))];
  Chart motion = over_time("Displacement of the points", "displacement", "m"),
        deviation = over_time("Beside the motion with K̂(t) itself", "distance", "m"),
        energy = over_time("Energies", "energy", "J");
  const auto add = [&](Chart& chart, const std::string& label, std::size_t column) {
    chart.series.push_back(
        {.label = label, .x = time, .y = history.column[column], .colour = as<int>(chart.series.size())});
  };
  for (std::size_t c = 0; c < history.names.size(); ++c) {
    const std::string name = results::split_column_name(history.names[c]).name;
    if (name.ends_with(".deviation"))
      add(deviation, name.substr(0, name.rfind('.')), c);
    else if (name.starts_with("energy."))
      add(energy, name.substr(name.find('.') + 1), c);
    else if (const std::vector<double>& u = history.column[c];
             name.find(".u") != std::string::npos &&
             std::any_of(u.begin(), u.end(), [](double value) { return value != 0.0; }))
      add(motion, name, c);
  }
  std::vector<Chart> charts;
  for (Chart* chart : {&motion, &deviation, &energy})
    if (!chart->series.empty()) charts.push_back(std::move(*chart));
  return charts;
}

} // namespace cnem::report
