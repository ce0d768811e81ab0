#pragma once
// The surfaces of rigid tools in space as triangles: for pictures, and for cuts through them.
#include "core/geometry/box.hpp"
#include "core/geometry/triangle_surface.hpp"
#include "input/case.hpp"

namespace cnem::input {

/// The closed surface of a tool at t = 0, m. Arcs are divided (core/geometry/curve.hpp), what is revolved
/// into 360 steps, so that it leaves the solid by less than 4e-5 of the radius (arcs 1/4600). What has no end
/// is cut off beyond `around`, and a half-space is a plate as large. Throws InputError where a file cannot be
/// read.
TriangleSurface tool_surface(const ToolSolid& solid, const Box<3>& around);

} // namespace cnem::input
