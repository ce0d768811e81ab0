#pragma once
// Polylines with two faces inside the domain, for the case reader: cracks and interfaces.
#include "input/case.hpp"
#include "input/schema/settings.hpp"

#include <string>
#include <utility>
#include <vector>

namespace cnem::input {

/// All boundary curves of a domain with the keys they come from.
std::vector<std::pair<std::string, const Curve*>> curves_of(const Domain& domain);

/// Why the point is not in the domain or on its boundary; empty when it is.
std::string outside_reason(const Domain& domain, const Vec2& x);

/// Points of a crack, turned as it says.
std::vector<Vec2> crack_path(const Setting& table);

/// Tractions of an interface from its table `cohesive`.
void read_cohesive(const Setting& table, Interface& interface, Diagnostics& diagnostics);

/// Cracks and interfaces of the table `domain`.
void read_walls(const Setting& table, Domain& domain, Diagnostics& diagnostics);

/// Whether they lie in the domain, clear of the boundary and of each other. Expects outline and holes.
void check_walls(const Setting& table, const Domain& domain, Diagnostics& diagnostics);

} // namespace cnem::input
