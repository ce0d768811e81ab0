// Limits along the path of a cutter: lobes of the modes as it meets them there.
#include "machining/stability.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace cnem::machining {

std::vector<Mode> modes_at_place(std::span<const Mode> modes, double place) {
  std::vector<Mode> there;
  for (const Mode& mode : modes)
    if (mode.moves_at(place)) there.push_back(mode.at(place));
  return there;
}

PlaceChart place_chart(const MillingCut& cut, std::span<const Mode> modes, std::vector<double> places,
                       double from, double to, int speeds, double deepest, int depths) {
  PlaceChart chart{.place = std::move(places), .speed = {}, .limit = {}};
  for (const double place : chart.place) {
    const std::vector<Mode> there = modes_at_place(modes, place);
    if (there.empty()) { // nothing moves: no depth is too large
      chart.limit.resize(chart.limit.size() + static_cast<std::size_t>(speeds));
      continue;
    }
    StabilityChart lobes = stability_chart(cut, there, from, to, speeds, deepest, depths);
    chart.speed = std::move(lobes.speed);
    chart.limit.insert(chart.limit.end(), lobes.limit.begin(), lobes.limit.end());
  }
  return chart;
}

std::size_t PlaceChart::weakest(double spindle, std::span<const Mode> modes) const {
  const auto near = std::min_element(speed.begin(), speed.end(), [&](double a, double b) {
    return std::abs(a - spindle) < std::abs(b - spindle);
  });
  const auto column = static_cast<std::size_t>(near - speed.begin());
  const auto moves = std::find_if(place.begin(), place.end(), [&](double x) {
    return std::any_of(modes.begin(), modes.end(), [x](const Mode& mode) { return mode.moves_at(x); });
  });
  assert(moves != place.end());
  auto weakest = static_cast<std::size_t>(moves - place.begin());
  double least = infinite;
  for (std::size_t k = 0; k < place.size(); ++k)
    if (const auto& there = limit[k * speed.size() + column]; there && there->depth < least) {
      least = there->depth;
      weakest = k;
    }
  return weakest;
}

} // namespace cnem::machining
