#include "app/machining/machined_surface.hpp"

#include "core/error.hpp"
#include "core/index.hpp"
#include "results/si_format.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
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
  for (std::size_t k = 0; k < process.layers().size(); ++k)
    if (process.cuts(k) && (!path || process.layers()[k].area() > 0.0))
      layer_.push_back(k);    // or over the stock
  if (layer_.empty()) return; // nothing is left beside the way
  left_.resize(layer_.size());
  std::vector<double> here(layer_.size());
  for (double at = std::max(from, 0.0); at <= to; at += pitch) {
    bool all = true;
    for (std::size_t k = 0; k < layer_.size() && all; ++k) {
      const std::optional<double> left = this->left(layer_[k], at);
      all = left.has_value();
      here[k] = left.value_or(0.0);
    }
    if (!all) continue;
    place_.push_back(at);
    for (std::size_t k = 0; k < layer_.size(); ++k) left_[k].push_back(here[k]);
  }
}

std::optional<double> MachinedSurface::left(std::size_t layer, double way) const {
  if (process_.motion().last_path()) return process_.left_beside(layer, way);
  if (const auto left = process_.left_at(layer, way)) return left;
  throw DivergenceError(
      fmt::format("nothing is left of the workpiece at {} along the path and {} over the tip: the "
                  "cutter has gone through it, expected vibrations that are small beside the cut",
                  si_format(way, "m"), si_format(process_.height(layer), "m")),
      -1, "displacement");
}

MachinedSurface::Texture MachinedSurface::texture(std::size_t layer) const {
  // Tips of scallops lie between dexels.
  constexpr int finer = 16;
  constexpr std::size_t lengths = 5;
  std::vector<double> height;
  for (std::size_t i = 0; i + 1 < place_.size(); ++i)
    for (int part = 0; part < finer; ++part)
      if (const auto left = this->left(layer, place_[i] + part * (place_[i + 1] - place_[i]) / finer))
        height.push_back(*left);
  if (height.empty()) return {};
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
  if (place_.size() < 2 || layer_.empty()) return "the path is too short for a surface";
  std::vector<Texture> layers;
  for (const std::size_t k : layer_) layers.push_back(texture(k));
  const auto zone = [&](const std::string& name, std::size_t from, std::size_t to) {
    Texture all;
    for (std::size_t k = from; k < to; ++k) {
      all.Ra += layers[k].Ra / static_cast<double>(to - from);
      all.Rz += layers[k].Rz / static_cast<double>(to - from);
      all.peak_to_valley = std::max(all.peak_to_valley, layers[k].peak_to_valley);
      if (std::abs(layers[k].location_error) > std::abs(all.location_error))
        all.location_error = layers[k].location_error;
    }
    for (const auto& [what, value] : {std::pair{"Ra", all.Ra},
                                      {"Rz", all.Rz},
                                      {"peak_to_valley", all.peak_to_valley},
                                      {"location_error", all.location_error}})
      status.add_metric(fmt::format("{}.{}[m]", name, what), value);
    return all;
  };
  const Texture whole = zone("milling", 0, layers.size());
  if (layers.size() >= 3) {
    const std::array<std::size_t, 4> third{0, layers.size() / 3, 2 * layers.size() / 3, layers.size()};
    for (const auto& [k, name] : {std::pair{0U, "bottom"}, {1U, "middle"}, {2U, "top"}})
      zone(fmt::format("milling.{}", name), third[k], third[k + 1]);
  }
  return fmt::format("the surface is {} from peak to valley along the feed, and off its place by {}",
                     si_format(whole.peak_to_valley, "m"), si_format(whole.location_error, "m"));
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
      const Vec2 x = at.at + (process_.radius(layer_[k]) - left_[k][i]) * side;
      text += fmt::format("{:.9g} {:.9g} {:.9g}\n", x.x(), x.y(), process_.height(layer_[k]));
    }
  text += fmt::format("POINT_DATA {}\nSCALARS left_m double 1\nLOOKUP_TABLE default\n",
                      place_.size() * layer_.size());
  for (const std::vector<double>& row : left_)
    for (const double left : row) text += fmt::format("{:.9g}\n", left);
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
