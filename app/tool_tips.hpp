#pragma once
// Where tools are sharp: what `adapt.tool_spacing` counts the distance from.
#include "core/geometry/curve.hpp"

#include <vector>

namespace cnem::app {

/// Corners of a tool, and points along its arcs no further apart than `spacing`, m.
std::vector<Vec2> tool_tips(const Curve& outline, double spacing);

} // namespace cnem::app
