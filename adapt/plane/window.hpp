#pragma once
// The ends of a window that moves with a tool: matter is fed in ahead and taken off behind
// (docs/theory.md, "Resampling").
#include "adapt/plane/working_cloud.hpp"

#include <optional>

namespace cnem::adapt {

/// What both of these make: nodes that nothing happened to keep their bits, those whose cells become larger
/// or smaller have as much more or less of their own matter (Resampling::gain), so that no state changes.
/// They depend on the arguments alone. structure: that of the cloud.

/// Prolongs the body by `length` (m) in the direction of the unit vector `along`, beyond the straight side
/// that lies furthest there and stands square to it. The strip next to that side is copied: its nodes, at
/// rest (Resampling::virgin) and where they were before it deformed, and the pieces of its boundary; the side
/// moves on, and nodes that it had are new ones in the same places, which no condition holds. undeformed: m,
/// [node] where they began; from there the side may have moved as a whole. Empty where the body beside the
/// strip is not bounded by straight lines along that direction alone, or the cloud would have no valid
/// structure.
std::optional<Resampling<2>> feed(const Cloud<2>& cloud, const Structure& structure,
                                  const NodeProperties& node,
                                  const IndexedVector<NodeIndex, Vec2>& undeformed, const Vec2& along,
                                  double length);

/// Cuts the body along the straight line from one point of the boundary to another (m; the nearest points of
/// the boundary are taken) and takes off what lies on its right, where the boundary goes on at `from`. The
/// new face belongs to the piece that lay furthest off; its nodes are like the nearest ones that were there.
/// Empty where the line leaves the body or meets its boundary in between, runs into faces that are mates, or
/// the cloud would have no valid structure.
std::optional<Resampling<2>> take_off(const Cloud<2>& cloud, const Structure& structure,
                                      const NodeProperties& node, const Vec2& from, const Vec2& to);

} // namespace cnem::adapt
