#include "voronoi/plane/locate.hpp"

#include "core/index.hpp"

#include <algorithm>

namespace cnem::voronoi {

std::array<double, 3> barycentric(const Cloud<2>& cloud, const Triangulation& mesh, SimplexIndex triangle,
                                  const Vec2& x) {
  std::array<Vec2, 3> r;
  for (std::size_t k = 0; k < 3; ++k) r[k] = cloud.position[mesh.node[triangle][k]] - x;
  const double a = cross(r[1], r[2]), b = cross(r[2], r[0]), c = cross(r[0], r[1]);
  const double sum = a + b + c;
  return {a / sum, b / sum, c / sum};
}

WalkEnd walk(const Cloud<2>& cloud, const Triangulation& mesh, SimplexIndex from, const Vec2& x) {
  const auto at = [&](SimplexIndex t, std::size_t k) -> const Vec2& {
    return cloud.position[mesh.node[t][k % 3]];
  };
  SimplexIndex t = from;
  const Vec2 origin = (at(t, 0) + at(t, 1) + at(t, 2)) / 3.0;
  const Vec2 direction = x - origin;
  // The edge through which the ray leaves runs from its right to its left.
  std::array<bool, 3> left{};
  for (std::size_t k = 0; k < 3; ++k) left[k] = cross(direction, at(t, k) - origin) >= 0.0;
  std::size_t exit = 0;
  while (exit < 3 && !(!left[(exit + 1) % 3] && left[(exit + 2) % 3])) ++exit;
  if (exit == 3) return {from, CloudFacetIndex::none}; // x is the centroid

  for (std::size_t steps = 0; steps <= mesh.node.size(); ++steps) {
    const Vec2 &p = at(t, exit + 1), &q = at(t, exit + 2);
    if (cross(q - p, x - p) >= 0.0) break;
    const SimplexIndex next = mesh.neighbour[t][exit];
    if (!exists(next)) return {t, mesh.facet[t][exit]};
    std::size_t back = 0;
    while (mesh.neighbour[next][back] != t) ++back;
    t = next;
    exit = cross(direction, at(t, back) - origin) >= 0.0 ? (back + 1) % 3 : (back + 2) % 3;
  }
  return {t, CloudFacetIndex::none};
}

Location locate(const Cloud<2>& cloud, const Triangulation& mesh, const Vec2& x, SimplexIndex hint) {
  const auto least = [](const std::array<double, 3>& w) { return std::min({w[0], w[1], w[2]}); };
  const WalkEnd end =
      walk(cloud, mesh, std::clamp(hint, SimplexIndex{}, SimplexIndex{mesh.triangles() - 1}), x);
  Location best{end.triangle, barycentric(cloud, mesh, end.triangle, x), true};
  constexpr double tolerance = 1e-9;
  if (least(best.weight) >= -tolerance) return best;
  for (const SimplexIndex t : mesh.node.indices()) {
    const auto weight = barycentric(cloud, mesh, t, x);
    if (least(weight) > least(best.weight)) best = {t, weight, true};
  }
  best.inside = least(best.weight) >= -tolerance;
  return best;
}

} // namespace cnem::voronoi
