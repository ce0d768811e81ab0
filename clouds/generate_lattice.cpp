#include "clouds/generate_interior.hpp"

#include <algorithm>
#include <cmath>
#include <random>

namespace cnem::clouds {

namespace {

/// Uniform in [0, 1), from the bits alone: the distributions of the standard library differ between
/// platforms.
double uniform(std::mt19937_64& bits) { return static_cast<double>(bits() >> 11) * 0x1.0p-53; }

} // namespace

std::vector<Vec2> lattice_nodes(const Cloud<2>& boundary, const voronoi::EdgeTree& tree, double h,
                                Pattern pattern) {
  Vec2 low = boundary.position[0], high = low;
  for (const Vec2& x : boundary.position) {
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
  }
  const Vec2 size = high - low;
  const bool square = pattern == Pattern::regular;
  const double rise = square ? h : 0.5 * std::sqrt(3.0) * h;
  const int columns = std::max(1, static_cast<int>(std::round(size.x() / h)));
  int rows = std::max(1, static_cast<int>(std::round(size.y() / rise)));
  if (!square && rows % 2 == 1) { // an even number of rows ends in step with the nodes of the opposite side
    const int even = 2 * static_cast<int>(std::round(0.5 * size.y() / rise));
    if (std::abs(even * rise / size.y() - 1.0) < 0.08) rows = even;
  }
  // A boundary node's own half cell is h/2 deep in a square lattice; the zigzag ends of hexagonal rows at
  // h/2 from a wall are kept, since without them the strip along it would be a quarter too sparse.
  const double clearance = 0.48 * h;
  std::vector<Vec2> nodes;
  for (int j = 0; j <= rows; ++j) {
    const bool shifted = !square && j % 2 == 1;
    for (int i = 0; i < columns + (shifted ? 0 : 1); ++i) {
      const Vec2 x(low.x() + size.x() * ((i + (shifted ? 0.5 : 0.0)) / columns),
                   low.y() + size.y() * j / rows);
      if (tree.inside(x) && tree.distance(x, clearance) >= clearance) nodes.push_back(x);
    }
  }
  return nodes;
}

void jitter_nodes(const voronoi::EdgeTree& tree, const SpacingField& spacing, double jitter,
                  std::uint64_t seed, std::vector<Vec2>& interior) {
  std::mt19937_64 bits(seed);
  for (Vec2& x : interior) {
    Vec2 move;
    do { // y first: one seed gives one cloud, whatever order a compiler evaluates arguments in
      move.y() = 2.0 * uniform(bits) - 1.0;
      move.x() = 2.0 * uniform(bits) - 1.0;
    } while (move.squaredNorm() > 1.0);
    const double h = spacing.at(x);
    const double room = tree.distance(x, 2.0 * h) - 0.45 * h;
    x += move * std::clamp(room, 0.0, jitter * h);
  }
}

} // namespace cnem::clouds
