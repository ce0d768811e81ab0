#pragma once
// The cutting edge of a tooth as a polyline, from the triangles of its rake face.
#include "core/geometry/triangle_surface.hpp"
#include "core/vec.hpp"

#include <vector>

namespace cnem::machining {

/// Where an edge is in axes of the cutter: z up from the tip along its axis, φ from +y clockwise seen from
/// +z.
class CuttingEdge {
public:
  /// The edge of a rake face whose triangles are joined: the part of its boundary on the outer side of what
  /// the face sweeps round the axis. Throws GeometryError where there is none: a face with holes or of
  /// several pieces, an edge that does not rise all along, matter of the face outside of it.
  explicit CuttingEdge(const TriangleSurface& rake);

  const std::vector<Vec3>& points() const { return points_; } ///< m, upwards
  double bottom() const { return points_.front().z(); }       ///< m
  double top() const { return points_.back().z(); }           ///< m
  double radius() const;                                      ///< m, the largest

  // Of its part between two heights, m, which it is cut to.
  double mean_radius(double from, double to) const; ///< m, over the height
  double length(double from, double to) const;      ///< m, of the profile, without the way round the axis
  /// rad between the axis and the normal of the profile: its slope from end to end, at a height
  /// that of its part there.
  double lead(double from, double to) const;
  /// rad, mean over the height of by how much it stands behind +y; at a height.
  double lag(double from, double to) const;
  double lag(double z) const;
  /// rad between the edge and the normal of its motion's plane, and between rake face and that normal across
  /// the edge (oblique cutting: inclination and normal rake); means over the length.
  struct Angles {
    double inclination = 0.0, rake = 0.0;
  };
  Angles angles(double from, double to) const;

private:
  std::size_t segment(double z) const;
  Vec3 at(double z) const;
  /// Calls visit(a, b, segment) for the straight parts between two heights.
  template<class Visit> void over(double from, double to, Visit&& visit) const;

  std::vector<Vec3> points_;  ///< m
  std::vector<double> lag_;   ///< [point] rad
  std::vector<Vec3> normals_; ///< [segment] of the rake face there, towards the motion
};

} // namespace cnem::machining
