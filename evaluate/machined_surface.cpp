#include "evaluate/machined_surface.hpp"

#include "core/index.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>

namespace cnem::evaluate {
namespace {

constexpr double longest_surface = 5.0;  ///< feeds
constexpr double shortest_surface = 0.5; ///< feeds
constexpr double deepest_layer = 3.0;    ///< feeds

constexpr double deep = 0.05;        ///< feeds: bodies that reach deeper are of the workpiece
constexpr double near_surface = 0.5; ///< feeds, above and below the tip

/// The same loop from its node nearest to the tip on.
CutOutline from_the_tip(CutOutline outline) {
  const auto nearer = [](const Vec2& a, const Vec2& b) { return a.squaredNorm() < b.squaredNorm(); };
  const auto tip = std::min_element(outline.point.begin(), outline.point.end(), nearer);
  std::rotate(outline.node.begin(), outline.node.begin() + (tip - outline.point.begin()), outline.node.end());
  std::rotate(outline.point.begin(), tip, outline.point.end());
  return outline;
}

/// From the tip back to where the cut began.
std::vector<Vec2> surface_of(const CutOutline& outline, double feed) {
  std::vector<Vec2> profile;
  double furthest = 0.0;
  for (std::size_t k = outline.point.size(); k-- > 1;) {
    const Vec2& x = outline.point[k];
    if (x.y() < -near_surface * feed || x.x() > furthest + 0.25 * feed) break; // round the corner
    furthest = std::min(furthest, x.x());
    profile.push_back(x);
  }
  return profile;
}

/// Mean over five equal lengths of a stretch; not-a-number where one of them has fewer than two nodes.
double highest_over_lowest(const SurfaceProfile& profile, const Stretch& stretch) {
  constexpr std::size_t lengths = 5;
  std::array<Stretch, lengths> height;
  height.fill({INFINITY, -INFINITY});
  std::array<int, lengths> nodes{};
  for (const std::vector<Vec2>& of_body : profile)
    for (const Vec2& x : of_body) {
      if (x.x() < stretch.from || x.x() > stretch.to) continue;
      const auto at = std::min(lengths - 1,
                               static_cast<std::size_t>(lengths * (x.x() - stretch.from) / stretch.length()));
      height[at] = {std::min(height[at].from, x.y()), std::max(height[at].to, x.y())};
      ++nodes[at];
    }
  if (*std::min_element(nodes.begin(), nodes.end()) < 2) return unknown;
  double sum = 0.0;
  for (const Stretch& own : height) sum += own.length();
  return sum / lengths;
}

struct Moments {
  double sum = 0.0, squares = 0.0;

  void add(double weight, double value) {
    sum += weight * value;
    squares += weight * value * value;
  }
  LayerMean over(double weight) const {
    const double variance = squares / weight - sum * sum / (weight * weight);
    return {sum / weight, std::sqrt(std::max(variance, 0.0))};
  }
};

struct LayerSums {
  double weight = 0.0, depth = 0.0, strain = 0.0, temperature = 0.0, nodes = 0.0;
  NormalStresses<Moments> loaded, residual;

  void add(const DepthFields& fields, std::size_t i, double below) {
    const double w = fields.volume[i];
    const auto add_stresses = [&](NormalStresses<Moments>& sums, const DepthFields::Stresses& stress) {
      sums.along.add(w, stress.along[i]);
      sums.away.add(w, stress.away[i]);
      sums.across.add(w, stress.across[i]);
    };
    weight += w;
    depth += w * below;
    add_stresses(loaded, fields.loaded);
    add_stresses(residual, fields.residual);
    strain += w * fields.plastic_strain[i];
    temperature += w * fields.temperature[i];
    ++nodes;
  }
  DepthLayer mean() const {
    const auto means = [&](const NormalStresses<Moments>& sums) {
      return NormalStresses<LayerMean>{sums.along.over(weight), sums.away.over(weight),
                                       sums.across.over(weight)};
    };
    return {depth / weight, means(loaded), means(residual), strain / weight, temperature / weight, nodes};
  }
};

} // namespace

SurfaceProfile machined_profile(const IndexedVector<CloudFacetIndex, Facet<2>>& facets,
                                std::span<const Vec2> position, double feed) {
  std::vector<CutOutline> bodies = outlines_of_bodies(facets, position);
  if (bodies.size() > 1)
    std::erase_if(bodies, [&](const CutOutline& body) {
      return std::none_of(body.point.begin(), body.point.end(),
                          [&](const Vec2& x) { return x.y() < -deep * feed; });
    });
  if (bodies.empty()) return {};
  if (bodies.size() == 1) return {surface_of(from_the_tip(std::move(bodies.front())), feed)};
  // Walls between bodies are seen where they lean: places stand at equal distances, nodes would crowd there.
  struct Segment {
    Vec2 from, to; ///< from left to right
    std::size_t body;
  };
  std::vector<Segment> segments;
  double left = 0.0;
  for (std::size_t n = 0; n < bodies.size(); ++n) {
    const std::vector<Vec2>& points = bodies[n].point;
    for (std::size_t k = 0; k < points.size(); ++k) {
      const Vec2 &a = points[k], &b = points[(k + 1) % points.size()];
      if (std::max(std::abs(a.y()), std::abs(b.y())) > near_surface * feed || a.x() == b.x()) continue;
      segments.push_back(a.x() < b.x() ? Segment{a, b, n} : Segment{b, a, n});
      left = std::min(left, segments.back().from.x());
    }
  }
  const double apart = feed / 50.0;
  SurfaceProfile profile;
  std::size_t before = bodies.size(); // none
  for (int k = 0; - apart * k >= left; ++k) {
    const double x = -apart * k;
    double highest = -INFINITY;
    std::size_t body = bodies.size();
    for (const auto& [a, b, n] : segments) {
      if (!(a.x() <= x && x <= b.x())) continue;
      const double y = a.y() + (x - a.x()) / (b.x() - a.x()) * (b.y() - a.y());
      if (y > highest) highest = y, body = n;
    }
    const bool gap = body == bodies.size();
    if (!gap && body != before) profile.emplace_back();
    if (!gap) profile.back().emplace_back(x, highest);
    before = body;
  }
  return profile;
}

MachinedSurface measure_surface(const SurfaceProfile& profile, std::span<const Vec2> position,
                                const DepthFields& fields, double feed, double travelled, double clear) {
  MachinedSurface surface;
  double begin = 0.0;
  for (const std::vector<Vec2>& stretch : profile)
    for (const Vec2& x : stretch) begin = std::min(begin, x.x());
  begin = std::max(begin, -travelled);
  surface.measured.to = -clear;
  surface.measured.from = std::max(begin + clear, surface.measured.to - longest_surface * feed);
  if (surface.measured.length() < shortest_surface * feed) {
    surface.note =
        fmt::format("the cut is too short for its surface to be measured: {:.2g} feeds long, {:.2g} "
                    "are needed",
                    -begin / feed, 2.0 * clear / feed + shortest_surface);
    return surface;
  }
  const auto lies = [&](const Vec2& x) {
    return x.x() >= surface.measured.from && x.x() <= surface.measured.to;
  };
  double length = 0.0, sum = 0.0;
  for (const std::vector<Vec2>& stretch : profile)
    for (std::size_t k = 0; k + 1 < stretch.size(); ++k) {
      const Vec2 &a = stretch[k], &b = stretch[k + 1], middle = 0.5 * (a + b);
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
  for (const std::vector<Vec2>& stretch : profile)
    for (const Vec2& x : stretch)
      if (lies(x)) {
        rough += std::abs(x.y() - surface.height);
        ++count;
      }
  surface.roughness = count > 0.0 ? rough / count : unknown;
  surface.Rz = highest_over_lowest(profile, surface.measured);

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
    layers[k].add(fields, i, depth(i));
    surface.yield_ratio = std::fmax(surface.yield_ratio, fields.yield_ratio[i]);
  }
  for (const LayerSums& layer : layers)
    if (layer.weight > 0.0) surface.layers.push_back(layer.mean());
  return surface;
}

} // namespace cnem::evaluate
