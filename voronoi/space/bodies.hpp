#pragma once
// Bodies that share no nodes are triangulated each for itself: where they press on each other they overlap.
#include "core/geometry/cloud.hpp"
#include "voronoi/space/tetrahedra.hpp"

#include <vector>

namespace cnem::voronoi {

/// [node] the number of the body that it is of, from 0 on in the order of their first nodes: those of
/// tetrahedra that have nodes in common. Empty where all are of one. O(T α(N)).
IndexedVector<NodeIndex, std::int32_t> bodies_of(const Tetrahedra& mesh);

/// A body by itself, and what its nodes and facets are in the cloud that it is of.
struct SingleBody {
  Cloud<3> cloud;
  IndexedVector<NodeIndex, NodeIndex> node;
  IndexedVector<CloudFacetIndex, CloudFacetIndex> facet;
};

/// The bodies of a cloud by their numbers (Cloud::body), without tetrahedra; one where it has none. Twins of
/// two bodies are none any more. O(N).
std::vector<SingleBody> single_bodies(const Cloud<3>& cloud);

/// The tetrahedra of a cloud from those of its bodies, as triangulate() orders them.
Tetrahedra joined(const Cloud<3>& cloud, const std::vector<SingleBody>& bodies,
                  const std::vector<Tetrahedra>& meshes);

} // namespace cnem::voronoi
