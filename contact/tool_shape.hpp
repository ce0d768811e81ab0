#pragma once
// What contact has to know about the shape of a rigid tool, in the tool's own frame (its place at t = 0).
#include "core/vec.hpp"

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

namespace cnem::contact {

/// The point of a tool's surface closest to a given point.
template<int dim> struct SurfacePoint {
  double distance = 0.0;              ///< m, signed: negative inside the tool
  Vec<dim> normal = Vec<dim>::Zero(); ///< –, unit, out of the tool (gradient of the distance)
  Vec<dim> point = Vec<dim>::Zero();  ///< m, on the surface
  std::int32_t feature = -1;          ///< piece of the surface (2D: index of the curve piece)
};

/// A point of the workpiece that is inside a tool at the end of a step.
template<int dim> struct Entry {
  std::int32_t index = 0; ///< of the point in the lists given to ToolShape::entries
  SurfacePoint<dim> at;   ///< surface it came through (or the closest), seen from its end position
  double start = 0.0;     ///< m, signed distance from the same surface at the start of the step
};

/// A convex ridge of a tool, sharp or rounded, that may pass between nodes of the workpiece.
template<int dim> struct Ridge;

/// In 2D: a circular arc of outward normals from `first`, turning counter-clockwise by `angle`.
template<> struct Ridge<2> {
  Vec2 centre{0, 0};   ///< m
  double radius = 0.0; ///< m, 0 for a sharp corner
  Vec2 first{0, 0};    ///< –, outward normal where the ridge begins
  double angle = 0.0;  ///< rad, in (0, 2π]

  /// Is the unit vector n among the outward normals, to a tolerance of 1e-6 rad?
  bool faces(const Vec2& n) const;
  /// The point of the ridge that reaches furthest along the unit vector n, which it faces.
  Vec2 extreme(const Vec2& n) const { return centre + radius * n; }
  /// How far a chord of length l with both ends on the ridge lies inside the tool, m; never more than the
  /// whole ridge allows, so that it vanishes with the radius.
  double sagitta(double l) const;
  /// How far an edge of length l meets the ridge as a corner: 0 where it is no longer than the chord of the
  /// whole arc, 1 from twice that on, smooth between.
  double sharpness(double l) const;
};

/// 0 up to x = 0, 1 from x = 1 on, with continuous slope.
inline double smooth_step(double x) {
  x = std::clamp(x, 0.0, 1.0);
  return x * x * (3.0 - 2.0 * x);
}

/// In space only smooth tools are known (contact/plane_shape.hpp): none has a ridge.
template<> struct Ridge<3> {};

template<int dim> struct Box {
  Vec<dim> low, high; ///< m
  bool contains(const Vec<dim>& x) const {
    return (x.array() >= low.array()).all() && (x.array() <= high.array()).all();
  }
};

/// A closed surface around the solid of a tool. Called for lists of points, never inside a loop over nodes.
template<int dim> class ToolShape {
public:
  virtual ~ToolShape() = default;

  virtual SurfacePoint<dim> closest(const Vec<dim>& x) const = 0;

  /// Appends those points that are inside at the end of their straight path from[i] → to[i]. The surface of
  /// an entry is the one the path came through last; for a point that was inside from the start, the closest.
  virtual void entries(std::span<const Vec<dim>> from, std::span<const Vec<dim>> to,
                       std::vector<Entry<dim>>& found) const = 0;

  virtual const std::vector<Ridge<dim>>& ridges() const = 0;
  virtual Box<dim> bounds() const = 0;

  /// m; no path shorter than it goes through the solid (contact/thickness.hpp).
  virtual double least_thickness() const = 0;
  /// m, where it is thinnest along a unit vector; infinite where no path along it goes through.
  virtual double thickness_along(const Vec<dim>& direction) const = 0;
  /// m, thickness where the straight path from → to goes through the solid; 0 where it does not.
  virtual double passed(const Vec<dim>& from, const Vec<dim>& to) const = 0;
};

} // namespace cnem::contact
