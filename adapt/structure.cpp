#include "adapt/structure.hpp"

#include "core/error.hpp"
#include "core/index.hpp"

#include <algorithm>
#include <tuple>

namespace cnem::adapt {

Structure build_structure(const Cloud<2>& cloud) {
  Structure s;
  s.mesh = voronoi::triangulate(cloud);
  s.circles = voronoi::circumcircles(cloud, s.mesh);
  s.cells = voronoi::constrained_cells(cloud, s.mesh, s.circles);
  return s;
}

std::optional<Structure> structure_if_valid(const Cloud<2>& cloud) {
  try {
    return build_structure(cloud);
  } catch (const GeometryError&) { return std::nullopt; }
}

double spacing_at(const Cloud<2>& cloud, const Structure& structure, NodeIndex node) {
  const auto around = structure.neighbours(node);
  double sum = 0.0;
  for (const NodeIndex k : around) sum += (cloud.position[k] - cloud.position[node]).norm();
  return sum / static_cast<double>(around.size());
}

Field spacing_of(const Cloud<2>& cloud, const Structure& structure) {
  Field spacing(cloud.position.size());
  for (std::size_t i = 0; i < spacing.size(); ++i)
    spacing[i] = spacing_at(cloud, structure, as<NodeIndex>(i));
  return spacing;
}

std::vector<Contribution> contributions(const Cloud<2>& cloud, const CellComplex<2>& cells,
                                        const IndexedVector<NodeIndex, char>& marked) {
  std::vector<Contribution> list;
  for (const InnerFace<2>& face : cells.interior) {
    const auto [i, j] = face.cell;
    if (marked[i] == marked[j]) continue;
    const NodeIndex inside = marked[i] ? i : j, other = marked[i] ? j : i;
    const double area =
        0.5 * std::abs(cross(face.corner[0] - cloud.position[inside], face.corner[1] - face.corner[0]));
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
