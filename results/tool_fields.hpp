#pragma once
// Temperatures of tools that conduct, as frames of fields.
#include "results/snapshot.hpp"
#include "results/vtk_writer.hpp"

#include <memory>

namespace cnem::results {

/// How their series is called.
inline constexpr Series tool_series{files::tool_fields, "tool_"};

/// All sections of the plane where their tools are now, in one frame; null where there are none. Nodes of
/// coatings are not shown but in the surface temperature of their node: "surface_temperature [K]".
std::shared_ptr<const FieldFrame<2>> tool_frame(const Snapshot<2>& shot, const Vec3& origin);

} // namespace cnem::results
