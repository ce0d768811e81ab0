#pragma once
// What of the boundary cohesive interfaces still hold together: contact leaves it to them.
#include "core/indexed.hpp"

#include <cstdint>
#include <vector>

namespace cnem::contact {

/// Faces are numbered so that those of one interface are 2i and 2i + 1. Empty lists: nothing is bonded.
struct Bonds {
  IndexedVector<CloudFacetIndex, std::int32_t> face;   ///< that a facet is on; −1: none
  IndexedVector<CloudFacetIndex, std::int8_t> covered; ///< the other face is bonded to all of the facet
  IndexedVector<NodeIndex, std::int32_t> bonded;       ///< the face on which a node is bonded; −1: on none
  IndexedVector<NodeIndex, double> pressed; ///< m, how far faces lay in each other where a bond broke

  bool empty() const { return face.empty(); }
};

} // namespace cnem::contact
