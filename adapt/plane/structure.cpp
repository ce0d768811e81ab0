#include "adapt/plane/structure.hpp"

#include "core/error.hpp"
#include "core/index.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <tuple>

namespace cnem::adapt {

Structure build_structure(const Cloud<2>& cloud, Space space) {
  Structure s;
  s.space = space;
  s.mesh = voronoi::triangulate(cloud);
  s.circles = voronoi::circumcircles(cloud, s.mesh);
  s.cells = voronoi::constrained_cells(cloud, s.mesh, s.circles);
  if (space == Space::revolution)
    for (const Vec2& centroid : centroids(cloud, s.cells)) {
      if (!(centroid.x() > 0.0)) // a boundary node has gone through the axis
        throw GeometryError(fmt::format(
            "a cell has its centroid at x = {:.6g} m: beyond the axis of the body", centroid.x()));
      s.radius.push_back(centroid.x());
    }
  return s;
}

std::optional<Structure> structure_if_valid(const Cloud<2>& cloud, Space space) {
  try {
    return build_structure(cloud, space);
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

std::vector<Contribution> contributions(const Cloud<2>& cloud, const Structure& structure,
                                        const IndexedVector<NodeIndex, char>& marked) {
  std::vector<Contribution> list;
  for (const InnerFace<2>& face : structure.cells.interior) {
    const auto [i, j] = face.cell;
    if (marked[i] == marked[j]) continue;
    const NodeIndex inside = marked[i] ? i : j, other = marked[i] ? j : i;
    const Vec2& x = cloud.position[inside];
    double volume = 0.5 * std::abs(cross(face.corner[0] - x, face.corner[1] - face.corner[0]));
    if (structure.space == Space::revolution)
      volume *= 2.0 * std::numbers::pi / 3.0 * (x.x() + face.corner[0].x() + face.corner[1].x());
    list.push_back({inside, other, volume});
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
