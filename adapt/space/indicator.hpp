#pragma once
// The indicator of a field on the cells of a cloud in space.
#include "adapt/indicator.hpp"
#include "adapt/space/structure.hpp"

namespace cnem::adapt {

/// On the cells of the structure: f* are Sibson's functions on Voronoi cells, the linear ones of the
/// tetrahedra on median cells. value: [cell]. O(N).
Indicator indicator(const Cloud<3>& cloud, const SpaceStructure& structure, scni::CellKind cells,
                    const Field& value);

} // namespace cnem::adapt
