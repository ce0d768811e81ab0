#pragma once
// Polylines with two faces inside the domain, for the case reader: cracks and interfaces.
#include "io/case.hpp"
#include "io/settings.hpp"

#include <string>
#include <vector>

namespace cnem::io {

/// A position as messages show it.
std::string show(const Vec2& x);

/// Why the point is not in the domain or on its boundary; empty when it is.
std::string outside_reason(const Domain& domain, const Vec2& x);

/// Points of a crack, turned as it says.
std::vector<Vec2> crack_path(const Setting& table);

/// Cracks and interfaces of the table `domain`.
void read_walls(const Setting& table, Domain& domain, Diagnostics& diagnostics);

/// Whether they lie in the domain, clear of the boundary and of each other. Expects outline and holes.
void check_walls(const Setting& table, const Domain& domain, Diagnostics& diagnostics);

} // namespace cnem::io
