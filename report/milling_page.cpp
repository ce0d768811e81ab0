#include "report/milling_page.hpp"

#include "core/index.hpp"
#include "results/history_writer.hpp"
#include "results/output_folder.hpp"
#include "results/si_format.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <tuple>

namespace cnem::report {

namespace {

/// The last rows of a history, over the angle of the first tooth.
class LastTurns {
public:
  explicit LastTurns(const results::HistoryTable& history) : history_(history) {
    constexpr double turns = 4.0 * std::numbers::pi;
    const std::vector<double> angle = history.column[index_of(history.find("angle"))];
    while (first_ < angle.size() && angle[first_] < angle.back() - turns) ++first_;
  }
  ChartSeries series(const char* column, const char* label, int colour) const {
    return {.label = label, .x = of("angle"), .y = of(column), .colour = colour};
  }

private:
  std::vector<double> of(const char* name) const {
    const std::vector<double>& all = history_.column[index_of(history_.find(name))];
    return {all.begin() + static_cast<std::ptrdiff_t>(first_), all.end()};
  }
  const results::HistoryTable& history_;
  std::size_t first_ = 0;
};

/// Lines from the axis up, at frequencies.
ChartSeries marks(const std::vector<double>& frequency, double height, const char* label, int colour) {
  ChartSeries series{.label = label, .x = {}, .y = {}, .colour = colour, .faint = true};
  for (const double f : frequency) {
    series.x.insert(series.x.end(), {f, f, f});
    series.y.insert(series.y.end(), {0.0, height, std::numeric_limits<double>::quiet_NaN()});
  }
  return series;
}

void add_spectra(std::vector<Chart>& charts, const std::filesystem::path& folder,
                 const results::RunStatus& status) {
  const std::filesystem::path path = folder / results::files::spectra;
  if (!std::filesystem::exists(path)) return;
  const results::HistoryTable table = results::read_history(path);
  const std::vector<double>& frequency = table.column.front();
  std::vector<double> teeth;
  for (std::size_t k = 1; k < frequency.size(); ++k)
    if (table.column[1][k] == 2.0) teeth.push_back(frequency[k]);
  for (const auto& [title, label, unit, columns] :
       {std::tuple{"Spectrum of the forces", "amplitude", "N", std::array{"Fx", "Fy", "Fz"}},
        {"Spectrum of the vibration", "amplitude", "m", std::array{"x", "y", "z"}}}) {
    Chart chart{
        .title = title,
        .x_label = "frequency",
        .x_unit = "Hz",
        .y_label = label,
        .y_unit = unit,
        .series = {},
        .note =
            "Of the second half of the turns, of passes the middle half of the last one, without the mean."};
    double most = 0.0;
    int colour = 0;
    for (const char* name : columns) {
      const int column = table.find(name);
      if (column < 0) continue;
      chart.series.push_back(
          {.label = name, .x = frequency, .y = table.column[index_of(column)], .colour = colour++});
      most = std::max(most, *std::max_element(chart.series.back().y.begin(), chart.series.back().y.end()));
    }
    if (chart.series.empty() || !(most > 0.0)) continue;
    chart.series.push_back(marks(teeth, most, "harmonics of the teeth", 3));
    if (const auto chatter = status.metric("milling.chatter_frequency"))
      chart.series.push_back(marks({*chatter}, most, "chatter", 4));
    charts.push_back(std::move(chart));
  }
}

Chart energy_chart(const results::HistoryTable& history) {
  Chart chart{.title = "Energies",
              .x_label = "time",
              .x_unit = "s",
              .y_label = "energy",
              .y_unit = "J",
              .series = {},
              .note = "Spindle and feed put in what the cut takes, what flanks take on the surface "
                      "(ploughing), what damping loses, what the motion of a part loses with the matter of "
                      "its chips, and what modes and a part hold (kinetic, elastic)."};
  int colour = 0;
  for (const char* name :
       {"spindle", "cutting", "ploughing", "damping", "chips", "kinetic", "elastic", "feed"})
    if (const int column = history.find(std::string("energy.") + name); column >= 0)
      chart.series.push_back({.label = name,
                              .x = history.column.front(),
                              .y = history.column[index_of(column)],
                              .colour = colour++});
  return chart;
}

} // namespace

std::vector<Chart> milling_charts(const std::filesystem::path& folder, const results::HistoryTable& history,
                                  const results::RunStatus& status) {
  const std::filesystem::path path = folder / results::files::machined_surface;
  if (!std::filesystem::exists(path) || history.rows() < 2) return {};
  const LastTurns last(history);
  const auto over_angle = [](const char* title, const char* label, const char* unit,
                             std::vector<ChartSeries> series) {
    return Chart{.title = title,
                 .x_label = "angle of the first tooth",
                 .x_unit = "rad",
                 .y_label = label,
                 .y_unit = unit,
                 .series = std::move(series),
                 .note = ""};
  };
  std::vector<Chart> charts{over_angle("Forces on the tool", "force", "N",
                                       {last.series("Fx", "along the feed, x", 0),
                                        last.series("Fy", "across, y", 1), last.series("Fz", "axial, z", 2)}),
                            over_angle("Thickest chip", "thickness", "m", {last.series("thickest", "", 0)}),
                            over_angle("Tool relative to the part", "displacement", "m",
                                       {last.series("x", "x", 0), last.series("y", "y", 1)})};
  add_spectra(charts, folder, status);
  if (Chart energies = energy_chart(history); !energies.series.empty()) charts.push_back(std::move(energies));
  const results::HistoryTable surface = results::read_history(path);
  if (surface.rows() < 2) return charts;
  Chart left{.title = "Machined surface",
             .x_label = "along the feed",
             .x_unit = "m",
             .y_label = "left on it",
             .y_unit = "m",
             .series = {},
             .note = "Positive: material is left beyond where still teeth would have passed. By height over "
                     "the bottom of the workpiece."};
  const std::size_t layers = surface.column.size() - 1;
  std::size_t before = 0;
  int colour = 0;
  for (const std::size_t layer : {std::size_t{1}, 1 + layers / 2, layers}) {
    if (layer == before) continue;
    before = layer;
    const std::string name = results::split_column_name(surface.names[layer]).name;
    const std::string height = name.substr(name.rfind("at_") + 3); // "0.796875_mm"
    left.series.push_back({.label = results::number_format(std::stod(height), 3) + " mm",
                           .x = surface.column[0],
                           .y = surface.column[layer],
                           .colour = colour++});
  }
  charts.push_back(std::move(left));
  return charts;
}

std::vector<Figure> milling_figures(const results::RunStatus& status, const results::ShownUnits& units) {
  std::vector<Figure> figures;
  const auto add = [&](const char* metric, const char* name, const char* note) {
    const std::string known = std::string("milling.") + metric;
    if (const auto value = status.metric(known))
      figures.push_back({name, units.format(*value, status.unit_of(known)), note});
  };
  add("Fx", "Largest Fx", "along the feed, of the last turns");
  add("Fy", "Largest Fy", "across it");
  add("power", "Power", "mean of the last turns");
  add("peak_to_valley", "Peak to valley", "along the feed");
  add("location_error", "Location error", "positive: material is left");
  add("chip_growth", "Chips", "times as thick as without vibration");
  add("chatter_frequency", "Chatter", "the strongest vibration that is no harmonic");
  return figures;
}

} // namespace cnem::report
