#pragma once
// Periods of a body that are independent of each other.
#include "core/vec.hpp"

#include <vector>

namespace cnem::contact {

/// Adds a period (m) to those that are independent of each other, which are three at most, unless it is a sum
/// of multiples of them, within 1e-3 of its length: a side in two pieces gives its period twice, a hexagonal
/// cell the difference of the two others. Returns false, and adds nothing, where it lies among them but is no
/// such sum.
bool add_period(std::vector<Vec3>& independent, const Vec3& period);

} // namespace cnem::contact
