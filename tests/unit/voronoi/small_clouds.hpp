#pragma once
// Small clouds that the unit tests of the geometry share.
#include "core/geometry/cloud.hpp"
#include "tests/index_literals.hpp"

#include <initializer_list>
#include <utility>

namespace cnem::voronoi::test {

using namespace testing::literals;

/// Appends the nodes of a closed loop (counter-clockwise: outer, clockwise: hole) and its facets.
inline void add_loop(Cloud<2>& cloud, std::initializer_list<Vec2> corners) {
  const auto first = static_cast<std::int32_t>(cloud.nodes());
  const auto n = static_cast<std::int32_t>(corners.size());
  for (const Vec2& x : corners) cloud.position.push_back(x);
  if (cloud.piece_names.empty()) cloud.piece_names.push_back("boundary");
  for (std::int32_t k = 0; k < n; ++k)
    cloud.facets.push_back({{as<NodeIndex>(first + k), as<NodeIndex>(first + (k + 1) % n)}, {}});
}

/// The unit square with its four corners as the only nodes.
inline Cloud<2> unit_square() {
  Cloud<2> cloud;
  add_loop(cloud, {{0, 0}, {1, 0}, {1, 1}, {0, 1}});
  return cloud;
}

/// [0, n] × [0, n] with unit spacing, boundary nodes first: cocircular everywhere.
inline Cloud<2> grid(int n) {
  Cloud<2> cloud;
  cloud.piece_names = {"boundary"};
  for (int k = 0; k < n; ++k) cloud.position.emplace_back(k, 0);
  for (int k = 0; k < n; ++k) cloud.position.emplace_back(n, k);
  for (int k = 0; k < n; ++k) cloud.position.emplace_back(n - k, n);
  for (int k = 0; k < n; ++k) cloud.position.emplace_back(0, n - k);
  for (int k = 0; k < 4 * n; ++k)
    cloud.facets.push_back({{as<NodeIndex>(k), as<NodeIndex>((k + 1) % (4 * n))}, {}});
  for (int y = 1; y < n; ++y)
    for (int x = 1; x < n; ++x) cloud.position.emplace_back(x, y);
  return cloud;
}

/// [0, 4]² with the crack y = 2, 1 <= x <= 3 embedded in it: nodes 16..19 are tip (1, 2), lower (2, 2), tip
/// (3, 2), upper (2, 2). Four nodes inside at (1 or 3, 1 or 3).
inline Cloud<2> embedded_crack() {
  Cloud<2> cloud;
  add_loop(cloud, {{0, 0},
                   {1, 0},
                   {2, 0},
                   {3, 0},
                   {4, 0},
                   {4, 1},
                   {4, 2},
                   {4, 3},
                   {4, 4},
                   {3, 4},
                   {2, 4},
                   {1, 4},
                   {0, 4},
                   {0, 3},
                   {0, 2},
                   {0, 1}});
  // Seen from the material the loop runs clockwise about the (empty) crack: along the upper face to the
  // right.
  add_loop(cloud, {{1, 2}, {2, 2}, {3, 2}, {2, 2}});
  cloud.twins = {{17_node, 19_node}};
  for (const Vec2& x : {Vec2(1, 1), Vec2(3, 1), Vec2(1, 3), Vec2(3, 3)}) cloud.position.push_back(x);
  return cloud;
}

/// [0, 2] × [0, 2] cut from the left edge (0, 1) to the tip (1, 1): the mouth has the twins 7 (upper) and 9
/// (lower), the tip is node 8.
inline Cloud<2> open_crack() {
  Cloud<2> cloud;
  add_loop(cloud, {{0, 0}, {1, 0}, {2, 0}, {2, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}, {1, 1}, {0, 1}});
  cloud.twins = {{7_node, 9_node}};
  return cloud;
}

} // namespace cnem::voronoi::test
