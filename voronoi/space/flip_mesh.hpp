#pragma once
// Tetrahedra that are exchanged for others in the same hole.
#include "voronoi/space/delaunay.hpp"
#include "voronoi/space/tetrahedra.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace cnem::voronoi {

/// Changes the tetrahedra of a triangulation in place. All signs are exact.
class FlipMesh {
public:
  using Nodes = std::array<NodeIndex, 4>;

  /// Tetrahedra round an edge from d to e: the n-th has the nodes d, e, around[n], around[n + 1]. They begin
  /// and end at the convex hull where the edge is on it.
  struct Ring {
    std::vector<SimplexIndex> tetrahedra;
    std::vector<NodeIndex> around;
    bool closed = false; ///< whether they go all the way round
  };

  FlipMesh(const Cloud<3>& cloud, Delaunay& mesh);

  const Vec3& at(NodeIndex i) const { return cloud_.position[i]; }
  const Nodes& nodes(SimplexIndex t) const { return mesh_.node[t]; }
  const std::array<SimplexIndex, 4>& neighbours(SimplexIndex t) const { return mesh_.neighbour[t]; }
  int sign(NodeIndex a, NodeIndex b, NodeIndex c, NodeIndex d) const;

  /// All tetrahedra that have the node; valid until the next call.
  const std::vector<SimplexIndex>& star(NodeIndex node);
  /// One that has both, or all three; none: none has.
  SimplexIndex with(NodeIndex a, NodeIndex b);
  SimplexIndex with(NodeIndex a, NodeIndex b, NodeIndex c);
  Ring ring(NodeIndex d, NodeIndex e, SimplexIndex start) const;

  /// Puts right-handed tetrahedra that fill the same hole in the place of others; the new ones.
  std::vector<SimplexIndex> replace(std::span<const SimplexIndex> old, std::span<const Nodes> fresh);

  /// Closes the gaps in the lists. Nothing else may be called afterwards.
  void finish();

private:
  const Cloud<3>& cloud_;
  Delaunay& mesh_;
  IndexedVector<NodeIndex, SimplexIndex> of_node_;
  std::vector<SimplexIndex> gaps_, star_;
  IndexedVector<SimplexIndex, std::uint32_t> seen_;
  std::uint32_t round_ = 0;
};

inline bool contains(const FlipMesh::Nodes& nodes, NodeIndex i) {
  return nodes[0] == i || nodes[1] == i || nodes[2] == i || nodes[3] == i;
}

} // namespace cnem::voronoi
