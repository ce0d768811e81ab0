#include "adapt/structure.hpp"

#include "core/error.hpp"
#include "core/index.hpp"

#include <algorithm>
#include <tuple>

namespace cnem::adapt {

namespace {} // namespace

Structure build_structure(const Cloud<2>& cloud) {
  Structure s;
  s.mesh = voronoi::triangulate(cloud);
  s.circles = voronoi::circumcircles(cloud, s.mesh);
  s.cells = voronoi::constrained_cells(cloud, s.mesh, s.circles);

  const std::size_t n = cloud.position.size();
  std::vector<std::array<std::int32_t, 2>> edges;
  edges.reserve(3 * n);
  for (std::size_t t = 0; t < s.mesh.node.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k)
      if (s.mesh.neighbour[t][k] < static_cast<std::int32_t>(t))
        edges.push_back({s.mesh.node[t][(k + 1) % 3], s.mesh.node[t][(k + 2) % 3]});
  s.begin.assign(n + 1, 0);
  for (const auto& edge : edges)
    for (const std::int32_t i : edge) ++s.begin[index_of(i) + 1];
  for (std::size_t i = 0; i < n; ++i) s.begin[i + 1] += s.begin[i];
  std::vector<std::int32_t> at(s.begin.begin(), s.begin.end() - 1);
  s.neighbour.resize(2 * edges.size());
  for (const auto& [a, b] : edges) {
    s.neighbour[index_of(at[index_of(a)]++)] = b;
    s.neighbour[index_of(at[index_of(b)]++)] = a;
  }
  for (std::size_t i = 0; i < n; ++i)
    std::sort(s.neighbour.begin() + s.begin[i], s.neighbour.begin() + s.begin[i + 1]);
  return s;
}

std::optional<Structure> structure_if_valid(const Cloud<2>& cloud) {
  try {
    return build_structure(cloud);
  } catch (const GeometryError&) { return std::nullopt; }
}

double spacing_at(const Cloud<2>& cloud, const Structure& structure, std::int32_t node) {
  const auto around = structure.neighbours(node);
  double sum = 0.0;
  for (const std::int32_t k : around)
    sum += (cloud.position[index_of(k)] - cloud.position[index_of(node)]).norm();
  return sum / static_cast<double>(around.size());
}

Field spacing_of(const Cloud<2>& cloud, const Structure& structure) {
  Field spacing(cloud.position.size());
  for (std::size_t i = 0; i < spacing.size(); ++i)
    spacing[i] = spacing_at(cloud, structure, static_cast<std::int32_t>(i));
  return spacing;
}

std::vector<Contribution> contributions(const Cloud<2>& cloud, const voronoi::Cells& cells,
                                        const std::vector<char>& marked) {
  std::vector<Contribution> list;
  for (const voronoi::InteriorFacet& facet : cells.interior) {
    const auto [i, j] = facet.cell;
    if (marked[index_of(i)] == marked[index_of(j)]) continue;
    const std::int32_t inside = marked[index_of(i)] ? i : j, other = marked[index_of(i)] ? j : i;
    const double area =
        0.5 * std::abs(cross(facet.start - cloud.position[index_of(inside)], facet.end - facet.start));
    list.push_back({inside, other, area});
  }
  std::sort(list.begin(), list.end(), [](const Contribution& a, const Contribution& b) {
    return std::tie(a.marked, a.other) < std::tie(b.marked, b.other);
  });
  return list;
}

Foot foot_on(const Vec2& x, const Vec2& a, const Vec2& b) {
  const Vec2 edge = b - a;
  const double place = (x - a).dot(edge) / edge.squaredNorm();
  return {(x - a - std::clamp(place, 0.0, 1.0) * edge).norm(), place};
}

} // namespace cnem::adapt
