#pragma once
// Where a surface in space crosses or touches itself.
#include "core/geometry/cloud.hpp"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace cnem::voronoi {

/// Pairs of facets that have points in common besides the corners and edges that they share, by number. Twins
/// count as one node: the two faces of a closed slit do not cross. Nor do those of two bodies (Cloud::body).
/// A facet without area is paired with itself. Predicates are exact; which facets come near each other is
/// found as by Zomorodian and Edelsbrunner (2002): O(F log² F).
std::vector<std::array<CloudFacetIndex, 2>> crossings(const Cloud<3>& cloud);

/// Those of them in which a suspect is, of a surface whose other facets are known not to cross each other.
/// O(suspects · F).
std::vector<std::array<CloudFacetIndex, 2>> crossings(const Cloud<3>& cloud,
                                                      const std::vector<CloudFacetIndex>& suspects);

/// The first of them as "facet … and facet …", with positions; none where there is none.
std::optional<std::string> describe_crossing(const Cloud<3>& cloud);

} // namespace cnem::voronoi
