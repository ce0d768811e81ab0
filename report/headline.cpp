#include "report/headline.hpp"

#include "core/index.hpp"
#include "evaluate/force_stroke.hpp"
#include "report/html.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <fmt/format.h>
#include <optional>

namespace cnem::report {
namespace {

using evaluate::ShearedFace;
using results::number_format;

/// The faces of one body that were found, at all angles.
using Faces = std::vector<const ShearedFace*>;

/// "29–33 %" of the thickness, over the bodies; in space their means round the punch.
Figure zone_figure(const char* name, const std::vector<Faces>& bodies, bool round,
                   double ShearedFace::*size) {
  double low = INFINITY, high = 0.0;
  for (const Faces& faces : bodies) {
    const double share = 100.0 * evaluate::round_height(faces, size).mean /
                         evaluate::round_height(faces, &ShearedFace::thickness).mean;
    low = std::min(low, share);
    high = std::max(high, share);
  }
  const std::string least = fmt::format("{:.0f}", low), most = fmt::format("{:.0f}", high);
  return {name, (least == most ? most : least + "–" + most) + " %",
          fmt::format("of the thickness{}{}",
                      bodies.size() > 1 ? fmt::format(", {} faces", bodies.size()) : "",
                      round ? ", means round the punch" : "")};
}

/// Whether the bodies have not come off everywhere; in space at how many angles.
std::optional<Figure> not_through(const std::vector<Faces>& bodies) {
  const char* note = "heights are those so far";
  std::size_t parted = SIZE_MAX, angles = 0;
  for (const Faces& faces : bodies) {
    angles = std::max(angles, faces.size());
    parted = std::min(
        parted, index_of(std::ranges::count_if(faces, [](const ShearedFace* face) { return face->parted; })));
  }
  if (bodies.empty() || parted >= angles) return std::nullopt;
  return Figure{"Cut through", parted > 0 ? fmt::format("at {} of {} angles", parted, angles) : "no", note};
}

std::vector<Figure> of_faces(const evaluate::BlankingResult& result, const results::ShownUnits& units) {
  std::vector<Figure> figures;
  std::vector<Faces> bodies = evaluate::faces_of_bodies(result);
  if (auto figure = not_through(bodies)) figures.push_back(std::move(*figure));
  for (Faces& faces : bodies)
    std::erase_if(faces, [](const ShearedFace* face) { return !face->measured || !face->found(); });
  std::erase_if(bodies, [](const Faces& faces) { return faces.empty(); });
  if (bodies.empty()) return figures;
  const bool round = std::isfinite(bodies.front().front()->angle);
  const auto largest = [&](double ShearedFace::*size) {
    double most = 0.0;
    for (const Faces& faces : bodies)
      for (const ShearedFace* face : faces) most = std::max(most, face->*size);
    return most;
  };
  const auto add = [&](const char* name, double ShearedFace::*size) {
    figures.push_back(zone_figure(name, bodies, round, size));
  };
  add("Rollover", &ShearedFace::rollover);
  add("Burnish", &ShearedFace::burnish);
  if (largest(&ShearedFace::broken) > 0.0) add("Broken, not open", &ShearedFace::broken);
  add("Fracture", &ShearedFace::fracture);
  if (largest(&ShearedFace::second_burnish) > 0.0) add("Second burnish", &ShearedFace::second_burnish);
  figures.push_back({"Burr", units.format(largest(&ShearedFace::burr), "m", 3),
                     round || bodies.size() > 1 ? "the largest" : ""});
  return figures;
}

std::vector<Figure> of_blanking(const evaluate::BlankingResult& result, const results::ShownUnits& units) {
  std::vector<Figure> figures;
  const bool round = result.force_unit == "N";
  for (const evaluate::ToolForce& force : result.forces) {
    if (force.tool != result.punch) continue;
    const std::string cuts =
        result.cut_length > 1.0 ? fmt::format("{:.0f} cuts", result.cut_length) : std::string("one cut");
    const auto along = [&](double value, const char* whole, const char* per_length) -> Figure {
      if (!(result.cut_length > 0.0)) return {"", units.format(value, round ? whole : per_length), ""};
      const std::string by_length = units.format(value / result.cut_length, per_length);
      if (round) return {"", units.format(value, whole), by_length + " of cut length"};
      return {"", by_length,
              fmt::format("of cut length; {} of depth, {}", units.format(value, per_length), cuts)};
    };
    figures.push_back(along(force.largest, "N", "N/m"));
    figures.back().name = "Largest force of " + force.tool;
    figures.push_back({"Stroke at the largest force", units.format(force.stroke, "m"), ""});
    if (!result.faces.empty())
      figures.back().note =
          fmt::format("{:.0f} % of the thickness", 100.0 * force.stroke / result.faces.front().thickness);
    figures.push_back(along(force.work, "J", "J/m"));
    figures.back().name = "Work of " + force.tool;
  }
  for (Figure& figure : of_faces(result, units)) figures.push_back(std::move(figure));
  return figures;
}

std::vector<Figure> of_cutting(const evaluate::CuttingResult& result, const results::ShownUnits& units) {
  std::vector<Figure> figures;
  const auto add = [&](const char* name, double value, const char* unit, const std::string& note) {
    if (std::isfinite(value)) figures.push_back({name, units.format(value, unit), note});
  };
  const std::string width = fmt::format("{} of width", units.format(result.width, "m"));
  if (!result.steady) figures.push_back({"Steady", "no", result.steady_note});
  add("Cutting force Fc", result.in_newton(result.Fc), "N", width);
  add("Thrust force Ft", result.in_newton(result.Ft), "N", width);
  add("Chip thickness", result.chip_thickness, "m",
      std::isfinite(result.chip_ratio) ? number_format(result.chip_ratio, 3) + " times the feed" : "");
  add("Largest temperature", result.temperature_max, "K", "");
  add("Temperature of the rake face", result.interface_temperature, "K", "mean over the contact");
  add("Contact length", result.contact_length, "m", "");
  add("Specific cutting energy", result.specific_energy, "J/m^3", "");
  return figures;
}

std::vector<Figure> of_cracks(const HeadlineSource& source) {
  std::vector<Figure> figures;
  for (const auto& [name, value] : source.status.metrics)
    for (const char* mode : {"K_I.", "K_II."})
      if (name.starts_with(mode))
        figures.push_back({fmt::format("{} of {}", std::string(mode, name.find('.')),
                                       words(name.substr(name.find('.') + 1))),
                           source.units.format(value, source.status.unit_of(name)), ""});
  return figures;
}

/// Lengths of a body that no tool was asked about.
std::vector<Figure> of_lengths(const HeadlineSource& source) {
  std::vector<Figure> figures;
  for (const char axis : {'x', 'y', 'z'}) {
    const std::optional<double> now = source.status.metric(fmt::format("extent.{}", axis)),
                                before = source.status.metric(fmt::format("initial_extent.{}", axis));
    if (!now || !before || std::abs(*now - *before) < 1e-4 * *before) continue;
    figures.push_back({fmt::format("Length along {}", axis), source.units.format(*now, "m", 5),
                       "was " + source.units.format(*before, "m", 5)});
  }
  return figures;
}

std::vector<Figure> of_force(const HeadlineSource& source) {
  if (!source.history || source.history->rows() < 2) return {};
  const auto leading = evaluate::leading_force(*source.history);
  if (!leading) return {};
  const evaluate::ForceCurve curve = evaluate::force_curve(*source.history, *leading);
  const std::string unit =
      results::split_column_name(
          source.history->names[index_of(source.history->find(leading->of + ".force_x"))])
          .unit;
  Figure figure{"Largest force of " + words(leading->of),
                source.units.format(std::abs(curve.smooth[curve.largest]), unit),
                unit == "N" ? "" : "of depth, as modelled"};
  std::replace(figure.name.begin(), figure.name.end(), '.', ' ');
  if (leading->over_stroke)
    figure.note += fmt::format("{}at a stroke of {}", figure.note.empty() ? "" : "; ",
                               source.units.format(curve.even_stroke[curve.largest], "m", 3));
  std::vector<Figure> figures{std::move(figure)};
  if (leading->over_stroke && std::isfinite(curve.work) && curve.work != 0.0)
    figures.push_back({"Work of " + leading->of, source.units.format(curve.work, unit == "N" ? "J" : "J/m"),
                       unit == "N" ? "" : "of depth, as modelled"});
  return figures;
}

/// The largest values that the history has, of any time.
std::vector<Figure> of_extremes(const HeadlineSource& source) {
  std::vector<Figure> figures;
  for (std::size_t k = 0; source.history && k < source.history->names.size(); ++k) {
    const results::ColumnName column = results::split_column_name(source.history->names[k]);
    if (!column.name.starts_with("max.")) continue;
    double most = -INFINITY, least = INFINITY;
    for (const double value : source.history->column[k])
      if (std::isfinite(value)) {
        most = std::max(most, value);
        least = std::min(least, value);
      }
    if (std::isfinite(most) && most > least) // else nothing has happened to it
      figures.push_back(
          {"Largest " + words(column.name.substr(4)), source.units.format(most, column.unit), ""});
  }
  return figures;
}

std::vector<Figure> of_statics(const HeadlineSource& source) {
  std::vector<Figure> figures;
  for (const auto& [name, words] :
       {std::pair{"largest_displacement", "Largest displacement"}, {"strain_energy", "Strain energy"}})
    if (const auto value = source.status.metric(name))
      figures.push_back({words, source.units.format(*value, source.status.unit_of(name)), ""});
  return figures;
}

} // namespace

std::vector<Figure> headline(const HeadlineSource& source) {
  const bool cut = source.blanking && !source.blanking->punch.empty();
  if (cut) return of_blanking(*source.blanking, source.units);
  if (source.cutting) return of_cutting(*source.cutting, source.units);
  std::vector<Figure> figures = of_cracks(source);
  const bool driven = source.history && evaluate::moving_tool(*source.history);
  using Part = std::vector<Figure> (*)(const HeadlineSource&);
  const std::array<Part, 4> parts = driven
                                        ? std::array<Part, 4>{of_statics, of_force, of_extremes, of_lengths}
                                        : std::array<Part, 4>{of_statics, of_lengths, of_extremes, of_force};
  for (const Part& part : parts)
    for (Figure& one : part(source)) figures.push_back(std::move(one));
  return figures;
}

} // namespace cnem::report
