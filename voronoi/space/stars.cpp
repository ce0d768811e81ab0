#include "voronoi/space/stars.hpp"

namespace cnem::voronoi {

Stars::Stars(const Delaunay& mesh)
    : mesh_(mesh), of_node_(mesh.first.size(), SimplexIndex::none), seen_(mesh.node.size(), 0) {
  for (const SimplexIndex t : mesh.node.indices())
    for (const NodeIndex i : mesh.node[t]) of_node_[i] = t;
}

/// Breadth first, until one is found.
template<class Found> SimplexIndex Stars::search(NodeIndex node, const Found& found) {
  ++round_;
  star_.assign(1, of_node_[node]);
  seen_[star_[0]] = round_;
  for (std::size_t n = 0; n < star_.size(); ++n) {
    const SimplexIndex t = star_[n];
    const auto& nodes = mesh_.node[t];
    if (found(nodes)) return t;
    for (std::size_t k = 0; k < 4; ++k) {
      const SimplexIndex next = mesh_.neighbour[t][k];
      if (nodes[k] == node || !exists(next) || seen_[next] == round_) continue;
      seen_[next] = round_;
      star_.push_back(next);
    }
  }
  return SimplexIndex::none;
}

const std::vector<SimplexIndex>& Stars::of(NodeIndex node) {
  search(node, [](const auto&) { return false; });
  return star_;
}

SimplexIndex Stars::with(NodeIndex a, NodeIndex b) {
  return search(a, [b](const auto& nodes) { return contains(nodes, b); });
}

SimplexIndex Stars::with(NodeIndex a, NodeIndex b, NodeIndex c) {
  return search(a, [b, c](const auto& nodes) { return contains(nodes, b) && contains(nodes, c); });
}

} // namespace cnem::voronoi
