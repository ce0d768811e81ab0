#include "contact/placed_shape.hpp"

#include "core/error.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <utility>

namespace cnem::contact {

PlacedShape::PlacedShape(std::shared_ptr<const ToolShape<3>> shape, const Mat<3>& rotation, const Vec3& shift)
    : shape_(std::move(shape)), rotation_(rotation), shift_(shift) {
  if (!(rotation * rotation.transpose()).isApprox(Mat<3>::Identity(), 1e-9) ||
      !(rotation.determinant() > 0.0))
    throw InputError("a tool is turned by a matrix that is no rotation");
  for (const Ridge<3>& ridge : shape_->ridges()) ridges_.push_back(ridge.moved(rotation_, shift_));
  const Box<3> box = shape_->bounds();
  const Vec3 middle = rotation_ * (0.5 * (box.low + box.high)) + shift_,
             half = rotation_.cwiseAbs() * (0.5 * (box.high - box.low));
  bounds_ = {middle - half, middle + half};
}

void PlacedShape::entries(std::span<const Vec3> from, std::span<const Vec3> to,
                          std::vector<Entry<3>>& found) const {
  std::vector<Vec3> start, stop;
  start.reserve(from.size()), stop.reserve(to.size());
  for (const Vec3& x : from) start.push_back(local(x));
  for (const Vec3& x : to) stop.push_back(local(x));
  const std::size_t first = found.size();
  shape_->entries(start, stop, found);
  for (std::size_t k = first; k < found.size(); ++k) found[k].at = placed(found[k].at);
}

Mat<3> rotation_about(const Vec3& axis, double angle) {
  return Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
}

namespace {

/// The shortest rotation between unit vectors that are not opposite. Eigen's own takes a singular value
/// decomposition for those that are, which compiles for longer than all else here.
Mat<3> shortest_rotation(const Vec3& from, const Vec3& to) {
  const double s = std::sqrt(2.0 * (1.0 + to.dot(from)));
  const Vec3 axis = from.cross(to) / s;
  return Eigen::Quaterniond(0.5 * s, axis.x(), axis.y(), axis.z()).normalized().toRotationMatrix();
}

} // namespace

Mat<3> rotation_of_z(const Vec3& to) {
  const Vec3 z(0, 0, 1), end = to.normalized();
  if (end.dot(z) < -1.0 + 1e-12)
    return shortest_rotation(-z, end) * rotation_about({1, 0, 0}, std::numbers::pi);
  return shortest_rotation(z, end);
}

} // namespace cnem::contact
