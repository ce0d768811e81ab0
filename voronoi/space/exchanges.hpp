#pragma once
// Ways to exchange tetrahedra for others that keep the facets of a cloud and the edges of its surface.
#include "voronoi/space/flip_mesh.hpp"

#include <cstdint>
#include <span>
#include <utility>

namespace cnem::voronoi {

/// Two nodes, the lower first.
using Edge = std::pair<NodeIndex, NodeIndex>;
/// Three nodes in increasing order.
using Face = std::array<NodeIndex, 3>;

inline Edge edge_of(NodeIndex a, NodeIndex b) { return {std::min(a, b), std::max(a, b)}; }
Face face_of(NodeIndex a, NodeIndex b, NodeIndex c);

/// Tetrahedra and those that may stand in their place.
struct Exchange {
  std::vector<SimplexIndex> old;
  std::vector<FlipMesh::Nodes> fresh;
};

/// The same list for the same tetrahedra.
std::vector<FlipMesh::Nodes> key_of(std::vector<FlipMesh::Nodes> nodes);

/// Facets of a cloud as faces, and their edges, with the first node at each place.
class SurfaceParts {
public:
  SurfaceParts(const Cloud<3>& cloud, const IndexedVector<NodeIndex, NodeIndex>& first);

  Face at_first(const Facet<3>& facet) const;
  bool is_edge(const Edge& edge) const;
  bool is_facet(const Face& face) const;

private:
  std::span<const Face> at(NodeIndex i) const {
    return std::span(faces_).subspan(begin_[index_of(i)], begin_[index_of(i) + 1] - begin_[index_of(i)]);
  }
  const IndexedVector<NodeIndex, NodeIndex>& first_;
  std::vector<std::uint32_t> begin_; ///< [node]
  std::vector<Face> faces_; ///< those of which a node is the lowest or the middle one, node after node
};

class Exchanges {
public:
  Exchanges(const Cloud<3>& cloud, const SurfaceParts& surface, Delaunay& delaunay)
      : mesh(cloud, delaunay), surface_(surface) {}

  FlipMesh mesh;

  /// Appends ways to fill the tetrahedra round an edge without it, at most 24; none for edges of the surface.
  void add_removals(const Edge& edge, std::vector<Exchange>& exchanges);
  /// Appends the way to put three tetrahedra in the place of the two at a face, if there is one.
  void add_split(const Face& face, std::vector<Exchange>& exchanges);

  std::vector<FlipMesh::Nodes> nodes_of(const std::vector<SimplexIndex>& tetrahedra) const;

private:
  const SurfaceParts& surface_;
};

} // namespace cnem::voronoi
