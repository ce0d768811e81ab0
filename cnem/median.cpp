#include "cnem/median.hpp"

#include "cnem/smoothing.hpp"
#include "core/error.hpp"
#include "core/geometry/place_text.hpp"
#include "core/operators/operator_checks.hpp"
#include "voronoi/space/median_cells.hpp"

#include <algorithm>
#include <cassert>

namespace cnem::scni {
namespace {

/// A mean of the rows of the tetrahedra at each node, weighted with their volumes.
DiscreteOperators<3> mean_rows(const DiscreteOperators<3>& linear, const CellLists<SimplexIndex>& around,
                               const Field& volume) {
  const std::size_t nodes = volume.size();
  DiscreteOperators<3> op;
  op.points = op.nodes = static_cast<int>(nodes);
  op.nodal = true;
  op.volume = volume;
  op.row_begin.assign(nodes + 1, 0);
  std::vector<std::vector<NodeIndex>> pattern(nodes);
#pragma omp parallel for schedule(static)
  for (std::size_t i = 0; i < nodes; ++i) {
    std::vector<NodeIndex>& row = pattern[i];
    for (const SimplexIndex t : around.of(i))
      row.insert(row.end(), linear.node.begin() + linear.row_begin[index_of(t)],
                 linear.node.begin() + linear.row_begin[index_of(t) + 1]);
    std::sort(row.begin(), row.end());
    row.erase(std::unique(row.begin(), row.end()), row.end());
  }
  for (std::size_t i = 0; i < nodes; ++i)
    op.row_begin[i + 1] = op.row_begin[i] + static_cast<std::int32_t>(pattern[i].size());
  op.node.resize(index_of(op.row_begin.back()));
  for (Field& g : op.gradient) g.assign(op.node.size(), 0.0);
#pragma omp parallel for schedule(static)
  for (std::size_t i = 0; i < nodes; ++i) {
    const std::vector<NodeIndex>& row = pattern[i];
    const auto first = index_of(op.row_begin[i]);
    std::copy(row.begin(), row.end(), op.node.begin() + op.row_begin[i]);
    for (const SimplexIndex t : around.of(i)) {
      const double share = 0.25 * linear.volume[index_of(t)] / volume[i];
      for (auto e = index_of(linear.row_begin[index_of(t)]); e < index_of(linear.row_begin[index_of(t) + 1]);
           ++e) {
        const auto place = std::lower_bound(row.begin(), row.end(), linear.node[e]) - row.begin();
        for (std::size_t d = 0; d < 3; ++d)
          op.gradient[d][first + index_of(place)] += share * linear.gradient[d][e];
      }
    }
  }
  op.build_transpose();
  return op;
}

} // namespace

MedianCells::MedianCells(std::vector<voronoi::Simplex<3>> tetrahedra) : tetrahedra_(std::move(tetrahedra)) {
  if (tetrahedra_.empty()) throw InputError("found no tetrahedra, expected a mesh that tiles the domain");
}

Approximation<3> MedianCells::rebuild(const Cloud<3>& cloud) {
  const CellComplex<3> cells = voronoi::median_cells(cloud, tetrahedra_);
  for (std::size_t i = 0; i < cells.volume.size(); ++i)
    if (!(cells.volume[i] > 0.0))
      throw GeometryError("the node at " + place_text(cloud.position[i]) + " m belongs to no tetrahedron");
  Approximation<3> result;
  result.conduction = voronoi::linear_simplices<3>(cloud, tetrahedra_);
  const auto around = group_by_cell<SimplexIndex>(
      cloud.position.size(),
      tetrahedra_.size(), [&](std::size_t t) -> const auto& { return tetrahedra_[t]; });
  result.mechanics = mean_rows(result.conduction, around, cells.volume);
  assert(rows_are_complete(result.mechanics) && reproduces_linear_fields(result.mechanics, cloud.position));
  result.links = stabilisation_links<3>(cloud, cells, faces_of_cells(cells));
  result.node_volume = result.mechanics.volume;
  result.cells = voronoi::simplex_geometry<3>(cloud, tetrahedra_);
  result.cells.between_points = true;
  return result;
}

} // namespace cnem::scni
