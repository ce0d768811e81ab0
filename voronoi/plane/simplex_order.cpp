#include "voronoi/plane/simplex_order.hpp"

#include "core/index.hpp"

#include <algorithm>

namespace cnem::voronoi {

namespace {

template<class T> void turn(std::array<T, 3>& values, std::size_t first) {
  std::rotate(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(first), values.end());
}

/// The lowest node of each triangle comes first.
void begin_at_lowest_nodes(Triangulation& mesh) {
  for (const SimplexIndex t : mesh.node.indices()) {
    const auto& corner = mesh.node[t];
    if (corner[0] < corner[1] && corner[0] < corner[2]) continue;
    const std::size_t first = corner[1] < corner[2] ? 1 : 2;
    turn(mesh.node[t], first);
    turn(mesh.neighbour[t], first);
    turn(mesh.facet[t], first);
  }
}

bool in_order(const TriangleNodes& a, const TriangleNodes& b) {
  return a[0] != b[0] ? a[0] < b[0] : a[1] < b[1];
}

/// Triangles by their first and second node.
IndexedVector<SimplexIndex, SimplexIndex> sorted(const IndexedVector<SimplexIndex, TriangleNodes>& node,
                                                 std::size_t nodes) {
  std::vector<std::size_t> begin(nodes + 1, 0);
  for (const TriangleNodes& corner : node) ++begin[index_of(corner[0]) + 1];
  for (std::size_t i = 0; i < nodes; ++i) begin[i + 1] += begin[i];
  IndexedVector<SimplexIndex, SimplexIndex> order(node.size());
  std::vector<std::size_t> end(begin.begin(), begin.end() - 1);
  for (const SimplexIndex t : node.indices()) {
    const std::size_t first = index_of(node[t][0]);
    std::size_t place = end[first]++;
    for (; place > begin[first] && node[t][1] < node[order[place - 1]][1]; --place)
      order[place] = order[place - 1];
    order[place] = t;
  }
  return order;
}

/// triangle_of_node from the other lists.
void record_triangle_of_node(Triangulation& mesh, std::size_t nodes) {
  mesh.triangle_of_node.assign(nodes, SimplexIndex::none);
  for (const SimplexIndex t : mesh.node.indices())
    for (const NodeIndex i : mesh.node[t])
      if (!exists(mesh.triangle_of_node[i])) mesh.triangle_of_node[i] = t;
  for (const SimplexIndex t : mesh.node.indices())
    for (std::size_t k = 0; k < 3; ++k)
      if (exists(mesh.facet[t][k])) mesh.triangle_of_node[mesh.node[t][(k + 1) % 3]] = t;
}

} // namespace

void number_by_nodes(Triangulation& mesh, std::size_t nodes) {
  begin_at_lowest_nodes(mesh);
  if (!std::is_sorted(mesh.node.begin(), mesh.node.end(), in_order)) {
    const auto order = sorted(mesh.node, nodes);
    IndexedVector<SimplexIndex, SimplexIndex> number(order.size());
    for (const SimplexIndex t : order.indices()) number[order[t]] = t;
    Triangulation renumbered;
    renumbered.node.reserve(order.size());
    renumbered.neighbour.reserve(order.size());
    renumbered.facet.reserve(order.size());
    for (const SimplexIndex t : order) {
      renumbered.node.push_back(mesh.node[t]);
      renumbered.neighbour.push_back(mesh.neighbour[t]);
      renumbered.facet.push_back(mesh.facet[t]);
      for (SimplexIndex& across : renumbered.neighbour.back())
        if (exists(across)) across = number[across];
    }
    mesh = std::move(renumbered);
  }
  record_triangle_of_node(mesh, nodes);
}

} // namespace cnem::voronoi
