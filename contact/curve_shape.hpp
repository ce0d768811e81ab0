#pragma once
// A 2D tool bounded by a closed curve of segments and arcs.
#include "contact/tool_shape.hpp"
#include "core/curve.hpp"

namespace cnem::contact {

class CurveShape : public ToolShape<2> {
public:
  /// The curve runs counter-clockwise round the solid. Throws InputError when it is not closed, runs
  /// clockwise, has a piece of no length or an arc whose ends are not on its circle.
  explicit CurveShape(Curve curve);

  SurfacePoint<2> closest(const Vec2& x) const override;
  void entries(std::span<const Vec2> from, std::span<const Vec2> to,
               std::vector<Entry<2>>& found) const override;
  const std::vector<Ridge<2>>& ridges() const override { return ridges_; }
  Box<2> bounds() const override { return bounds_; }
  const Curve& curve() const { return curve_; }

private:
  Curve curve_;
  std::vector<Vec2> corner_normal_; ///< [piece] sum of the outward normals on both sides of its `from`
  std::vector<Ridge<2>> ridges_;
  Box<2> bounds_;
  double tolerance_; ///< m, below it two lengths are one
};

} // namespace cnem::contact
