#include "contact/triangle_shape.hpp"

#include "contact/passage.hpp"
#include "core/index.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <tuple>
#include <utility>

namespace cnem::contact {
namespace {

constexpr double least_ridge = 5.0 * std::numbers::pi / 180.0; ///< rad

} // namespace

TriangleShape::TriangleShape(TriangleSurface surface)
    : distance_((check_closed(surface), std::move(surface))),
      tolerance_(1e-12 * (bounds().high - bounds().low).norm()) {
  find_ridges();
  find_thickness();
}

SurfacePoint<3> TriangleShape::closest(const Vec3& x) const {
  const SurfaceDistance::Nearest found = distance_.nearest(x);
  const double length = std::abs(found.distance), side = found.distance < 0.0 ? -1.0 : 1.0;
  return {.distance = found.distance,
          .normal = length > tolerance_ ? Vec3(side / length * (x - found.point)) : found.normal,
          .point = found.point,
          .feature = found.triangle};
}

void TriangleShape::entries(std::span<const Vec3> from, std::span<const Vec3> to,
                            std::vector<Entry<3>>& found) const {
  for (std::size_t i = 0; i < to.size(); ++i) {
    const Vec3 &a = from[i], &b = to[i];
    if (!bounds().contains(b)) continue;
    const SurfacePoint<3> nearest = closest(b);
    if (nearest.distance >= -1e-3 * tolerance_) continue; // rounding, not contact
    Box<3> path{a.cwiseMin(b), a.cwiseMax(b)};
    path.low.array() -= tolerance_;
    path.high.array() += tolerance_;
    double latest = -1.0, shallowest = 0.0;
    std::int32_t through = -1;
    distance_.tree().overlapping(path, [&](std::int32_t t) {
      const Vec3 corner = distance_.surface().corners(index_of(t))[0];
      const Vec3& normal = distance_.normal(index_of(t));
      const double start = normal.dot(a - corner), stop = normal.dot(b - corner);
      if (stop >= 0.0 || start < -tolerance_) return;
      const double s = std::max(start, 0.0) / (std::max(start, 0.0) - stop);
      const Vec3 gate = a + s * (b - a);
      if ((distance_.foot(index_of(t), gate).point - gate).norm() > 10.0 * tolerance_) return;
      const bool later = s > latest || (s == latest && stop > shallowest);
      if (!later && !(s == latest && stop == shallowest && t < through)) return;
      latest = s, shallowest = stop, through = t;
    });
    Entry<3> entry{static_cast<std::int32_t>(i), nearest, 0.0};
    if (through >= 0) {
      const Vec3& normal = distance_.normal(index_of(through));
      const Vec3 corner = distance_.surface().corners(index_of(through))[0];
      entry.at = {shallowest, normal, b - shallowest * normal, through};
      entry.start = normal.dot(a - corner);
    } else {
      entry.start = closest(a).distance;
    }
    found.push_back(entry);
  }
}

void TriangleShape::find_ridges() {
  std::vector<int> met(distance_.surface().points.size(), 0); // ridges at a point
  for (std::size_t t = 0; t < distance_.triangles(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto other = distance_.across(t, k);
      const auto corner = distance_.surface().corners(t);
      const Vec3 edge = corner[(k + 1) % 3] - corner[k];
      const double turn =
          std::atan2(edge.normalized().dot(distance_.normal(t).cross(distance_.normal(other))),
                     distance_.normal(t).dot(distance_.normal(other)));
      if (turn < least_ridge) continue;
      for (const std::size_t end : {k, (k + 1) % 3}) ++met[index_of(distance_.surface().triangles[t][end])];
      if (other < t) continue; // once from either side
      Ridge<3> ridge{.path = Ridge<3>::Path::straight, .section = {}};
      // v×u runs along the edge: the fan turns against it, from the other triangle's normal to this one's
      ridge.origin = corner[k];
      ridge.u = distance_.normal(other);
      ridge.v = distance_.normal(other).cross(edge.normalized());
      ridge.section = {{0, 0}, 0.0, {1, 0}, turn};
      ridge.length = edge.norm();
      ridges_.push_back(std::move(ridge));
    }
  // corners: normals of the triangles round a point, in their order
  std::vector<std::array<std::int32_t, 2>> start(distance_.surface().points.size(), {-1, -1});
  for (std::size_t t = 0; t < distance_.triangles(); ++t)
    for (std::size_t k = 0; k < 3; ++k)
      if (auto& first = start[index_of(distance_.surface().triangles[t][k])]; first[0] < 0)
        first = {as<std::int32_t>(t), as<std::int32_t>(k)};
  for (std::size_t p = 0; p < distance_.surface().points.size(); ++p) {
    if (met[p] < 6 || start[p][0] < 0) continue; // each ridge was met from both sides
    Ridge<3> point{.path = Ridge<3>::Path::corner, .section = {}};
    point.origin = distance_.surface().points[p];
    auto t = index_of(start[p][0]);
    do {
      if (point.cone.empty() || (point.cone.back() - distance_.normal(t)).norm() > 1e-6)
        point.cone.push_back(distance_.normal(t));
      const auto& own = distance_.surface().triangles[t];
      const auto k = index_of(std::find(own.begin(), own.end(), as<std::int32_t>(p)) - own.begin());
      t = distance_.across(t, (k + 2) % 3); // across the edge that ends at the point
    } while (t != index_of(start[p][0]));
    if ((point.cone.back() - point.cone.front()).norm() <= 1e-6) point.cone.pop_back();
    bool convex = point.cone.size() >= 3;
    for (std::size_t k = 0; convex && k < point.cone.size(); ++k)
      for (const Vec3& n : point.cone)
        convex = convex && point.cone[k].cross(point.cone[(k + 1) % point.cone.size()]).dot(n) > -1e-6;
    if (convex) ridges_.push_back(std::move(point));
  }
}

/// Half of the shortest way from the middle of a triangle straight in, to a face that looks away.
void TriangleShape::find_thickness() {
  least_thickness_ = std::numeric_limits<double>::infinity();
  const double size = (bounds().high - bounds().low).norm();
  for (std::size_t t = 0; t < distance_.triangles(); ++t) {
    const auto corner = distance_.surface().corners(t);
    const Vec3 a = (corner[0] + corner[1] + corner[2]) / 3.0, b = a - size * distance_.normal(t);
    distance_.tree().along(a, b, [&](std::int32_t other) {
      const Vec3& normal = distance_.normal(index_of(other));
      const double facing = normal.dot(distance_.normal(t));
      if (index_of(other) == t || facing > -0.4) return;
      const Vec3 on = distance_.surface().corners(index_of(other))[0];
      const double way = normal.dot(a - on) / facing;
      const Vec3 gate = a - way * distance_.normal(t);
      if (way > 0.0 && (distance_.foot(index_of(other), gate).point - gate).norm() <= 1e3 * tolerance_)
        least_thickness_ = std::min(least_thickness_, 0.5 * way);
    });
  }
}

double TriangleShape::thickness_along(const Vec3& direction) const {
  std::vector<Vec3> middles;
  const std::size_t stride = 1 + distance_.triangles() / 2000; // enough to tell before a run
  for (std::size_t t = 0; t < distance_.triangles(); t += stride) {
    const auto corner = distance_.surface().corners(t);
    middles.push_back((corner[0] + corner[1] + corner[2]) / 3.0);
  }
  return thickness_by_tracing(*this, middles, direction);
}

double TriangleShape::passed(const Vec3& from, const Vec3& to) const {
  return passed_by_tracing(*this, from, to);
}

} // namespace cnem::contact
