#pragma once
// Where tools are sharp: what `adapt.tool_spacing` counts the distance from.
#include "contact/contact.hpp"
#include "core/geometry/curve.hpp"

#include <vector>

namespace cnem::app {

/// Corners of a tool, and points along its arcs no further apart than `spacing`, m.
std::vector<Vec2> tool_tips(const Curve& outline, double spacing);

/// From x to the nearest of the points after they have moved by `shift`, m²; infinite where there is none.
double squared_distance(const std::vector<Vec2>& tips, const Vec2& shift, const Vec2& x);

/// m, from x to the nearest ridge of the tools in space where they stand, but at most `most`.
double distance_from_ridges(const contact::RigidContact<3>& contact, const Vec3& x, double most);

} // namespace cnem::app
