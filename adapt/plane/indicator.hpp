#pragma once
// The indicator on cells of the plane.
#include "adapt/indicator.hpp"
#include "adapt/plane/structure.hpp"

namespace cnem::adapt {

/// With Sibson interpolation on Voronoi cells.
Indicator indicator(const Cloud<2>& cloud, const Structure& structure, const Field& value);

} // namespace cnem::adapt
