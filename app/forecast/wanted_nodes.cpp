#include "app/forecast/wanted_nodes.hpp"

#include "app/tool_tips.hpp"
#include "core/index.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cnem::app {

double Band::distance(const Vec2& x) const {
  return std::max(0.0, std::abs((x - at).dot(across)) - 0.5 * width);
}

WantedNodes::WantedNodes(const input::Case& input, const Cloud<2>& cloud, const adapt::Structure& structure)
    : rules_(&input.adapt), cloud_(&cloud), structure_(&structure),
      spacing_(adapt::spacing_of(cloud, structure)) {
  if (!rules_->tool_spacing) return;
  for (const input::Tool& tool : input.tools)
    for (const Vec2& tip : tool_tips(tool.outline, *rules_->tool_spacing)) tips_.push_back(tip);
}

double WantedNodes::spacing_at(const Vec2& x) const {
  std::size_t nearest = 0;
  for (std::size_t i = 0; i < spacing_.size(); ++i)
    if ((cloud_->position[i] - x).squaredNorm() < (cloud_->position[nearest] - x).squaredNorm()) nearest = i;
  return spacing_[nearest];
}

double WantedNodes::tool_limit(const Vec2& x) const {
  return rules_->tool_spacing.value_or(0.0) +
         rules_->growth * std::sqrt(squared_distance(tips_, Vec2::Zero(), x));
}

double WantedNodes::added(const std::vector<Band>& bands) const {
  const double growth = rules_->growth;
  const auto band_limit = [&](const Vec2& x) {
    double limit = std::numeric_limits<double>::infinity();
    for (const Band& band : bands) limit = std::min(limit, band.spacing + growth * band.distance(x));
    return limit;
  };
  double nodes = 0.0;
  for (const auto& corner : structure_->mesh.node) {
    const auto at = [&](std::size_t k) -> const Vec2& { return cloud_->position[corner[k]]; };
    const auto spacing = [&](std::size_t k) { return spacing_[index_of(corner[k])]; };
    const double coarsest = std::max({spacing(0), spacing(1), spacing(2)});
    const Vec2 middle = (at(0) + at(1) + at(2)) / 3.0;
    // The limits change by no more than this within the triangle.
    const double change =
        growth * std::max({(at(1) - at(0)).norm(), (at(2) - at(1)).norm(), (at(0) - at(2)).norm()});
    const bool by_tool = !tips_.empty() && tool_limit(middle) - change < coarsest;
    if (!by_tool && band_limit(middle) - change >= coarsest) continue;
    const Vec2 a = at(1) - at(0), b = at(2) - at(0);
    constexpr int parts = 4; // of a side: their centroids are looked at
    const double area = 0.5 * std::abs(a.x() * b.y() - a.y() * b.x()) / (parts * parts);
    const auto look = [&](double u, double v) {
      const double own = spacing(0) + u * (spacing(1) - spacing(0)) + v * (spacing(2) - spacing(0));
      const Vec2 x = at(0) + u * a + v * b;
      double wanted = std::min(own, band_limit(x));
      if (by_tool) wanted = std::min(wanted, tool_limit(x));
      nodes += area / adapt::hexagon * (1.0 / (wanted * wanted) - 1.0 / (own * own));
    };
    for (int i = 0; i < parts; ++i)
      for (int k = 0; i + k < parts; ++k) {
        look((i + 1.0 / 3.0) / parts, (k + 1.0 / 3.0) / parts);
        if (i + k < parts - 1) look((i + 2.0 / 3.0) / parts, (k + 2.0 / 3.0) / parts);
      }
  }
  return nodes;
}

} // namespace cnem::app
