#pragma once
// The chip that a tool has made, read off the outline of the workpiece. Everything is in the frame of the
// tool (input/cutting_tool.hpp): the tip at the origin, x the way the tool moves, y out of the workpiece.
#include "core/geometry/cloud.hpp"
#include "core/vec.hpp"

#include <limits>
#include <span>
#include <string>
#include <vector>

namespace cnem::evaluate {

inline constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// The boundary loop that the tool cuts, clockwise in the frame of the tool from the node nearest to its tip:
/// up the side of the chip that slides on the rake face, round its end, down its free side, along the uncut
/// surface, round the workpiece and along the machined surface back to the tip.
struct CutOutline {
  std::vector<NodeIndex> node;
  std::vector<Vec2> point; ///< m
};

/// position: [node] m, in the frame of the tool. Empty when there is no loop.
CutOutline cut_outline(const IndexedVector<CloudFacetIndex, Facet<2>>& facets,
                       std::span<const Vec2> position);
/// Of each body its outer loop, clockwise as well, from any node on.
std::vector<CutOutline> outlines_of_bodies(const IndexedVector<CloudFacetIndex, Facet<2>>& facets,
                                           std::span<const Vec2> position);

/// Thickness of the chip at places along its rake side.
struct ThicknessProfile {
  std::vector<double> at;        ///< m, along the rake side from the tip, of a point of the free side
  std::vector<double> thickness; ///< m, from there to that point
};

/// A length of the rake side, m from the tip.
struct Stretch {
  double from = 0.0, to = 0.0;
  double length() const { return to - from; }
};

/// What docs/cutting.md defines. What was not found is not-a-number, and `note` says why.
struct Chip {
  std::string note;                   ///< empty when there is a chip
  double length = unknown;            ///< m, of the rake side
  double shear_plane = unknown;       ///< m, from the tip to the nearest point of the free surface
  double shear_plane_angle = unknown; ///< rad, of that line from the way the tool moves
  double begin = unknown;             ///< m, along the rake side: where the free side begins, square across
  Stretch measured;                   ///< where thickness is measured
  double thickness = unknown, peak = unknown, valley = unknown; ///< m
  std::vector<double> teeth;      ///< m, along the rake side: where they are highest
  double tooth_spacing = unknown; ///< m, along the rake side
  ThicknessProfile profile;       ///< of the measured stretch

  // For whoever asks for more of the same chip.
  std::vector<Vec2> rake_side; ///< m, from the tip to the end of the chip
  std::vector<Vec2> free_side; ///< m, from the foot of the chip at the shear plane to its end
};

/// feed: m. rake: rad.
Chip measure_chip(const CutOutline& outline, double feed, double rake);

/// Mean thickness of a profile over its length; peaks and valleys that stand out by a share of it, and the
/// spacing of the peaks: what measure_chip() uses, for profiles from elsewhere.
struct Teeth {
  double mean = unknown, peak = unknown, valley = unknown, spacing = unknown;
  std::vector<double> at;
};
Teeth measure_teeth(const ThicknessProfile& profile);

/// Radius of the rake side of a chip on a stretch of it, m, from the slope of its direction by least squares;
/// > 0: it curls away from the tool. Not-a-number where it turns by less than 0.05 rad.
double curl_radius(const Chip& chip, const Stretch& part);

/// From a place on the rake side of a chip, m along it from the tip, to the nearest point of its free side.
struct Section {
  Vec2 rake{0, 0}, free{0, 0}; ///< m
  double length() const { return (free - rake).norm(); }
};
Section section_across(const Chip& chip, double at);

/// Where the chip lies that has just left the shear zone: between the shear plane and half a feed beyond its
/// end. A closed polygon, m; empty without a chip.
std::vector<Vec2> fresh_chip(const Chip& chip, double feed);

/// φ of tan φ = r cos γ/(1 − r sin γ), r = feed/thickness (Merchant 1945), rad.
double shear_angle(double feed, double thickness, double rake);

} // namespace cnem::evaluate
