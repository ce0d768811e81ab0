#pragma once
// Clouds of nodes for tests: outlines divided at a spacing, filled with a lattice that may be jittered.
#include "core/geometry/cloud.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace cnem::testing {

/// Random numbers that are the same with every standard library.
class Random {
public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  double uniform(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_() >> 11) * 0x1p-53;
  }

private:
  std::mt19937_64 engine_;
};

enum class Lattice { square, hexagonal };

/// Appends a closed loop through the corners, each side divided into pieces no longer than `spacing`. Sides
/// that are travelled both ways (cracks) get nodes at bitwise equal positions.
inline void add_loop(Cloud<2>& cloud, const std::vector<Vec2>& corners, double spacing) {
  if (cloud.piece_names.empty()) cloud.piece_names = {"boundary"};
  const NodeIndex first = cloud.position.next();
  for (std::size_t c = 0; c < corners.size(); ++c) {
    const Vec2 a = corners[c], b = corners[(c + 1) % corners.size()];
    const int n = std::max(1, static_cast<int>(std::ceil((b - a).norm() / spacing - 1e-9)));
    const bool forward = std::pair(a.x(), a.y()) < std::pair(b.x(), b.y());
    for (int k = 0; k < n; ++k) {
      const Vec2 x = forward ? a + (b - a) * (k / double(n)) : b + (a - b) * ((n - k) / double(n));
      cloud.position.push_back(k == 0 ? a : x);
    }
  }
  for (std::size_t i = index_of(first); i < cloud.position.size(); ++i)
    cloud.facets.push_back(
        {{as<NodeIndex>(i), i + 1 < cloud.position.size() ? as<NodeIndex>(i + 1) : first}, {}});
}

/// Declares coincident boundary nodes as twins.
inline void declare_twins(Cloud<2>& cloud) {
  std::map<std::pair<double, double>, NodeIndex> seen;
  for (const NodeIndex i : cloud.position.indices()) {
    const Vec2& x = cloud.position[i];
    const auto [it, fresh] = seen.emplace(std::pair(x.x(), x.y()), i);
    if (!fresh) cloud.twins.push_back({it->second, i});
  }
}

/// Signed area enclosed by the loops: |Ω|.
inline double area(const Cloud<2>& cloud) {
  double twice = 0.0;
  const Vec2 origin = cloud.position[0];
  for (const auto& f : cloud.facets)
    twice += cross(cloud.position[f.node[0]] - origin, cloud.position[f.node[1]] - origin);
  return 0.5 * twice;
}

inline double distance_to_segment(const Vec2& x, const Vec2& a, const Vec2& b) {
  const double s = std::clamp((x - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
  return (x - a - s * (b - a)).norm();
}

/// True when x is inside the loops and at least `margin` away from them.
inline bool inside(const Cloud<2>& cloud, const Vec2& x, double margin) {
  double winding = 0.0;
  for (const auto& f : cloud.facets) {
    const Vec2 a = cloud.position[f.node[0]];
    const Vec2 b = cloud.position[f.node[1]];
    if (distance_to_segment(x, a, b) < margin) return false;
    winding += std::atan2(cross(a - x, b - x), (a - x).dot(b - x));
  }
  return winding > std::numbers::pi;
}

/// Appends the lattice points that lie inside the loops and `margin` away from them, each moved by up to
/// ±jitter·spacing in x and y.
inline void fill(Cloud<2>& cloud, Lattice lattice, double spacing, double jitter, double margin,
                 std::uint64_t seed) {
  Vec2 low = cloud.position[0], high = low;
  for (const Vec2& x : cloud.position) {
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
  }
  Random random(seed);
  const bool hexagonal = lattice == Lattice::hexagonal;
  const double row = hexagonal ? spacing * std::sqrt(0.75) : spacing;
  std::vector<Vec2> inner;
  for (int j = 1; low.y() + j * row < high.y(); ++j)
    for (int i = 0; low.x() + i * spacing < high.x() + spacing; ++i) {
      const double offset = hexagonal && j % 2 == 1 ? 0.5 * spacing : 0.0;
      const double dx = jitter * spacing * random.uniform(-1, 1);
      const double dy = jitter * spacing * random.uniform(-1, 1);
      const Vec2 x = low + Vec2(i * spacing + offset + dx, j * row + dy);
      if (inside(cloud, x, margin)) inner.push_back(x);
    }
  cloud.position.insert(cloud.position.end(), inner.begin(), inner.end());
}

/// A regular polygon; `radius` alternates between the two radii, so that n corners make a star of n/2 rays.
inline std::vector<Vec2> ring(const Vec2& centre, double radius_even, double radius_odd, int n,
                              bool clockwise = false) {
  std::vector<Vec2> corners;
  for (int k = 0; k < n; ++k) {
    const double angle = 2 * std::numbers::pi * k / n;
    corners.push_back(centre + (k % 2 == 0 ? radius_even : radius_odd) *
                                   Vec2(std::cos(angle), clockwise ? -std::sin(angle) : std::sin(angle)));
  }
  return corners;
}

inline std::vector<Vec2> rectangle(double width, double height) {
  return {{0, 0}, {width, 0}, {width, height}, {0, height}};
}

struct NamedCloud {
  std::string name;
  Cloud<2> cloud;
  double spacing;
  bool ties; ///< cocircular nodes: the Delaunay triangles are not unique
};

/// The unit square, jittered by a quarter of the spacing.
inline Cloud<2> jittered_square(double spacing, double jitter, std::uint64_t seed) {
  Cloud<2> cloud;
  add_loop(cloud, rectangle(1, 1), spacing);
  fill(cloud, Lattice::square, spacing, jitter, 0.5 * spacing, seed);
  return cloud;
}

/// Convex and non-convex domains of unit size: regular and jittered squares, L, annulus, star, slits with
/// declared twins (inside, and open to the boundary), and long boundary edges with nodes so close behind them
/// that circumcentres lie beyond the boundary.
inline std::vector<NamedCloud> domains() {
  std::vector<NamedCloud> list;
  const auto add = [&](const std::string& name, double h, const std::vector<std::vector<Vec2>>& loops,
                       Lattice lattice, double jitter, double margin = 0.5, double boundary = 1.0) {
    Cloud<2> cloud;
    for (const auto& loop : loops) add_loop(cloud, loop, boundary * h);
    declare_twins(cloud);
    fill(cloud, lattice, h, jitter, margin * h, list.size() + 1);
    const bool ties = name == "square_grid" || name == "square_hexagonal" || name == "star";
    list.push_back({name, cloud, h, ties});
  };
  const auto square = rectangle(1, 1);
  const std::vector<Vec2> l_shape{{0, 0}, {1, 0}, {1, 0.5}, {0.5, 0.5}, {0.5, 1}, {0, 1}};
  const std::vector<Vec2> open_slit{{0, 0}, {0.5, 0}, {0.5, 0.5}, {0.5, 0}, {1, 0}, {1, 1}, {0, 1}};
  const std::vector<Vec2> inner_slit{{0.25, 0.47}, {0.75, 0.53}};
  add("square_grid", 0.1, {square}, Lattice::square, 0.0);
  add("square_hexagonal", 0.1, {square}, Lattice::hexagonal, 0.0);
  add("square_jittered", 0.1, {square}, Lattice::square, 0.3);
  add("l_shape", 0.08, {l_shape}, Lattice::square, 0.25);
  add("annulus", 0.1, {ring({0, 0}, 1, 1, 48), ring({0, 0}, 0.4, 0.4, 20, true)}, Lattice::hexagonal, 0.2);
  add("star", 0.08, {ring({0, 0}, 1, 0.4, 10)}, Lattice::hexagonal, 0.2);
  add("slit_inside", 0.1, {square, inner_slit}, Lattice::square, 0.2);
  add("slit_open", 0.1, {open_slit}, Lattice::hexagonal, 0.1);
  add("coarse_boundary", 0.08, {l_shape}, Lattice::square, 0.3, 0.15, 3.0);
  return list;
}

/// Closed loops that the boundary consists of.
inline int loops(const Cloud<2>& cloud) {
  IndexedVector<NodeIndex, NodeIndex> next(cloud.position.size(), NodeIndex::none);
  for (const Facet<2>& facet : cloud.facets) next[facet.node[0]] = facet.node[1];
  IndexedVector<NodeIndex, char> seen(next.size(), 0);
  int count = 0;
  for (const Facet<2>& facet : cloud.facets) {
    if (seen[facet.node[0]]) continue;
    ++count;
    for (NodeIndex i = facet.node[0]; !seen[i]; i = next[i]) seen[i] = 1;
  }
  return count;
}

} // namespace cnem::testing
