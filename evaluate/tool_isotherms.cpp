#include "evaluate/tool_isotherms.hpp"

#include "core/index.hpp"

#include <algorithm>
#include <cmath>

namespace cnem::evaluate {
namespace {

/// A place in the frame of the rake face: along it from the tip, and below it; m.
struct Place {
  double along, below, temperature;
};

/// visit(place) for the ends of a straight line that are warm enough, and for where it crosses the isotherm.
template<class Visit> void each_warm(const Place& a, const Place& b, double temperature, Visit&& visit) {
  for (const Place& end : {a, b})
    if (end.temperature >= temperature) visit(end);
  if ((a.temperature < temperature) == (b.temperature < temperature)) return;
  const double s = (temperature - a.temperature) / (b.temperature - a.temperature);
  visit({std::lerp(a.along, b.along, s), std::lerp(a.below, b.below, s), temperature});
}

} // namespace

std::vector<Isotherm> tool_isotherms(const ToolSection<2>& section, const Field& temperature,
                                     const input::CuttingTool& cut, std::span<const double> at) {
  const double slack = 1e-6 * (cut.end - cut.begin);
  std::vector<Place> place;
  for (const NodeIndex i : section.cloud.position.indices()) {
    const Vec2 x = section.cloud.position[i] - cut.tip;
    place.push_back(
        {cut.turned(x).dot(cut.face()), -cut.turned(x).dot(cut.normal()), temperature[index_of(i)]});
  }
  const auto on_face = [&](const Place& x) {
    return std::abs(x.below) < slack && x.along > cut.begin - slack && x.along < cut.end + slack;
  };
  std::vector<Isotherm> isotherms;
  for (const double wanted : at) {
    Isotherm line{.temperature = wanted};
    const CellGeometry<2>& triangles = section.approximation.cells;
    for (std::size_t c = 0; c + 1 < triangles.begin.size(); ++c)
      for (auto e = triangles.begin[c], end = triangles.begin[c + 1]; e < end; ++e) {
        const auto next = e + 1 < end ? e + 1 : triangles.begin[c];
        each_warm(place[index_of(triangles.index[index_of(e)])],
                  place[index_of(triangles.index[index_of(next)])], wanted,
                  [&](const Place& x) { line.depth = std::fmax(line.depth, x.below); });
      }
    for (const Facet<2>& facet : section.cloud.facets) {
      const Place &a = place[index_of(facet.node[0])], &b = place[index_of(facet.node[1])];
      if (!on_face(a) || !on_face(b)) continue;
      each_warm(a, b, wanted, [&](const Place& x) {
        line.face_from = std::fmin(line.face_from, x.along);
        line.face_to = std::fmax(line.face_to, x.along);
      });
    }
    isotherms.push_back(line);
  }
  return isotherms;
}

std::vector<double> round_temperatures(const Field& temperature) {
  constexpr double apart = 100.0; // K
  const auto [coldest, warmest] = std::minmax_element(temperature.begin(), temperature.end());
  std::vector<double> round;
  for (double t = apart * std::ceil(*coldest / apart); t <= *warmest; t += apart) round.push_back(t);
  return round;
}

} // namespace cnem::evaluate
