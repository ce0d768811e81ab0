#pragma once
// What a tool has torn off of cohesive interfaces, in the frame of the tool (chip.hpp).
#include "core/fields/vector_at.hpp"
#include "mechanics/cohesive_faces.hpp"

#include <span>

namespace cnem::evaluate {

/// At one moment.
struct Debonding {
  double length = 0.0; ///< m, broken, of all interfaces, where they were bonded
  double depth = 0.0;  ///< m below the cut, of the deepest broken place of a face
};

/// place: [node] m, in the frame of the tool, whose cut is at y = 0.
Debonding look_at_bonds(const CohesiveFaces& faces, std::span<const Vec2> place);

} // namespace cnem::evaluate
