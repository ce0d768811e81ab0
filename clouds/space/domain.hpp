#pragma once
// Bodies in space that are described by outlines of the plane or by a closed surface of facets.
#include "clouds/generate.hpp"
#include "core/geometry/stl.hpp"

#include <array>
#include <string>
#include <variant>
#include <vector>

namespace cnem::clouds {

using SpaceRefinement = RefinementIn<3>;
using SpaceSpacing = SpacingFieldIn<3>;

/// Outline and holes of the plane z = 0, drawn along z. Its pieces give their names to the sides.
struct Extrusion {
  DomainShape outline;                 ///< without cracks
  double from = 0.0, to = 0.0;         ///< m, from < to
  std::string low = "z-", high = "z+"; ///< names of the ends
};

/// An outline with holes in the half-plane of radius x ≥ 0 and height y, turned about the axis, which becomes
/// z, from the half-plane y = 0, x ≥ 0 on. Its pieces give their names to what they sweep; pieces on the axis
/// sweep nothing.
struct Revolution {
  DomainShape profile;                         ///< without cracks
  Vec3 origin{0, 0, 0};                        ///< m, where (0, 0) of the profile comes to lie
  double angle = 0.0;                          ///< rad, in (0, 2π]
  std::string low = "theta-", high = "theta+"; ///< names of the ends, where the angle leaves some
};

/// A closed surface that is given by facets, and remeshed to the wanted spacing.
struct Faceted {
  struct Name {
    Vec3 at; ///< m
    std::string name;
  };
  FacetSoup soup;
  double crease_angle = 0.6981317; ///< rad (40°): sharper edges are kept
  std::vector<Name> names;         ///< of the parts between creases that are nearest to the points
};

using SpaceDomain = std::variant<Extrusion, Revolution, Faceted>;

} // namespace cnem::clouds
