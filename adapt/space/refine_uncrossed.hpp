#pragma once
// The surface of a pass in space: refined where it does not cross itself for that.
#include "adapt/space/refine_surface.hpp"
#include "adapt/space/resample.hpp"

namespace cnem::adapt {

/// A surface with its resolution restored; nodes at which it would cross itself then are left as they are.
struct UncrossedSurface {
  WorkingSurface surface;
  RefinedSurface changes;
  Field size; ///< [node] m, as refine_surface() leaves it
  PassReport report;
  bool sound = true; ///< whether the facets are known not to cross each other
};

/// As refine_surface(), up to four times. size: m, [node] wanted spacing; sound: whether the facets of the
/// cloud are known not to cross each other. Throws GeometryError as refine_surface().
UncrossedSurface refine_uncrossed(const Cloud<3>& cloud, const NodeProperties& properties, const Field& size,
                                  const SpaceRules& rules, bool sound);

} // namespace cnem::adapt
