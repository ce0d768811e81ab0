#pragma once
// Tools in space that begin within the workpiece.
#include "contact/tool_shape.hpp"
#include "core/geometry/cloud.hpp"

#include <optional>

namespace cnem::app {

struct ToolOverlap {
  double depth = 0.0; /// Where a node lies deeper in the tool than `allowed` (m, > 0), or else the tool
                      /// deeper than that below the
  /// surface of the workpiece, as thin tools do between nodes. The latter are always found from 1.5 times
  /// `allowed` on. Cubes around the workpiece are halved where an overlap is possible: neither distance
  /// changes by more than the way.
  Vec3 place{0, 0, 0}; ///< m
};

/// Where nodes lie deeper in the tool than `allowed` (m, > 0), or else the tool deeper than that below the
/// surface of the workpiece, between nodes. Depths are found to a tenth; ends of tools narrower than
/// allowed/4 may be missed down to a depth of 1.4 times what is allowed. Cubes around the workpiece are
/// halved where both distances, which change by no more than the way, leave an overlap possible.
std::optional<ToolOverlap> overlap_at_start(const contact::ToolShape<3>& tool, const Cloud<3>& cloud,
                                            double allowed);

} // namespace cnem::app
