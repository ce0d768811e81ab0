#include "evaluate/cut_flow.hpp"

#include "core/fields/vector_at.hpp"
#include "core/geometry/plane_section.hpp"

#include <cmath>

namespace cnem::evaluate {

std::vector<Vec2> places(const input::CuttingTool& cut, const Vec2& moved, const Fields<2>& position) {
  std::vector<Vec2> all(position[0].size());
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = cut.place(vector_at<2>(position, i), moved);
  return all;
}

Vec2 mean_velocity(std::span<const Vec2> polygon, const input::CuttingTool& cut, std::span<const Vec2> place,
                   const NodeState<2>& node) {
  Vec2 momentum(0, 0);
  double mass = 0.0;
  if (!polygon.empty()) {
    Vec2 low = polygon.front(), high = low;
    for (const Vec2& x : polygon) {
      low = low.cwiseMin(x);
      high = high.cwiseMax(x);
    }
    for (std::size_t i = 0; i < place.size(); ++i) {
      const Vec2& x = place[i];
      if ((x.array() < low.array()).any() || (x.array() > high.array()).any() || !inside(polygon, x))
        continue;
      momentum += node.mass[i] * cut.turned(vector_at<2>(node.velocity, i));
      mass += node.mass[i];
    }
  }
  return mass > 0.0 ? Vec2(momentum / mass) : Vec2(unknown, unknown);
}

double angle_of_rates(const Chip& chip, double feed, std::span<const Vec2> place,
                      std::span<const double> rate, std::span<const double> volume) {
  constexpr double near = 0.4, inside = 0.15;
  if (chip.free_side.empty()) return unknown;
  const Vec2 plane = chip.free_side.front(), across = left_normal(plane.normalized());
  double w = 0.0, x = 0.0, y = 0.0, yy = 0.0, xy = 0.0;
  for (std::size_t i = 0; i < place.size(); ++i) {
    const Vec2& p = place[i];
    if (p.y() < inside * plane.y() || p.y() > (1.0 - inside) * plane.y() ||
        std::abs(p.dot(across)) > near * feed)
      continue;
    const double weight = rate[i] * volume[i];
    w += weight;
    x += weight * p.x();
    y += weight * p.y();
    yy += weight * p.y() * p.y();
    xy += weight * p.x() * p.y();
  }
  const double spread = yy * w - y * y;
  return spread > 0.0 ? std::atan2(spread, xy * w - x * y) : unknown;
}

} // namespace cnem::evaluate
