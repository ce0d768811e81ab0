#pragma once
// A cohesive element at the places that its nodes have now.
#include "mechanics/cohesive_faces.hpp"

#include <array>

namespace cnem {

struct PlacedElement {
  std::array<std::array<Vec2, 2>, 2> x; ///< [side][node] m
  std::array<double, 2> span;           ///< m, bonded lengths of the segments
  Vec2 along, normal;                   ///< unit vectors of the mean tangent
  double stretch;                       ///< sum of the tangents of both sides by bonded length

  PlacedElement(const CohesiveElement& element, const Fields<2>& position) {
    Vec2 tangent = Vec2::Zero();
    for (std::size_t s = 0; s < 2; ++s) {
      const BondedSegment& segment = element.side[s];
      for (std::size_t k = 0; k < 2; ++k) x[s][k] = vector_at<2>(position, index_of(segment.node[k]));
      span[s] = segment.arc[1] - segment.arc[0];
      tangent += (x[s][1] - x[s][0]) / span[s];
    }
    stretch = tangent.norm();
    along = tangent / stretch;
    normal = left_normal(along);
  }

  /// The segments are at right angles, or farther turned.
  bool across_each_other() const { return (x[0][1] - x[0][0]).dot(x[1][1] - x[1][0]) <= 0.0; }

  /// m, from the point of the right face that was bonded at this end to that of the left one.
  Vec2 jump(const CohesiveElement& element, std::size_t end) const {
    const auto left = element.values(0, end), right = element.values(1, end);
    return left[0] * x[0][0] + left[1] * x[0][1] - right[0] * x[1][0] - right[1] * x[1][1];
  }
};

} // namespace cnem
