#pragma once
// A surface whose edges are turned into the other diagonal of their two facets.
#include "voronoi/space/surface.hpp"

namespace cnem::voronoi {

/// Nodes beside which the surface keeps its shape.
using FixedNodes = IndexedVector<NodeIndex, std::uint8_t>;

/// Changes the facets of a cloud in place: nodes and pieces stay, and a surface without branches stays one.
/// The two faces of a slit flip together. fixed: [node], or empty: where four nodes are on one plane alone
/// edges between them are turned if one is fixed.
class FlippableSurface {
public:
  explicit FlippableSurface(Cloud<3>& cloud, const FixedNodes& fixed = {});

  const Cloud<3>& cloud() const { return cloud_; }
  SurfaceEdge across(SurfaceEdge e) const { return across_[facet_of(e)][place_of(e)]; }
  NodeIndex start(SurfaceEdge e) const { return cloud_.facets[facet_of(e)].node[place_of(e)]; }
  NodeIndex apex(SurfaceEdge e) const { return cloud_.facets[facet_of(e)].node[(place_of(e) + 2) % 3]; }

  /// Whether the two facets are of one piece and not fixed, their normals and those of the facets after it
  /// make an angle with at least this cosine, none is folded and the other diagonal is no edge yet.
  bool may_flip(SurfaceEdge e, double least_cosine) const;

  /// Turns the edge from a to b of the facets (a, b, c) and (b, a, d), which become (c, a, d) and (d, b, c),
  /// if may_flip() holds on all faces there. Whether it did.
  bool flip(SurfaceEdge e, double least_cosine);

private:
  bool joined(SurfaceEdge leaving, NodeIndex other) const;
  SurfaceEdge edge_between(CloudFacetIndex f, CloudFacetIndex g) const;
  void turn(SurfaceEdge e);
  void join(SurfaceEdge one, SurfaceEdge other);

  Cloud<3>& cloud_;
  FixedNodes fixed_;
  SurfaceEdges across_;
  IndexedVector<CloudFacetIndex, CloudFacetIndex> behind_; ///< the facet of the other face of a slit
};

} // namespace cnem::voronoi
