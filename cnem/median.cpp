#include "cnem/median.hpp"

#include "cnem/nodal_rows.hpp"
#include "cnem/smoothing.hpp"
#include "core/error.hpp"
#include "core/fields/vector_at.hpp"
#include "core/geometry/cell_complex.hpp"
#include "core/geometry/facets.hpp"
#include "core/geometry/place_text.hpp"
#include "core/operators/operator_checks.hpp"
#include "voronoi/space/walk.hpp"

#include <algorithm>
#include <cassert>

namespace cnem::scni {

DiscreteOperators<3> median_gradients(const Cloud<3>& cloud, const voronoi::Tetrahedra& mesh) {
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
  const auto around = group_by_cell<SimplexIndex>(
      nodes, mesh.node.size(), [&](std::size_t t) -> const auto& { return mesh.node[t]; });
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

StabilisationLinks<3> median_links(const Cloud<3>& cloud, const DiscreteOperators<3>& op) {
  const std::size_t nodes = cloud.position.size();
  assert(op.row_begin == op.col_begin);
  StabilisationLinks<3> links;
  links.begin.resize(nodes + 1);
  for (std::size_t i = 0; i <= nodes; ++i) links.begin[i] = op.row_begin[i] - static_cast<std::int32_t>(i);
  links.neighbour.resize(op.node.size() - nodes);
  links.weight.resize(links.neighbour.size());
  for_each_block(nodes, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      auto at = index_of(links.begin[i]);
      for (auto e = index_of(op.row_begin[i]); e < index_of(op.row_begin[i + 1]); ++e) {
        if (index_of(op.node[e]) == i) continue;
        const Vec<3> area =
            op.volume[i] * vector_at<3>(op.gradient, e) - vector_at<3>(op.weighted_gradient, e);
        links.neighbour[at] = op.node[e];
        links.weight[at++] =
            link_weight<3>(area.norm(), (cloud.position[op.node[e]] - cloud.position[i]).norm());
      }
    }
  });
  return links;
}

} // namespace cnem::scni
