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

} // namespace

DiscreteOperators<3> linear_tetrahedra(const Cloud<3>& cloud, const Tetrahedra& mesh) {
  std::vector<double> volume;
  const auto partner = partners(cloud, mesh, volume);
  if (partner.empty()) return linear_simplices<3>(cloud, mesh.node);

  std::vector<std::uint8_t> joined(mesh.node.size());
  for (const SimplexIndex t : mesh.node.indices())
    if (partner[t] != t) joined[index_of(partner[t])] = 1;
  std::vector<SimplexIndex> roots; // those that are alone come first
  IndexedVector<SimplexIndex, std::int32_t> point(mesh.node.size());
  for (const int with_others : {0, 1})
    for (const SimplexIndex t : mesh.node.indices())
      if (partner[t] == t && joined[index_of(t)] == with_others) {
        point[t] = as<std::int32_t>(roots.size());
        roots.push_back(t);
      }
  const auto members = group_by_cell<SimplexIndex>(roots.size(), mesh.node.size(), [&](std::size_t t) {
    return std::array{as<NodeIndex>(point[partner[t]])}; // lists of points in place of cells
  });

  DiscreteOperators<3> op;
  op.points = static_cast<int>(roots.size());
  op.nodes = cloud.nodes();
  op.row_begin.reserve(roots.size() + 1);
  op.volume.reserve(roots.size());
  op.node.reserve(4 * mesh.node.size());
  op.value.reserve(4 * mesh.node.size());
  for (Field& gradient : op.gradient) gradient.reserve(4 * mesh.node.size());
  op.row_begin.assign(1, 0);
  struct Entry {
    NodeIndex node;
    Vec<3> b;
    double value;
  };
  std::vector<Entry> row;
  for (std::size_t p = 0; p < roots.size(); ++p) {
    row.clear();
    double sum = 0.0;
    for (const SimplexIndex t : members.of(p)) {
      const auto normal = face_normals(corners_of(cloud, mesh, t));
      const double share = std::max(volume[index_of(t)], 0.0);
      sum += share;
      for (std::size_t k = 0; k < 4; ++k) {
        const NodeIndex i = mesh.node[t][k];
        auto at = std::find_if(row.begin(), row.end(), [&](const Entry& e) { return e.node == i; });
        if (at == row.end()) at = row.insert(at, {i, Vec<3>::Zero(), 0.0});
        at->b -= normal[k] / 6.0;
        at->value += 0.25 * share;
      }
    }
    if (!(sum > 0.0)) // says where
      return linear_simplices<3>(cloud, std::span(&mesh.node[roots[p]], 1));
    std::sort(row.begin(), row.end(), [](const Entry& a, const Entry& b) { return a.node < b.node; });
    op.volume.push_back(sum);
    for (const Entry& entry : row) {
      op.node.push_back(entry.node);
      op.value.push_back(entry.value / sum);
      for (std::size_t d = 0; d < 3; ++d)
        op.gradient[d].push_back(entry.b[static_cast<Eigen::Index>(d)] / sum);
    }
    op.row_begin.push_back(static_cast<std::int32_t>(op.node.size()));
  }
  op.build_transpose();
  assert(rows_are_complete(op) && reproduces_linear_fields(op, cloud.position));
  return op;
}

} // namespace cnem::voronoi
