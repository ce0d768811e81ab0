#pragma once
// Sides of a body in space that continue each other have the same nodes.
#include "clouds/space/domain.hpp"
#include "core/error.hpp"

#include <array>
#include <string>
#include <utility>

namespace cnem::clouds {

/// Two pieces that cannot have the same nodes.
struct RepeatError : GeometryError {
  RepeatError(const std::string& what, std::array<std::string, 2> names)
      : GeometryError(what), pieces(std::move(names)) {}
  std::array<std::string, 2> pieces;
};

/// Makes the second of two named pieces of a closed surface a shifted copy of the first: nodes on its border
/// move to where those of the first are, those inside give way to theirs. The shift is the distance of the
/// centroids of the two borders. O(F log F). Throws RepeatError where the borders do not match within a
/// quarter of the spacing: the pieces have other shapes, or another spacing along their edges.
void repeat_piece(Cloud<3>& surface, const std::array<std::string, 2>& pieces, const SpaceSpacing& spacing);

} // namespace cnem::clouds
