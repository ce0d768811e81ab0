#include "adapt/space/structure.hpp"

#include "core/index.hpp"
#include "voronoi/space/voronoi_cells.hpp"

#include <algorithm>
#include <cmath>

namespace cnem::adapt {

double volume_of(const Cloud<3>& cloud, const std::array<NodeIndex, 4>& node) {
  return measure<3>(
      {cloud.position[node[0]], cloud.position[node[1]], cloud.position[node[2]], cloud.position[node[3]]});
}

CellLists<SimplexIndex> tetrahedra_of_nodes(std::size_t nodes, const voronoi::Tetrahedra& mesh) {
  return group_by_cell<SimplexIndex>(
      nodes, mesh.node.size(), [&](std::size_t t) -> const auto& { return mesh.node[t]; });
}

SpaceStructure structure_of(const Cloud<3>& cloud, voronoi::Tetrahedra mesh, scni::CellKind cells) {
  SpaceStructure s;
  const std::size_t n = cloud.position.size();
  s.cell.assign(n, 0.0);
  for (const auto& node : mesh.node) {
    const double quarter = 0.25 * volume_of(cloud, node);
    for (const NodeIndex i : node) s.cell[index_of(i)] += quarter;
  }
  if (cells == scni::CellKind::voronoi)
    s.cell = voronoi::voronoi_cells(cloud, mesh, voronoi::circumspheres(cloud, mesh)).volume;
  s.tetrahedra = tetrahedra_of_nodes(n, mesh);
  std::vector<std::array<NodeIndex, 2>> edges;
  edges.reserve(8 * n);
  std::vector<NodeIndex> upper;
  for (const NodeIndex i : cloud.position.indices()) {
    upper.clear();
    for (const SimplexIndex t : s.tetrahedra.of(i))
      for (const NodeIndex k : mesh.node[t])
        if (k > i) upper.push_back(k);
    std::sort(upper.begin(), upper.end());
    upper.erase(std::unique(upper.begin(), upper.end()), upper.end());
    for (const NodeIndex k : upper) edges.push_back({i, k});
  }
  s.linked = other_ends(n, edges);
  s.mesh = std::move(mesh);
  return s;
}

Field spacing_of(const Cloud<3>& cloud, const SpaceStructure& structure) {
  Field spacing(cloud.position.size(), 0.0);
  for (std::size_t i = 0; i < spacing.size(); ++i) {
    const auto around = structure.tetrahedra.of(i);
    double volume = 0.0;
    for (const SimplexIndex t : around) volume += volume_of(cloud, structure.mesh.node[t]);
    spacing[i] = std::cbrt(6.0 * volume / static_cast<double>(around.size()));
  }
  return spacing;
}

} // namespace cnem::adapt
