#include "voronoi/twins.hpp"

#include "core/error.hpp"
#include "core/index.hpp"

#include <fmt/format.h>

namespace cnem::voronoi {

template<int dim> void check_node_index(const Cloud<dim>& cloud, NodeIndex node, const std::string& who) {
  if (node < NodeIndex{} || node >= cloud.position.next())
    throw GeometryError(fmt::format("{} names node {}, but the cloud has nodes 0 to {}", who, as<int>(node),
                                    cloud.nodes() - 1));
}

template<int dim> IndexedVector<NodeIndex, NodeIndex> twin_groups(const Cloud<dim>& cloud) {
  if (cloud.twins.empty()) return {};
  IndexedVector<NodeIndex, NodeIndex> parent(cloud.position.size());
  for (const NodeIndex i : parent.indices()) parent[i] = i;
  const auto root = [&](NodeIndex i) {
    while (parent[i] != i) {
      auto& up = parent[i];
      i = up = parent[up];
    }
    return i;
  };
  for (std::size_t t = 0; t < cloud.twins.size(); ++t) {
    const auto& [a, b] = cloud.twins[t];
    check_node_index(cloud, a, fmt::format("twin pair {}", t));
    check_node_index(cloud, b, fmt::format("twin pair {}", t));
    parent[root(a)] = root(b);
  }
  for (const NodeIndex i : cloud.position.indices()) parent[i] = root(i);
  return parent;
}

template void check_node_index(const Cloud<2>&, NodeIndex, const std::string&);
template void check_node_index(const Cloud<3>&, NodeIndex, const std::string&);
template IndexedVector<NodeIndex, NodeIndex> twin_groups(const Cloud<2>&);
template IndexedVector<NodeIndex, NodeIndex> twin_groups(const Cloud<3>&);

} // namespace cnem::voronoi
