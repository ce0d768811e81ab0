#pragma once
// A tool's shape in space turned and shifted from the frame it was made in.
#include "contact/tool_shape.hpp"

#include <memory>
#include <vector>

namespace cnem::contact {

class PlacedShape final : public ToolShape<3> {
public:
  /// What is at x in the frame of the shape is at rotation x + shift (m). Throws InputError where the matrix
  /// is no rotation (to 1e-9).
  PlacedShape(std::shared_ptr<const ToolShape<3>> shape, const Mat<3>& rotation, const Vec3& shift);

  SurfacePoint<3> closest(const Vec3& x) const override { return placed(shape_->closest(local(x))); }
  void entries(std::span<const Vec3> from, std::span<const Vec3> to,
               std::vector<Entry<3>>& found) const override;
  const std::vector<Ridge<3>>& ridges() const override { return ridges_; }
  Box<3> bounds() const override { return bounds_; }
  double least_thickness() const override { return shape_->least_thickness(); }
  double thickness_along(const Vec3& direction) const override {
    return shape_->thickness_along(rotation_.transpose() * direction);
  }
  double passed(const Vec3& from, const Vec3& to) const override {
    return shape_->passed(local(from), local(to));
  }

private:
  Vec3 local(const Vec3& x) const { return rotation_.transpose() * (x - shift_); }
  SurfacePoint<3> placed(SurfacePoint<3> at) const {
    at.normal = rotation_ * at.normal;
    at.point = rotation_ * at.point + shift_;
    return at;
  }

  std::shared_ptr<const ToolShape<3>> shape_;
  Mat<3> rotation_;
  Vec3 shift_;
  std::vector<Ridge<3>> ridges_;
  Box<3> bounds_;
};

/// The rotation by an angle (rad) about an axis, right-handed.
Mat<3> rotation_about(const Vec3& axis, double angle);

/// The rotation that takes the z axis to a unit vector; half a turn about x where it is −z.
Mat<3> rotation_of_z(const Vec3& to);

} // namespace cnem::contact
