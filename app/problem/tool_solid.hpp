#pragma once
// Shapes of tools in space, made of what a case says of them.
#include "contact/tool_shape.hpp"
#include "core/geometry/cloud.hpp"
#include "input/case.hpp"

#include <memory>

namespace cnem::app {

/// What has no end in the case reaches a thousand times as far as the cloud does. Throws InputError and
/// GeometryError for what encloses no solid.
std::shared_ptr<const contact::ToolShape<3>> make_solid(const input::ToolSolid& solid, const Cloud<3>& cloud);

} // namespace cnem::app
