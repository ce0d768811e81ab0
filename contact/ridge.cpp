#include "contact/ridge.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace cnem::contact {
namespace {

constexpr double tolerance = 1e-6; ///< rad

} // namespace

bool Ridge<2>::faces(const Vec2& n) const {
  double turn = std::atan2(cross(first, n), first.dot(n));
  if (turn < -tolerance) turn += full_turn;
  return turn <= angle + tolerance;
}

double Ridge<2>::sagitta(double l) const {
  const double most = radius * (1.0 - std::cos(0.5 * std::min(angle, std::numbers::pi)));
  if (l >= 2.0 * radius) return most;
  return std::min(most, 0.25 * l * l / (radius + std::sqrt(radius * radius - 0.25 * l * l)));
}

double Ridge<2>::sharpness(double l) const {
  const double chord = 2.0 * radius * std::sin(0.5 * std::min(angle, std::numbers::pi));
  return chord > 0.0 ? smooth_step(l / chord - 1.0) : 1.0;
}

double Ridge<2>::distance(const Vec2& x) const {
  const Vec2 off = x - centre;
  const double from_centre = off.norm();
  if (from_centre > 0.0 && faces(off / from_centre)) return std::abs(from_centre - radius);
  const Vec2 last = Eigen::Rotation2Dd(angle) * first;
  return std::min((off - radius * first).norm(), (off - radius * last).norm());
}

Ridge<3>::Place Ridge<3>::at(double along) const {
  const Vec3 w = v.cross(u);
  if (path != Path::circular)
    return {origin + section.centre.x() * u + section.centre.y() * v + along * w, u, w};
  const double c = std::cos(along), s = std::sin(along);
  const Vec3 radial = c * u + s * w;
  return {origin + section.centre.x() * radial + section.centre.y() * v, radial, c * w - s * u};
}

Ridge<3>::Place Ridge<3>::facing(const Vec3& x) const {
  const Vec3 from = x - origin, out = from - from.dot(v) * v;
  const double radius = out.norm();
  const Vec3 radial = radius > 0.0 ? Vec3(out / radius) : u;
  return {origin + section.centre.x() * radial + section.centre.y() * v, radial, v.cross(radial)};
}

Vec2 Ridge<3>::across(const Vec3& x) const {
  const Vec3 from = x - origin;
  const double axial = from.dot(v);
  return {path == Path::circular ? (from - axial * v).norm() : from.dot(u), axial};
}

double Ridge<3>::distance(const Vec3& x) const { return (across(x) - section.centre).norm(); }

double Ridge<3>::clearance(const Vec3& x) const {
  if (path == Path::corner) return (x - origin).norm();
  double along = 0.0;
  if (path == Path::straight) {
    along = std::clamp((x - origin).dot(v.cross(u)), 0.0, length);
  } else {
    along = turn_towards(x); // beyond the end: the nearer one
    if (along > length) along = along - length < full_turn - along ? length : 0.0;
  }
  const Place place = at(along);
  const Vec3 off = x - place.centre;
  const Ridge<2> there{{0, 0}, section.radius, section.first, section.angle};
  return std::hypot(there.distance({off.dot(place.u), off.dot(v)}), off.dot(place.tangent));
}

double Ridge<3>::turn_towards(const Vec3& x) const {
  const Vec3 from = x - origin;
  const double turn = std::atan2(from.dot(v.cross(u)), from.dot(u));
  return turn < 0.0 ? turn + full_turn : turn;
}

bool Ridge<3>::faces(const Vec3& n) const {
  if (path == Path::corner) {
    for (std::size_t k = 0; k < cone.size(); ++k)
      if (cone[k].cross(cone[(k + 1) % cone.size()]).dot(n) < -tolerance) return false;
    return true;
  }
  const double axial = n.dot(v), radial = (n - axial * v).norm();
  if (!section.faces({radial, axial})) return false;
  if (radial < tolerance || length >= full_turn) return true;
  const double turn = turn_towards(origin + n);
  return turn <= length + tolerance || turn >= full_turn - tolerance;
}

Box<3> Ridge<3>::bounds() const {
  Box<3> box{at(0.0).centre, at(0.0).centre};
  const auto include = [&](const Vec3& x) {
    box.low = box.low.cwiseMin(x);
    box.high = box.high.cwiseMax(x);
  };
  if (path == Path::straight) include(at(length).centre);
  if (path == Path::circular) { // corners of a polygon round it
    const int parts = 1 + static_cast<int>(length / 0.5);
    const double step = length / parts, beyond = section.centre.x() * (1.0 / std::cos(0.5 * step) - 1.0);
    for (int k = 0; k < parts; ++k) {
      const Place middle = at((k + 0.5) * step);
      include(middle.centre + beyond * middle.u);
      include(at((k + 1) * step).centre);
      const double out = (section.centre.x() + beyond) * std::sin(0.5 * step);
      for (const double side : {-out, out}) include(middle.centre + side * middle.tangent);
    }
  }
  box.low.array() -= section.radius;
  box.high.array() += section.radius;
  return box;
}

Ridge<3> Ridge<3>::moved(const Mat<3>& rotation, const Vec3& shift) const {
  Ridge<3> image = *this;
  image.origin = rotation * origin + shift;
  image.u = rotation * u;
  image.v = rotation * v;
  for (Vec3& n : image.cone) n = rotation * n;
  return image;
}

} // namespace cnem::contact
