#include "clouds/generate_interior.hpp"
#include "clouds/node_hash.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace cnem::clouds {

std::vector<Vec2> front_nodes(const Cloud<2>& boundary, const voronoi::EdgeTree& tree,
                              const SpacingField& spacing) {
  NodeHash<2> placed(spacing.finest(), spacing.spacing, spacing.growth());

  struct Seed {
    Vec2 x, ahead; ///< position and unit direction in which the front moves
    double h;
    double room; ///< no more than the distance to the boundary
  };
  std::vector<Seed> front;
  for (const Vec2& x : boundary.position) placed.insert(x, spacing.at(x));
  for (const Facet<2>& f : boundary.facets) {
    const Vec2 a = boundary.position[std::size_t(f.node[0])], b = boundary.position[std::size_t(f.node[1])];
    front.push_back({a, left_normal(b - a).normalized(), spacing.at(a), 0.0});
  }
  // Equilateral triangles first: on a row of nodes the next row stands at ±30° to the front's direction.
  constexpr double degree = std::numbers::pi / 180.0;
  constexpr std::array<double, 8> directions = {30.0, -30.0, 0.0, 90.0, -90.0, 60.0, -60.0, 150.0};
  // Over h. Fronts that meet leave gaps: with steps of a full h the mean distance would come out at 1.1 h.
  constexpr double stride = 0.91, crowd = 0.88 * stride, clearance = 0.5;
  std::vector<Vec2> nodes;
  for (std::size_t k = 0; k < front.size(); ++k) {
    const Seed seed = front[k];
    for (const double direction : directions) {
      const double c = std::cos(direction * degree), s = std::sin(direction * degree);
      const Vec2 u(c * seed.ahead.x() - s * seed.ahead.y(), s * seed.ahead.x() + c * seed.ahead.y());
      const Vec2 x = seed.x + u * (0.5 * stride * (seed.h + spacing.at(seed.x + seed.h * u)));
      const double h = spacing.at(x);
      if (placed.crowded(x, h, crowd)) continue;
      double room = seed.room - (x - seed.x).norm();
      if (room < clearance * h) {
        room = tree.distance(x, 8.0 * h);
        if (room < clearance * h || !tree.inside(x)) continue;
      }
      placed.insert(x, h);
      nodes.push_back(x);
      front.push_back({x, u, h, room});
    }
  }
  return nodes;
}

} // namespace cnem::clouds
