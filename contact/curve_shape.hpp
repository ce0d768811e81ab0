#pragma once
// A 2D tool bounded by a closed curve of segments and arcs.
#include "contact/thickness.hpp"
#include "contact/tool_shape.hpp"
#include "core/geometry/curve.hpp"

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
  double least_thickness() const override { return thickness_.least(); }
  double thickness_along(const Vec2& direction) const override { return thickness_.along(direction); }
  double passed(const Vec2& from, const Vec2& to) const override { return thickness_.passed(from, to); }
  const Curve& curve() const { return curve_; }

private:
  /// A piece with what its distances need, computed once.
  struct Face {
    Vec2 from{0, 0}, to{0, 0};
    Vec2 along{0, 0}, normal{0, 0}; ///< –, unit, at `from`
    double length = 0.0;            ///< m
    Vec2 centre{0, 0};
    double radius = 0.0; ///< m, 0 for a segment
    double side = 1.0;   ///< +1: the arc is convex; −1: it is a hollow of the tool
    double sweep = 0.0;  ///< rad, ≥ 0

    explicit Face(const CurvePiece& piece);
    bool spans(const Vec2& direction) const;
    Vec2 foot(const Vec2& x, int& end) const;
    Vec2 normal_towards(const Vec2& x) const;
    double gap(const Vec2& x) const;
    double crossing(const Vec2& a, const Vec2& b, double start, double stop) const;
  };

  Curve curve_;
  Thickness thickness_;
  std::vector<Face> faces_;
  std::vector<Vec2> corner_normal_; ///< [piece] sum of the outward normals on both sides of its `from`
  std::vector<Ridge<2>> ridges_;
  Box<2> bounds_;
  double tolerance_; ///< m, below it two lengths are one
};

} // namespace cnem::contact
