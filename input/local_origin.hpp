#pragma once
// Places of a case, counted from a point beside the workpiece: far from (0, 0) coordinates have no digits
// left for strains.
#include "input/case.hpp"

namespace cnem::input {

/// Sets Case::origin and counts every place of the case from it. Along an axis on which the middle of the
/// workpiece is no farther from 0 than its size the origin stays at 0, and so does that of the radius of a
/// body of revolution. Expects a case that was read whole, with places counted from (0, 0).
void use_local_origin(Case& input);

} // namespace cnem::input
