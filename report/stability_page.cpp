#include "report/stability_page.hpp"

#include "core/index.hpp"
#include "core/rpm.hpp"
#include "results/history_writer.hpp"
#include "results/output_folder.hpp"
#include "results/si_format.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace cnem::report {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

} // namespace

std::optional<Chart> stability_lobes(const std::filesystem::path& folder, const results::RunStatus& status) {
  const std::filesystem::path path = folder / results::files::stability;
  if (!std::filesystem::exists(path)) return std::nullopt;
  const results::HistoryTable table = results::read_history(path);
  const auto column = [&](const char* name) { return table.column[index_of(table.find(name))]; };
  Chart chart{.title = "Stability lobes",
              .x_label = "speed of the spindle",
              .x_unit = "rpm",
              .y_label = "axial depth",
              .y_unit = "m",
              .series = {},
              .note =
                  "Cuts below the line are stable. Zero order: from the mean of the directional factors."};
  const std::vector<double> speed = column("speed[rpm]");
  chart.series.push_back({.label = "limit (Floquet)", .x = speed, .y = column("limit[m]"), .colour = 0});
  chart.series.push_back(
      {.label = "limit (zero order)", .x = speed, .y = column("zero_order[m]"), .colour = 1, .dashed = true});
  double deepest = 0.0;
  for (const double limit : chart.series[0].y)
    if (limit > deepest) deepest = limit;
  const auto at = status.metric("stability.speed"), depth = status.metric("stability.depth");
  for (double& limit : chart.series[1].y) // where it has a limit, the chart of Floquet's says how deep it is
    if (deepest > 0.0 && limit > 1.2 * deepest) limit = std::numeric_limits<double>::quiet_NaN();
  if (at && depth) {
    const double reach = 0.008 * (speed.back() - speed.front()), height = 0.025 * std::max(deepest, *depth);
    const double x = *at / rpm;
    chart.series.push_back({.label = "this cut",
                            .x = {x - reach, x, x + reach, x, x - reach},
                            .y = {*depth, *depth + height, *depth, *depth - height, *depth},
                            .colour = 2});
  }
  return chart;
}

std::optional<Chart> stability_along(const std::filesystem::path& folder, const results::RunStatus& status) {
  const std::filesystem::path path = folder / results::files::stability_places;
  const auto at = status.metric("stability.speed");
  if (!std::filesystem::exists(path) || !at) return std::nullopt;
  const results::HistoryTable table = results::read_history(path);
  std::size_t near = 1, best = 1;
  double nearest = infinite, most = -infinite;
  for (std::size_t k = 1; k < table.column.size(); ++k) {
    const double apart = std::abs(std::stod(table.names[k]) * rpm - *at);
    if (apart < nearest) {
      nearest = apart;
      near = k;
    }
    double least = infinite;
    for (const double limit : table.column[k])
      if (std::isfinite(limit)) least = std::min(least, limit);
    if (least > most) {
      most = least;
      best = k;
    }
  }
  Chart chart{
      .title = "Limits along the path",
      .x_label = "place of the cutter",
      .x_unit = "m",
      .y_label = "axial depth",
      .y_unit = "m",
      .series = {},
      .note =
          "By Floquet's multipliers of the modes as the cutter meets them there. Gaps: beyond the chart."};
  int colour = 0;
  for (const std::size_t k : {near, best}) {
    if (colour > 0 && k == near) break;
    std::string name = results::split_column_name(table.names[k]).name;
    std::replace(name.begin(), name.end(), '_', ' ');
    chart.series.push_back({.label = name + (k == near ? "" : ", which bears most all along"),
                            .x = table.column[0],
                            .y = table.column[k],
                            .colour = colour++});
  }
  return chart;
}

std::vector<Figure> stability_figures(const results::RunStatus& status, const results::ShownUnits& units) {
  std::vector<Figure> figures;
  const auto radius = status.metric("stability.spectral_radius");
  if (!radius) return figures;
  figures.push_back({"Cut", *radius < 1.0 ? "stable" : "unstable",
                     fmt::format("disturbances times {} a period", results::number_format(*radius))});
  if (const auto limit = status.metric("stability.depth_limit"))
    figures.push_back({"Limit of the depth", units.format(*limit, "m"),
                       status.metric("stability.flip").value_or(0.0) != 0.0 ? "flip" : "Hopf"});
  if (const auto frequency = status.metric("stability.chatter_frequency"))
    figures.push_back({"Chatter there", units.format(*frequency, "Hz"), ""});
  if (const auto speed = status.metric("stability.better_speed"))
    figures.push_back({"Better speed", results::number_format(*speed / rpm, 6) + " rpm", "the nearest"});
  return figures;
}

} // namespace cnem::report
