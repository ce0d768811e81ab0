#pragma once
// Workpieces in space, as clouds are made of them.
#include "input/case.hpp"

namespace cnem::input {

/// The body of a block without a grid, a sweep or a file. Expects one of them.
clouds::SpaceDomain space_domain(const Domain& domain);

/// Names of its boundary pieces, each once.
std::vector<std::string> pieces_of(const clouds::SpaceDomain& domain);

/// Whether all facets of a piece of a workpiece in space lie on parallel planes.
bool is_plane(const Domain& domain, const std::string& piece);

/// Lower and upper corner of the box around a workpiece in space, m.
std::array<Vec3, 2> space_bounds(const Domain& domain);

/// Why a point (m) is not in a workpiece in space; "" when it is.
std::string outside_reason_in_space(const Domain& domain, const Vec3& x);

} // namespace cnem::input
