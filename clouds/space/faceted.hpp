#pragma once
// Surfaces that are given by facets.
#include "clouds/space/surface.hpp"

namespace cnem::clouds {

/// The facets as a closed surface that is divided into pieces (remeshed_surface), on the corners that are
/// given; several pieces may bear one name. Throws as remeshed_surface.
Cloud<3> divided_surface(const Faceted& shape);

} // namespace cnem::clouds
