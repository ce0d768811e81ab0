#pragma once
// Tetrahedra that are exchanged for others in the same hole.
#include "voronoi/space/stars.hpp"
#include "voronoi/space/tetrahedra.hpp"

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

  /// Who has a node.
  Stars& stars() { return stars_; }
  Ring ring(NodeIndex d, NodeIndex e, SimplexIndex start) const;

  /// Puts right-handed tetrahedra that fill the same hole in the place of others; the new ones.
  std::vector<SimplexIndex> replace(std::span<const SimplexIndex> old, std::span<const Nodes> fresh);

  /// Closes the gaps in the lists. Nothing else may be called afterwards.
  void finish();

private:
  const Cloud<3>& cloud_;
  Delaunay& mesh_;
  Stars stars_;
  std::vector<SimplexIndex> gaps_;
};

} // namespace cnem::voronoi
