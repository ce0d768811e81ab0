#include "clouds/node_hash.hpp"
#include "clouds/space/interior.hpp"
#include "core/geometry/facets.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace cnem::clouds {

bool Room::free(const Vec3& x, double h) const {
  const FacetTree::Nearest near = tree.nearest(x, 1.5 * h);
  if (near.facet < 0) return true; // far from everything: whoever asks is inside
  return near.distance >= clearance * h && !tree.in_ball(x, 1.0 + 1e-3);
}

std::vector<Vec3> lattice_nodes(const Cloud<3>& surface, const Room& room, double h) {
  Vec3 low = surface.position[0], high = low;
  for (const Vec3& x : surface.position) {
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
  }
  const double side = 2.0 * h / std::sqrt(3.0);
  const Vec3 middle = 0.5 * (low + high);
  std::array<int, 3> half;
  for (int k = 0; k < 3; ++k)
    half[static_cast<std::size_t>(k)] = static_cast<int>(std::ceil(0.5 * (high - low)[k] / side)) + 1;
  std::vector<Vec3> nodes;
  for (int k = -half[2]; k <= half[2]; ++k)
    for (int j = -half[1]; j <= half[1]; ++j)
      for (int body = 0; body < 2; ++body) {
        bool inside = false; // of the last node, where it was far from the surface
        double room_left = 0.0;
        for (int i = -half[0]; i <= half[0]; ++i) {
          const Vec3 x = middle + side * (Vec3(i, j, k) + Vec3::Constant(body == 0 ? -0.25 : 0.25));
          room_left -= side;
          if (room_left < 1.5 * h) {
            const double away = room.tree.nearest(x, std::numeric_limits<double>::max()).distance;
            inside = away > 0.0;
            room_left = std::abs(away);
            if (inside && room_left < 1.5 * h && !room.free(x, h)) continue;
          }
          if (inside) nodes.push_back(x);
        }
      }
  return nodes;
}

std::vector<Vec3> front_nodes(const Cloud<3>& surface, const Room& room, const SpaceSpacing& spacing) {
  NodeHash<3> placed(spacing.finest(), spacing.spacing, spacing.growth());
  struct Seed {
    Vec3 x, ahead; ///< position and unit direction in which the front moves
    double h;
    double left; ///< no more than the distance to the surface
  };
  std::vector<Seed> front;
  for (const Vec3& x : surface.position) placed.insert(x, spacing.at(x));
  for (const Facet<3>& f : surface.facets) {
    const auto x = corners_of(f, surface.position);
    const Vec3 middle = (x[0] + x[1] + x[2]) / 3.0, in = -area_normal<3>(x).normalized();
    front.push_back({middle - 0.18 * spacing.at(middle) * in, in, spacing.at(middle), 0.0});
  }
  // Over h. Fronts that meet leave gaps: with steps of a full h there were a third too few.
  constexpr double stride = 0.98, crowd = 0.9 * stride;
  std::vector<Vec3> nodes;
  for (std::size_t k = 0; k < front.size(); ++k) {
    const Seed seed = front[k];
    int axis = 0;
    seed.ahead.cwiseAbs().minCoeff(&axis);
    const Vec3 u = seed.ahead.cross(Vec3::Unit(axis)).normalized(), v = seed.ahead.cross(u);
    // Ahead, and around it as the edges of regular tetrahedra stand: the closest packing.
    for (int direction = 0; direction < 13; ++direction) {
      constexpr std::array<std::array<double, 2>, 4> ring = {
          {{1.0, 0.0}, {0.816497, 0.0}, {0.0, 0.0}, {-0.816497, 0.0}}}; // cosines
      const int level = direction == 0 ? 0 : direction < 4 ? 1 : direction < 10 ? 2 : 3;
      const double c = ring[static_cast<std::size_t>(level)][0], s = std::sqrt(1.0 - c * c);
      const double turn = level == 2 ? (direction - 4) * std::numbers::pi / 3.0 + std::numbers::pi / 6.0
                                     : (direction - (level == 1 ? 1 : 10)) * 2.0 * std::numbers::pi / 3.0;
      const Vec3 to = c * seed.ahead + s * (std::cos(turn) * u + std::sin(turn) * v);
      const Vec3 x = seed.x + to * (0.5 * stride * (seed.h + spacing.at(seed.x + seed.h * to)));
      const double h = spacing.at(x);
      if (placed.crowded(x, h, crowd)) continue;
      double left = seed.left - (x - seed.x).norm();
      if (left < 1.5 * h) {
        left = room.tree.nearest(x, 8.0 * h).distance;
        if (left < 0.0 || !room.free(x, h)) continue;
      }
      placed.insert(x, h);
      nodes.push_back(x);
      front.push_back({x, to, h, left});
    }
  }
  return nodes;
}

} // namespace cnem::clouds
