#pragma once
// Surfaces in STL files.
#include "clouds/space/domain.hpp"

#include <string_view>

namespace cnem::clouds {

/// The facets of the bytes of an STL file, in text or binary, with lengths times `scale`: m per unit of the
/// file. Normals of the file are not used. Throws GeometryError, with line or facet, for what is no STL.
FacetSoup read_stl(std::string_view bytes, double scale);

} // namespace cnem::clouds
