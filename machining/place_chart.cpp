// Limits along the path of a cutter: lobes of the modes as it meets them there.
#include "machining/stability.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace cnem::machining {

PlaceChart place_chart(const MillingCut& cut, const std::vector<std::vector<Mode>>& modes,
                       std::vector<double> places, double from, double to, int speeds, double deepest,
                       int depths) {
  assert(modes.size() == places.size());
  PlaceChart chart{.place = std::move(places), .moves = {}, .speed = {}, .limit = {}};
  for (const std::vector<Mode>& there : modes) {
    chart.moves.push_back(!there.empty());
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

std::size_t PlaceChart::weakest(double spindle) const {
  const auto near = std::min_element(speed.begin(), speed.end(), [&](double a, double b) {
    return std::abs(a - spindle) < std::abs(b - spindle);
  });
  const auto column = static_cast<std::size_t>(near - speed.begin());
  const auto first = std::find(moves.begin(), moves.end(), true);
  assert(first != moves.end());
  auto weakest = static_cast<std::size_t>(first - moves.begin());
  double least = infinite;
  for (std::size_t k = 0; k < place.size(); ++k)
    if (const auto& there = limit[k * speed.size() + column]; there && there->depth < least) {
      least = there->depth;
      weakest = k;
    }
  return weakest;
}

} // namespace cnem::machining
