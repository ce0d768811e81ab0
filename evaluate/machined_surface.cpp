#include "evaluate/machined_surface.hpp"

#include "core/index.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace cnem::evaluate {
namespace {

constexpr double clear_of_tool =
    1.0; ///< feeds: so near to the tool, and to where the cut began, nothing is measured
constexpr double longest_surface = 5.0;  ///< feeds
constexpr double shortest_surface = 0.5; ///< feeds
constexpr double deepest_layer = 3.0;    ///< feeds

/// Nodes of the outline from the tip back to where the cut began.
std::vector<std::size_t> surface_of(const CutOutline& outline, double feed) {
  std::vector<std::size_t> places;
  double furthest = 0.0;
  for (std::size_t k = outline.point.size(); k-- > 1;) {
    const Vec2& x = outline.point[k];
    if (x.y() < -0.5 * feed || x.x() > furthest + 0.25 * feed) break; // round the corner
    furthest = std::min(furthest, x.x());
    places.push_back(k);
  }
  return places;
}

struct LayerSums {
  double weight = 0.0, depth = 0.0, along = 0.0, along2 = 0.0, away = 0.0, away2 = 0.0, strain = 0.0,
         temperature = 0.0, nodes = 0.0;
};

DepthLayer layer_of(const LayerSums& sums) {
  const auto spread = [&](double sum, double squares) {
    return std::sqrt(std::max(0.0, squares / sums.weight - sum * sum / (sums.weight * sums.weight)));
  };
  return {sums.depth / sums.weight,        sums.along / sums.weight,
          spread(sums.along, sums.along2), sums.away / sums.weight,
          spread(sums.away, sums.away2),   sums.strain / sums.weight,
          sums.temperature / sums.weight,  sums.nodes};
}

} // namespace

MachinedSurface measure_surface(const CutOutline& outline, std::span<const Vec2> position,
                                const DepthFields& fields, double feed) {
  MachinedSurface surface;
  const std::vector<std::size_t> places = surface_of(outline, feed);
  double begin = 0.0;
  for (const std::size_t k : places) begin = std::min(begin, outline.point[k].x());
  surface.measured.to = -clear_of_tool * feed;
  surface.measured.from =
      std::max(begin + clear_of_tool * feed, surface.measured.to - longest_surface * feed);
  if (surface.measured.length() < shortest_surface * feed) {
    surface.note =
        fmt::format("the cut is too short for its surface to be measured: {:.2g} feeds long, {:.2g} "
                    "are needed",
                    -begin / feed, 2.0 * clear_of_tool + shortest_surface);
    return surface;
  }
  const auto lies = [&](const Vec2& x) {
    return x.x() >= surface.measured.from && x.x() <= surface.measured.to;
  };
  double length = 0.0, sum = 0.0;
  for (std::size_t k = 0; k + 1 < places.size(); ++k) {
    const Vec2 &a = outline.point[places[k]], &b = outline.point[places[k + 1]], middle = 0.5 * (a + b);
    if (!lies(middle)) continue;
    length += (b - a).norm();
    sum += (b - a).norm() * middle.y();
  }
  if (!(length > 0.0)) {
    surface.note = "the surface has too few nodes to be measured";
    return surface;
  }
  surface.height = sum / length;
  double rough = 0.0, count = 0.0;
  for (const std::size_t k : places)
    if (lies(outline.point[k])) {
      rough += std::abs(outline.point[k].y() - surface.height);
      ++count;
    }
  surface.roughness = count > 0.0 ? rough / count : unknown;

  const auto depth = [&](std::size_t i) { return surface.height - position[i].y(); };
  const auto below = [&](std::size_t i, double most) {
    return lies(position[i]) && depth(i) < most && depth(i) > -0.5 * feed;
  };
  double area = 0.0, nodes = 0.0;
  for (std::size_t i = 0; i < position.size(); ++i)
    if (below(i, feed)) {
      area += fields.volume[i];
      ++nodes;
    }
  if (nodes == 0.0) return surface;
  surface.layer = std::sqrt(area / nodes);
  std::vector<LayerSums> layers;
  for (std::size_t i = 0; i < position.size(); ++i) {
    if (!below(i, deepest_layer * feed)) continue;
    const auto k = index_of(std::lround(std::max(0.0, depth(i)) / surface.layer));
    if (layers.size() <= k) layers.resize(k + 1);
    LayerSums& layer = layers[k];
    const double w = fields.volume[i];
    layer.weight += w;
    layer.depth += w * depth(i);
    layer.along += w * fields.along[i];
    layer.along2 += w * fields.along[i] * fields.along[i];
    layer.away += w * fields.away[i];
    layer.away2 += w * fields.away[i] * fields.away[i];
    layer.strain += w * fields.plastic_strain[i];
    layer.temperature += w * fields.temperature[i];
    ++layer.nodes;
  }
  for (const LayerSums& layer : layers)
    if (layer.weight > 0.0) surface.layers.push_back(layer_of(layer));
  return surface;
}

} // namespace cnem::evaluate
