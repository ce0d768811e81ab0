#pragma once
// Tools in space that are swept by a plane section: extruded outlines, solids of revolution, and sections
// that go along an outline.
#include "contact/curve_shape.hpp"
#include "contact/tool_shape.hpp"

#include <optional>
#include <vector>

namespace cnem::contact {

/// The solid of the points whose (d, z) lie in a plane section: z along the axis, and d the signed distance,
/// in the plane normal to it, from an outline (positive outside of it), or from the axis. As (d, z) are
/// orthogonal and of unit gradient, distances from the section are distances in space wherever the way to the
/// surface leaves the foot on the outline where it is: near the surface always, and everywhere for solids of
/// revolution, convex outlines with what is inside them, and openings. Beyond the medial axis of an outline
/// distances are lower bounds of the true ones, with the right sign.
class SweptShape final : public ToolShape<3> {
public:
  /// Outline in the plane z = 0, from z = low to high; edges at these ends are rounded by a radius, 0 for
  /// sharp ones. Throws InputError for low ≥ high, and radii that do not fit between the ends or into a
  /// convex corner of the outline.
  static SweptShape extruded(Curve outline, double low, double high, double radius_low = 0.0,
                             double radius_high = 0.0);

  /// The section's coordinates are the distance from the z axis, ≥ 0, and z; pieces on the axis are no
  /// surface. Throws InputError where the section reaches beyond the axis or touches it in several places.
  static SweptShape revolved(const Curve& section);

  /// The section goes along the outline: its x is the distance from the outline, positive outside of it (a
  /// die round an opening), its y is z. Throws InputError where a rounded edge does not fit into a corner.
  static SweptShape along(Curve outline, Curve section);

  SurfacePoint<3> closest(const Vec3& x) const override;
  void entries(std::span<const Vec3> from, std::span<const Vec3> to,
               std::vector<Entry<3>>& found) const override;
  const std::vector<Ridge<3>>& ridges() const override { return ridges_; }
  Box<3> bounds() const override { return bounds_; }
  double least_thickness() const override { return least_thickness_; }
  double thickness_along(const Vec3& direction) const override;
  double passed(const Vec3& from, const Vec3& to) const override;

private:
  /// Where a point is from the outline or axis.
  struct Footing {
    double distance = 0.0;    ///< m
    Vec2 outwards{1, 0};      ///< –, unit, its gradient
    std::int32_t feature = 0; ///< piece of the outline
  };

  SweptShape(std::optional<CurveShape> outline, CurveShape section);
  Footing footing(const Vec2& x) const;
  SurfacePoint<3> in_space(const SurfacePoint<2>& on_section, const Footing& foot, const Vec3& x) const;
  bool on_own_outline(const SurfacePoint<2>& at) const;

  std::optional<CurveShape> outline_; ///< none: of revolution
  CurveShape section_;
  std::vector<Ridge<3>> ridges_;
  Box<3> bounds_;
  double least_thickness_ = 0.0;
};

/// The ridges of such a solid; outline: none for a solid of revolution, whose section is on both sides of the
/// axis. Throws InputError where a rounded edge does not fit into a sharp corner of the outline.
std::vector<Ridge<3>> swept_ridges(const CurveShape* outline, const CurveShape& section);

} // namespace cnem::contact
