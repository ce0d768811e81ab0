#pragma once
// The surfaces of rigid tools in space as triangles: for pictures, and for cuts through them.
#include "core/geometry/box.hpp"
#include "core/geometry/triangle_surface.hpp"
#include "input/case.hpp"

namespace cnem::input {

/// The closed surface of a tool at t = 0, m. It leaves the solid by less than 4e-5 of the radius where it is
/// revolved (360 steps), 1/4600 of it at arcs of outlines (core/geometry/curve.hpp), 1.3e-3 at rounded edges
/// of ends (16 steps), and by 3.9e-3 of the distance from the outline at its corners, which a profile goes
/// round in steps of up to 10 degrees. What has no end
/// is cut off beyond `around`, and a half-space is a plate as large.
TriangleSurface tool_surface(const ToolSolid& solid, const Box<3>& around);

} // namespace cnem::input
