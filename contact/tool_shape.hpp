#pragma once
// What contact has to know about the shape of a rigid tool, in the tool's own frame (its place at t = 0).
#include "contact/ridge.hpp"
#include "core/vec.hpp"

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
