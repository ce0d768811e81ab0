#pragma once
// How thick a solid in space is where a straight path goes through it, from its signed distances alone.
#include "contact/tool_shape.hpp"

#include <span>

namespace cnem::contact {

/// m, how much of the straight path from → to lies inside where it goes through: it leaves by a face whose
/// outward normal is turned by more than 114° from that of the face it entered by (contact/thickness.hpp).
/// 0 where it does not. Follows the path in steps as long as the distance to the surface allows.
double passed_by_tracing(const ToolShape<3>& shape, const Vec3& from, const Vec3& to);

/// m, of the shortest way through along a unit vector, of those at the given points of the surface; infinite
/// where there is none.
double thickness_by_tracing(const ToolShape<3>& shape, std::span<const Vec3> surface, const Vec3& direction);

} // namespace cnem::contact
