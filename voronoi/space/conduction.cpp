#include "voronoi/space/conduction.hpp"

#include "core/geometry/cell_complex.hpp"
#include "core/machine/parallel.hpp"
#include "core/operators/operator_checks.hpp"
#include "voronoi/linear_simplices.hpp"
#include "voronoi/space/walk.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

namespace cnem::voronoi {
namespace {

/// [tetrahedron] the one that it is taken together with, itself unless it is flat; empty: none is flat.
IndexedVector<SimplexIndex, SimplexIndex> partners(const Cloud<3>& cloud, const Tetrahedra& mesh,
                                                   std::vector<double>& volume) {
  // of 6V over the 3/2nd power of the sum of the squares of the edges: twice what conduction lets
  // them go flat before it changes what they carry (thermal/conduction_kernels.hpp)
  constexpr double flat = 0.001, larger = 1.01;
  const std::size_t count = mesh.node.size();
  volume.resize(count);
  std::vector<std::uint8_t> is_flat(count);
  for_each_block(count, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) {
      const auto x = corners_of(cloud, mesh, as<SimplexIndex>(t));
      volume[t] = measure<3>(x);
      double squares = 0.0;
      for (std::size_t c = 0; c < 4; ++c)
        for (std::size_t d = c + 1; d < 4; ++d) squares += (x[d] - x[c]).squaredNorm();
      is_flat[t] = !(volume[t] > 0.0 && 6.0 * volume[t] > flat * squares * std::sqrt(squares));
    }
  });
  IndexedVector<SimplexIndex, SimplexIndex> partner;
  if (std::none_of(is_flat.begin(), is_flat.end(), [](std::uint8_t f) { return f != 0; })) return partner;
  partner.resize(count);
  for (const SimplexIndex t : mesh.node.indices()) {
    partner[t] = t;
    if (!is_flat[index_of(t)]) continue;
    for (const SimplexIndex other : mesh.neighbour[t]) // volumes grow along the way, so that it ends
      if (exists(other) && volume[index_of(other)] > larger * volume[index_of(partner[t])])
        partner[t] = other;
  }
  for (const SimplexIndex t : mesh.node.indices())
    while (partner[partner[t]] != partner[t]) partner[t] = partner[partner[t]];
  return partner;
}

/// Tetrahedra by the rows that they are in.
struct Groups {
  std::vector<double> volume;       ///< [tetrahedron] m³
  std::vector<SimplexIndex> alone;  ///< in rows of their own, which come first
  CellLists<SimplexIndex> together; ///< flat ones with what they are taken together with

  std::size_t joined() const { return together.begin.size() - 1; }
};

Groups grouped(const Cloud<3>& cloud, const Tetrahedra& mesh) {
  const std::size_t count = mesh.node.size();
  Groups groups;
  const auto partner = partners(cloud, mesh, groups.volume);
  const auto root = [&](SimplexIndex t) { return partner.empty() ? t : partner[t]; };
  constexpr NodeIndex alone = NodeIndex::none, shared = as<NodeIndex>(0);
  IndexedVector<SimplexIndex, NodeIndex> list(count, alone); // of roots, in place of cells
  for (const SimplexIndex t : list.indices())
    if (root(t) != t) list[root(t)] = shared;
  std::size_t lists = 0;
  groups.alone.reserve(count);
  for (const SimplexIndex t : list.indices()) {
    if (root(t) != t) continue;
    if (!(groups.volume[index_of(t)] > 0.0))
      linear_simplices<3>(cloud, std::span(&mesh.node[t], 1)); // throws, and says where
    if (list[t] == shared)
      list[t] = as<NodeIndex>(lists++);
    else
      groups.alone.push_back(t);
  }
  groups.together = group_by_cell<SimplexIndex>(lists, count, [&](std::size_t t) {
    const NodeIndex& of = list[root(as<SimplexIndex>(t))];
    return std::span(&of, exists(of) ? 1 : 0);
  });
  return groups;
}

/// Operators with room for these rows, of which there is none yet.
DiscreteOperators<3> without_rows(const Cloud<3>& cloud, const Groups& groups) {
  const std::size_t rows = groups.alone.size() + groups.joined();
  DiscreteOperators<3> op;
  op.points = static_cast<int>(rows);
  op.nodes = cloud.nodes();
  op.volume.reserve(rows);
  op.row_begin.reserve(rows + 1);
  op.row_begin.push_back(0);
  op.node.reserve(4 * groups.volume.size());
  return op;
}

/// Adds rows of tetrahedra that are taken together.
class RowsOfSeveral {
public:
  RowsOfSeveral(const Cloud<3>& cloud, const Tetrahedra& mesh, const Groups& groups)
      : cloud_(cloud), mesh_(mesh), volume_(groups.volume) {}

  void add(std::span<const SimplexIndex> members, DiscreteOperators<3>& op) {
    row_.clear();
    double sum = 0.0;
    for (const SimplexIndex t : members) {
      const auto normal = face_normals(corners_of(cloud_, mesh_, t));
      const double share = std::max(volume_[index_of(t)], 0.0);
      sum += share;
      for (std::size_t k = 0; k < 4; ++k) {
        const NodeIndex i = mesh_.node[t][k];
        auto at = std::find_if(row_.begin(), row_.end(), [&](const Entry& e) { return e.node == i; });
        if (at == row_.end()) at = row_.insert(at, {i, Vec<3>::Zero(), 0.0});
        at->b -= normal[k] / 6.0;
        at->value += 0.25 * share;
      }
    }
    std::sort(row_.begin(), row_.end(), [](const Entry& a, const Entry& b) { return a.node < b.node; });
    op.volume.push_back(sum);
    for (const Entry& entry : row_) {
      op.node.push_back(entry.node);
      op.value.push_back(entry.value / sum);
      for (std::size_t d = 0; d < 3; ++d)
        op.gradient[d].push_back(entry.b[static_cast<Eigen::Index>(d)] / sum);
    }
    op.row_begin.push_back(static_cast<std::int32_t>(op.node.size()));
  }

private:
  struct Entry {
    NodeIndex node;
    Vec<3> b;
    double value;
  };
  const Cloud<3>& cloud_;
  const Tetrahedra& mesh_;
  const std::vector<double>& volume_;
  std::vector<Entry> row_;
};

} // namespace

DiscreteOperators<3> linear_tetrahedra(const Cloud<3>& cloud, const Tetrahedra& mesh) {
  const Groups groups = grouped(cloud, mesh);
  if (groups.joined() == 0) return linear_simplices<3>(cloud, mesh.node);
  DiscreteOperators<3> op = without_rows(cloud, groups);
  op.value.reserve(4 * mesh.node.size());
  for (Field& gradient : op.gradient) gradient.reserve(4 * mesh.node.size());
  RowsOfSeveral rows(cloud, mesh, groups);
  for (const SimplexIndex t : groups.alone) rows.add(std::span(&t, 1), op);
  for (std::size_t k = 0; k < groups.joined(); ++k) rows.add(groups.together.of(k), op);
  op.build_transpose();
  assert(rows_are_complete(op) && reproduces_linear_fields(op, cloud.position));
  return op;
}

DiscreteOperators<3> conduction_pattern(const Cloud<3>& cloud, const Tetrahedra& mesh) {
  const Groups groups = grouped(cloud, mesh);
  DiscreteOperators<3> op = without_rows(cloud, groups);
  for (const SimplexIndex t : groups.alone) {
    auto corner = mesh.node[t];
    std::sort(corner.begin(), corner.end());
    op.volume.push_back(groups.volume[index_of(t)]);
    op.node.insert(op.node.end(), corner.begin(), corner.end());
    op.row_begin.push_back(static_cast<std::int32_t>(op.node.size()));
  }
  RowsOfSeveral rows(cloud, mesh, groups);
  for (std::size_t k = 0; k < groups.joined(); ++k) rows.add(groups.together.of(k), op);
  op.value = Field();
  op.begin_columns();
  return op;
}

} // namespace cnem::voronoi
