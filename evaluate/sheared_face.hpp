#pragma once
// The zones of a sheared face in the boundary of a body. Pure geometry: docs/blanking.md has the definitions.
#include "evaluate/blanking_result.hpp"

#include <vector>

namespace cnem::evaluate {

/// What a facet of a body's boundary is: metal of the sheet's outline, the same where it is broken without
/// having opened, new by fracture, or of another surface that was there before (the wall of a hole).
enum class FaceSurface : char { metal, broken, fracture, other };

/// A closed boundary in the coordinates of a face: u towards the cut, w from the drawn-in side into the
/// sheet. Either sense of travel.
struct FaceOutline {
  std::vector<Vec2> point;          ///< [point] m
  std::vector<FaceSurface> surface; ///< [point] of the facet from this point to the next
};

struct FaceRules {
  double thickness = 0.0;   ///< m, of the sheet before
  double parallel = 0.1745; ///< rad, the face is parallel to the cutting direction within this
  double smoothing = 0.0;   ///< m, length of the chords that directions are taken from
  double edge = 0.0;  ///< m, u of the tool that made the face: where it is looked for in a body that is whole
  double limit = 0.0; ///< m, u beyond which the outline is another part of the body
  bool whole_surface =
      false;          ///< the tilt is that of the whole drawn-in surface, not of the sheet beside the cut
  bool fixed = false; ///< the body cannot tilt: it ends at a plane of symmetry
  double turn = 0.0;  ///< rad, by which the body has turned since the start, from u towards w
};

/// Bodies that have turned by more are measured in a frame that turns with them, rad.
inline constexpr double steep = 0.5235987755982988; // 30 degrees

/// Measures one face. `body` and `cut` are left to the caller. Fewer than three points are no face: its note
/// says so.
ShearedFace measure_face(const FaceOutline& outline, const FaceRules& rules);

} // namespace cnem::evaluate
