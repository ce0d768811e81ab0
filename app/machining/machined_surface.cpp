#include "app/machining/machined_surface.hpp"

#include "core/error.hpp"
#include "core/index.hpp"
#include "results/si_format.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <numeric>

namespace cnem::app {

using machining::MillingProcess;
using results::si_format;

MachinedSurface::MachinedSurface(const MillingProcess& process, const input::MachiningCase& milling)
    : process_(process), up_(milling.cut.engagement.side == machining::Engagement::Side::up) {
  const double turn = process.feed_of_turn(), pitch = milling.dexels.pitch;
  const machining::ToolPath* path = process.motion().last_path();
  const bool outside = milling.start == machining::ProcessSettings::Start::outside;
  const double start = process.motion().start(), end = path ? path->length() : process.axis().x();
  // Teeth have passed there: from where the first turns have been to where the last one is.
  const double from = start + std::max(2.0 * turn, outside || path ? 0.0 : 0.5 * (end - start)),
               to = end - turn;
  std::vector<double> places;
  for (double at = std::max(from, 0.0); at <= to; at += pitch) places.push_back(at);
  asked_ = places.size();
  std::vector<bool> found(places.size(), false);
  for (std::size_t k = 0; k < process.layers().size(); ++k)
    if (process.cuts(k)) add_layer(k, places, found);
  const auto keep_found = [&](std::vector<double>& values) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < found.size(); ++i)
      if (found[i]) values[kept++] = values[i];
    values.resize(kept);
  };
  for (std::vector<double>& left : left_) keep_found(left);
  keep_found(places);
  place_ = std::move(places);
}

void MachinedSurface::add_layer(std::size_t layer, const std::vector<double>& places,
                                std::vector<bool>& found) {
  std::optional<machining::DexelLayer> stock;
  if (process_.motion().last_path()) stock = process_.stock(layer);
  const auto left = [&](double way) -> std::optional<double> {
    if (stock) return process_.left_beside(layer, way, *stock);
    if (const auto of_straight = process_.left_at(layer, way)) return of_straight;
    throw DivergenceError(
        fmt::format("nothing is left of the workpiece at {} along the path and {} over the tip: the "
                    "cutter has gone through it, expected vibrations that are small beside the cut",
                    si_format(way, "m"), si_format(process_.height(layer), "m")),
        -1, "displacement");
  };
  std::vector<double> here;
  bool any = false;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const std::optional<double> at = left(places[i]);
    here.push_back(at.value_or(std::numeric_limits<double>::quiet_NaN()));
    if (at) any = found[i] = true;
  }
  if (!any) return; // over the stock, or beside all of it
  // Tips of scallops lie between dexels.
  constexpr int finer = 16;
  std::vector<double> height;
  for (std::size_t i = 0; i + 1 < places.size(); ++i)
    for (int part = 0; part < finer; ++part)
      if (const auto at = left(places[i] + part * (places[i + 1] - places[i]) / finer)) height.push_back(*at);
  layer_.push_back(layer);
  left_.push_back(std::move(here));
  texture_.push_back(height.empty() ? std::nullopt : std::optional(texture_of(height)));
}

MachinedSurface::Texture MachinedSurface::texture_of(const std::vector<double>& height) {
  constexpr std::size_t lengths = 5;
  Texture texture;
  texture.location_error =
      std::accumulate(height.begin(), height.end(), 0.0) / static_cast<double>(height.size());
  for (const double h : height)
    texture.Ra += std::abs(h - texture.location_error) / static_cast<double>(height.size());
  const auto [low, high] = std::minmax_element(height.begin(), height.end());
  texture.peak_to_valley = *high - *low;
  for (std::size_t k = 0; k < lengths && height.size() >= lengths; ++k) { // ISO 4287
    const auto from = height.begin() + static_cast<std::ptrdiff_t>(k * height.size() / lengths);
    const auto to = height.begin() + static_cast<std::ptrdiff_t>((k + 1) * height.size() / lengths);
    const auto [least, most] = std::minmax_element(from, to);
    texture.Rz += (*most - *least) / lengths;
  }
  return texture;
}

std::string MachinedSurface::tell(results::RunStatus& status) const {
  if (asked_ < 2) return "the path is too short for a surface";
  if (place_.empty()) return "the last pass takes nothing of its side: there is no surface";
  const auto zone = [&](const std::string& name, double from, double to) -> std::optional<Texture> {
    Texture all;
    double height = 0.0; // m, of what counts
    for (std::size_t i = 0; i < layer_.size(); ++i) {
      const machining::Slice& slice = process_.slices()[layer_[i]];
      if (!texture_[i] || slice.middle() < from || slice.middle() >= to) continue;
      const Texture& layer = *texture_[i];
      height += slice.thickness;
      all.Ra += slice.thickness * layer.Ra;
      all.Rz += slice.thickness * layer.Rz;
      all.peak_to_valley = std::max(all.peak_to_valley, layer.peak_to_valley);
      if (std::abs(layer.location_error) > std::abs(all.location_error))
        all.location_error = layer.location_error;
    }
    if (height == 0.0) return std::nullopt;
    all.Ra /= height;
    all.Rz /= height;
    for (const auto& [what, value] : {std::pair{"Ra", all.Ra},
                                      {"Rz", all.Rz},
                                      {"peak_to_valley", all.peak_to_valley},
                                      {"location_error", all.location_error}})
      status.add_metric(fmt::format("{}.{}[m]", name, what), value);
    return all;
  };
  const std::optional<Texture> whole = zone("milling", -infinite, infinite);
  if (!whole) return "the machined side is too short for a surface";
  double low = infinite, high = -infinite; // m, of what the last pass reaches
  int reached = 0;
  for (std::size_t k = 0; k < process_.layers().size(); ++k)
    if (process_.cuts(k)) {
      const machining::Slice& slice = process_.slices()[k];
      low = std::min(low, slice.low);
      high = std::max(high, slice.low + slice.thickness);
      ++reached;
    }
  const double third = (high - low) / 3.0;
  if (reached >= 3) {
    zone("milling.bottom", low, low + third);
    zone("milling.middle", low + third, high - third);
    zone("milling.top", high - third, high);
  }
  return fmt::format("the surface is {} from peak to valley along the feed, and off its place by {}",
                     si_format(whole->peak_to_valley, "m"), si_format(whole->location_error, "m"));
}

std::string MachinedSurface::csv() const {
  std::string text = process_.motion().last_path() ? "way[m]" : "x[m]";
  for (const std::size_t k : layer_) text += fmt::format(",left_at_{:.6g}_mm[m]", 1e3 * process_.height(k));
  text += '\n';
  for (std::size_t i = 0; i < place_.size(); ++i) {
    text += fmt::format("{}", place_[i]);
    for (const std::vector<double>& left : left_) text += fmt::format(",{:.9g}", left[i]);
    text += '\n';
  }
  return text;
}

std::string MachinedSurface::vtk() const {
  std::string text =
      fmt::format("# vtk DataFile Version 3.0\nmachined surface, m\nASCII\nDATASET STRUCTURED_GRID\n"
                  "DIMENSIONS {} {} 1\nPOINTS {} double\n",
                  place_.size(), layer_.size(), place_.size() * layer_.size());
  const machining::ToolPath* path = process_.motion().last_path();
  for (std::size_t k = 0; k < layer_.size(); ++k)
    for (std::size_t i = 0; i < place_.size(); ++i) {
      const machining::ToolPath::Place at =
          path ? path->at(place_[i]) : machining::ToolPath::Place{Vec2(place_[i], 0.0), Vec2::UnitX()};
      const Vec2 side = up_ ? left_normal(at.along) : right_normal(at.along);
      const double left = std::isfinite(left_[k][i]) ? left_[k][i] : 0.0; // a grid has all of its points
      const Vec2 x = at.at + (process_.radius(layer_[k]) - left) * side;
      text += fmt::format("{:.9g} {:.9g} {:.9g}\n", x.x(), x.y(), process_.height(layer_[k]));
    }
  text += fmt::format("POINT_DATA {}\nSCALARS left_m double 1\nLOOKUP_TABLE default\n",
                      place_.size() * layer_.size());
  for (const std::vector<double>& row : left_)
    for (const double left : row) text += fmt::format("{:.9g}\n", std::isfinite(left) ? left : 0.0);
  text += "SCALARS machined int 1\nLOOKUP_TABLE default\n";
  for (const std::vector<double>& row : left_)
    for (const double left : row) text += std::isfinite(left) ? "1\n" : "0\n";
  return text;
}

std::optional<report::SurfaceMap> MachinedSurface::map() const {
  if (place_.size() < 2 || layer_.size() < 2) return std::nullopt;
  report::SurfaceMap map{.along = place_, .height = {}, .value = {}};
  for (const std::size_t k : layer_) map.height.push_back(process_.height(k));
  for (std::size_t k = 0; k + 1 < layer_.size(); ++k)
    for (std::size_t i = 0; i + 1 < place_.size(); ++i)
      map.value.push_back(0.25 * (left_[k][i] + left_[k][i + 1] + left_[k + 1][i] + left_[k + 1][i + 1]));
  return map;
}

} // namespace cnem::app
