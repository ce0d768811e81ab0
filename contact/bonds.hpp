#pragma once
// What of the boundary cohesive interfaces still hold together: contact leaves it to them.
#include "core/indexed.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace cnem::contact {

/// Faces are numbered so that those of one interface are 2i and 2i + 1. Empty lists: nothing is bonded.
struct Bonds {
  IndexedVector<CloudFacetIndex, std::int32_t> face;         ///< that a facet is on; −1: none
  IndexedVector<CloudFacetIndex, std::array<double, 2>> arc; ///< m, along its interface; of others 0
  IndexedVector<NodeIndex, std::int32_t> bonded; ///< the face on which a node is bonded; −1: on none
  IndexedVector<NodeIndex, std::array<double, 2>> reach; ///< m, along its interface, what a node is bonded to
  IndexedVector<NodeIndex, double> pressed; ///< m, how far faces lay in each other where a bond broke

  bool empty() const { return face.empty(); }

  /// Of n nodes and f facets none is bonded.
  void rest(std::size_t n, std::size_t f) {
    face.assign(f, -1);
    arc.assign(f, {0.0, 0.0});
    bonded.assign(n, -1);
    reach.assign(n, {0.0, 0.0});
    pressed.assign(n, 0.0);
  }
  /// Whether a node is bonded to the other face of its interface there, or a facet's length beside it.
  bool joins(NodeIndex node, CloudFacetIndex facet) const {
    if (empty() || bonded[node] < 0 || face[facet] != (bonded[node] ^ 1)) return false;
    const auto& [from, to] = arc[facet];
    return reach[node][1] >= from - (to - from) && reach[node][0] <= to + (to - from);
  }
};

} // namespace cnem::contact
