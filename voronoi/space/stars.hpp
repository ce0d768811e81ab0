#pragma once
// The tetrahedra round a node, found from one of them across their faces.
#include "voronoi/space/delaunay.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace cnem::voronoi {

/// Looks at a list of tetrahedra without holes that may change meanwhile: placed() tells. O(N) to make.
class Stars {
public:
  explicit Stars(const Delaunay& mesh);

  /// All tetrahedra that have the node; valid until the next call of any of these.
  const std::vector<SimplexIndex>& of(NodeIndex node);
  /// The first of those of node a that has b, or b and c; none: none has.
  SimplexIndex with(NodeIndex a, NodeIndex b);
  SimplexIndex with(NodeIndex a, NodeIndex b, NodeIndex c);

  /// The nodes of a tetrahedron are new.
  void placed(SimplexIndex t) {
    if (seen_.size() < mesh_.node.size()) seen_.resize(mesh_.node.size());
    for (const NodeIndex i : mesh_.node[t]) of_node_[i] = t;
  }

private:
  template<class Found> SimplexIndex search(NodeIndex node, const Found& found);

  const Delaunay& mesh_;
  IndexedVector<NodeIndex, SimplexIndex> of_node_;
  std::vector<SimplexIndex> star_;
  IndexedVector<SimplexIndex, std::uint32_t> seen_;
  std::uint32_t round_ = 0;
};

inline bool contains(const std::array<NodeIndex, 4>& nodes, NodeIndex i) {
  return nodes[0] == i || nodes[1] == i || nodes[2] == i || nodes[3] == i;
}

} // namespace cnem::voronoi
