#include "cnem/median.hpp"

#include "cnem/nodal_rows.hpp"
#include "cnem/smoothing.hpp"
#include "core/error.hpp"
#include "core/geometry/facets.hpp"
#include "core/geometry/place_text.hpp"
#include "core/operators/operator_checks.hpp"
#include "voronoi/space/walk.hpp"

#include <algorithm>
#include <cassert>

namespace cnem::scni {

CellLists<SimplexIndex> tetrahedra_of_nodes(const voronoi::Tetrahedra& mesh) {
  return group_by_cell<SimplexIndex>(mesh.of_node.size(), mesh.node.size(),
                                     [&](std::size_t t) -> const auto& { return mesh.node[t]; });
}

DiscreteOperators<3> median_gradients(const Cloud<3>& cloud, const voronoi::Tetrahedra& mesh,
                                      const CellLists<SimplexIndex>& around) {
  const std::size_t nodes = cloud.position.size();
  DiscreteOperators<3> op;
  op.points = op.nodes = cloud.nodes();
  op.nodal = true;
  op.volume.assign(nodes, 0.0);
  for (std::size_t t = 0; t < mesh.node.size(); ++t) {
    const double quarter = 0.25 * measure<3>(corners_of(cloud, mesh, as<SimplexIndex>(t)));
    for (const NodeIndex i : mesh.node[t]) op.volume[index_of(i)] += quarter;
  }
  for (const NodeIndex i : cloud.position.indices())
    if (!(op.volume[index_of(i)] > 0.0))
      throw GeometryError("the tetrahedra of the node at " + place_text(cloud.position[i]) +
                          " m have no volume");
  fill_rows(op, [&](std::size_t i, RowAccumulator<3>& row) {
    for (const SimplexIndex t : around.of(i)) {
      const auto normal = voronoi::face_normals(corners_of(cloud, mesh, t));
      for (std::size_t k = 0; k < 4; ++k) row.add(mesh.node[t][k], normal[k]);
    }
    return -24.0 * op.volume[i];
  });
  assert(rows_are_complete(op) && reproduces_linear_fields(op, cloud.position));
  return op;
}

StabilisationLinks<3> median_links(const Cloud<3>& cloud, const voronoi::Tetrahedra& mesh,
                                   const CellLists<SimplexIndex>& around, const DiscreteOperators<3>& rows) {
  const std::size_t nodes = cloud.position.size();
  StabilisationLinks<3> links;
  links.begin.resize(nodes + 1);
  for (std::size_t i = 0; i <= nodes; ++i) links.begin[i] = rows.row_begin[i] - static_cast<std::int32_t>(i);
  links.neighbour.resize(rows.node.size() - nodes);
  links.weight.resize(links.neighbour.size());
  for_each_block(nodes, [&](std::size_t begin, std::size_t end) {
    std::vector<Vec<3>> area;
    for (std::size_t i = begin; i < end; ++i) {
      const auto row = std::span(rows.node).subspan(index_of(rows.row_begin[i]),
                                                    index_of(rows.row_begin[i + 1] - rows.row_begin[i]));
      area.assign(row.size(), Vec<3>::Zero());
      const auto self = as<NodeIndex>(i);
      for (const SimplexIndex t : around.of(i)) {
        const auto& node = mesh.node[t];
        const auto x = corners_of(cloud, mesh, t);
        const std::size_t own = index_of(std::find(node.begin(), node.end(), self) - node.begin());
        const auto& face = voronoi::face_of_tetrahedron[own];
        for (std::size_t k = 0; k < 3; ++k) {
          // from the middle of the edge over the centroids of its two faces to that of the tetrahedron
          const std::size_t a = face[k], b = face[(k + 1) % 3], c = face[(k + 2) % 3];
          const Vec<3> middle = 0.5 * (x[own] + x[a]);
          area[index_of(std::lower_bound(row.begin(), row.end(), node[a]) - row.begin())] +=
              (x[b] - middle).cross(x[c] - middle) / 12.0;
        }
      }
      auto at = index_of(links.begin[i]);
      for (std::size_t k = 0; k < row.size(); ++k) {
        if (row[k] == self) continue;
        links.neighbour[at] = row[k];
        links.weight[at++] = link_weight<3>(area[k].norm(), (cloud.position[row[k]] - cloud.position[i]).norm());
      }
    }
  });
  return links;
}

} // namespace cnem::scni
