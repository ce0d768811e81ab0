#include "voronoi/simplex_order.hpp"

#include "core/index.hpp"

#include <algorithm>

namespace cnem::voronoi {

namespace {

std::size_t lowest_corner(const TriangleNodes& node) {
  return index_of(std::min_element(node.begin(), node.end()) - node.begin());
}

template<class T> void turn(std::array<T, 3>& values, std::size_t first) {
  std::rotate(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(first), values.end());
}

} // namespace

IndexedVector<SimplexIndex, SimplexIndex> order_by_nodes(IndexedVector<SimplexIndex, TriangleNodes>& node,
                                                         std::size_t nodes) {
  std::vector<std::size_t> begin(nodes + 1, 0);
  for (TriangleNodes& corner : node) {
    turn(corner, lowest_corner(corner));
    ++begin[index_of(corner[0]) + 1];
  }
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
  IndexedVector<SimplexIndex, TriangleNodes> sorted;
  sorted.reserve(node.size());
  for (const SimplexIndex t : order) sorted.push_back(node[t]);
  node = std::move(sorted);
  return order;
}

void number_by_nodes(Triangulation& mesh, std::size_t nodes) {
  IndexedVector<SimplexIndex, std::size_t> first;
  first.reserve(mesh.node.size());
  for (const TriangleNodes& corner : mesh.node) first.push_back(lowest_corner(corner));
  const auto order = order_by_nodes(mesh.node, nodes);
  IndexedVector<SimplexIndex, SimplexIndex> number(order.size());
  for (const SimplexIndex t : order.indices()) number[order[t]] = t;
  IndexedVector<SimplexIndex, std::array<SimplexIndex, 3>> neighbour;
  IndexedVector<SimplexIndex, std::array<CloudFacetIndex, 3>> facet;
  neighbour.reserve(order.size());
  facet.reserve(order.size());
  for (const SimplexIndex t : order) {
    neighbour.push_back(mesh.neighbour[t]);
    facet.push_back(mesh.facet[t]);
    turn(neighbour.back(), first[t]);
    turn(facet.back(), first[t]);
    for (SimplexIndex& across : neighbour.back())
      if (exists(across)) across = number[across];
  }
  mesh.neighbour = std::move(neighbour);
  mesh.facet = std::move(facet);
  record_triangle_of_node(mesh, nodes);
}

void record_triangle_of_node(Triangulation& mesh, std::size_t nodes) {
  mesh.triangle_of_node.assign(nodes, SimplexIndex::none);
  for (const SimplexIndex t : mesh.node.indices())
    for (const NodeIndex i : mesh.node[t])
      if (!exists(mesh.triangle_of_node[i])) mesh.triangle_of_node[i] = t;
  for (const SimplexIndex t : mesh.node.indices())
    for (std::size_t k = 0; k < 3; ++k)
      if (exists(mesh.facet[t][k])) mesh.triangle_of_node[mesh.node[t][(k + 1) % 3]] = t;
}

} // namespace cnem::voronoi
