#pragma once
// Closed outlines of the curves of a drawing, put together end to end.
#include "input/drawings/drawing.hpp"

#include <vector>

namespace cnem::input {

/// A closed curve as it was drawn, in the units of the drawing: in the sense and from the start of its first
/// curve. Arcs may be longer than half a turn; a lone piece is a circle.
struct Loop {
  Curve curve;
  std::size_t line = 0; ///< of the file, of its first curve
};

/// The loops of curves whose ends meet within `tolerance` (units of the drawing), in the order of their first
/// curves. Ends are put together in one point, that of a line where there is one, and arcs through their ends
/// again. Throws DrawingError with coordinates: curves without length, drawn twice, more than two at a point,
/// loose ends, loops that cross themselves or each other.
std::vector<Loop> closed_loops(const DrawnFile& drawing, const std::vector<DrawnCurve>& curves,
                               double tolerance);

/// Puts straight pieces of one name and direction that follow each other into one.
void merge_straight_pieces(Curve& curve);

/// "(20, 5) mm": a place of the drawing in messages.
std::string place_in(const DrawnFile& drawing, const Vec2& x);

} // namespace cnem::input
