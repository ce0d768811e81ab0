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

Box<3> box_of(const std::array<Vec3, 3>& x) {
  return {x[0].cwiseMin(x[1]).cwiseMin(x[2]), x[0].cwiseMax(x[1]).cwiseMax(x[2])};
}

double angle_at(const std::array<Vec3, 3>& x, std::size_t k) {
  const Vec3 e = x[(k + 1) % 3] - x[k], f = x[(k + 2) % 3] - x[k];
  return std::atan2(e.cross(f).norm(), e.dot(f));
}

} // namespace

TriangleShape::TriangleShape(TriangleSurface surface) : surface_(std::move(surface)) {
  check_closed(surface_);
  const std::size_t n = surface_.triangles.size();
  std::vector<Box<3>> boxes;
  at_point_.assign(surface_.points.size(), Vec3::Zero());
  bounds_ = box_of(surface_.corners(0));
  for (std::size_t t = 0; t < n; ++t) {
    const auto corner = surface_.corners(t);
    normal_.push_back((corner[1] - corner[0]).cross(corner[2] - corner[0]).normalized());
    for (std::size_t k = 0; k < 3; ++k)
      at_point_[index_of(surface_.triangles[t][k])] += angle_at(corner, k) * normal_[t];
    boxes.push_back(box_of(corner));
    bounds_ = {bounds_.low.cwiseMin(boxes.back().low), bounds_.high.cwiseMax(boxes.back().high)};
  }
  for (Vec3& normal : at_point_) normal.normalize();
  tree_ = BoxTree(std::move(boxes));
  tolerance_ = 1e-12 * (bounds_.high - bounds_.low).norm();
  std::vector<std::tuple<std::int32_t, std::int32_t, std::size_t, std::size_t>> sides;
  for (std::size_t t = 0; t < n; ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int32_t a = surface_.triangles[t][k], b = surface_.triangles[t][(k + 1) % 3];
      sides.emplace_back(std::min(a, b), std::max(a, b), t, k);
    }
  std::sort(sides.begin(), sides.end());
  next_.resize(n);
  for (std::size_t s = 0; s < sides.size(); s += 2) {
    const auto [low, high, t, k] = sides[s];
    const auto [low2, high2, other, l] = sides[s + 1];
    next_[t][k] = as<std::int32_t>(other);
    next_[other][l] = as<std::int32_t>(t);
  }
  find_ridges();
  find_thickness();
}

/// Closest point of a triangle (Ericson, Real-Time Collision Detection, 5.1.5).
TriangleShape::Foot TriangleShape::foot(std::size_t triangle, const Vec3& x) const {
  const auto [a, b, c] = surface_.corners(triangle);
  const auto on_edge = [](const Vec3& p, const Vec3& q, double s, std::size_t i, std::size_t j) {
    Foot foot{p + s * (q - p), {}};
    foot.weight[i] = 1.0 - s;
    foot.weight[j] = s;
    return foot;
  };
  const Vec3 ab = b - a, ac = c - a, ax = x - a, bx = x - b, cx = x - c;
  const double d1 = ab.dot(ax), d2 = ac.dot(ax);
  if (d1 <= 0.0 && d2 <= 0.0) return {a, {1, 0, 0}};
  const double d3 = ab.dot(bx), d4 = ac.dot(bx);
  if (d3 >= 0.0 && d4 <= d3) return {b, {0, 1, 0}};
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) return on_edge(a, b, d1 / (d1 - d3), 0, 1);
  const double d5 = ab.dot(cx), d6 = ac.dot(cx);
  if (d6 >= 0.0 && d5 <= d6) return {c, {0, 0, 1}};
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) return on_edge(a, c, d2 / (d2 - d6), 0, 2);
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0.0 && d4 >= d3 && d5 >= d6) return on_edge(b, c, (d4 - d3) / ((d4 - d3) + (d5 - d6)), 1, 2);
  const double sum = va + vb + vc, v = vb / sum, w = vc / sum;
  return {a + v * ab + w * ac, {1.0 - v - w, v, w}};
}

/// Outward normal of the triangle, or of the edge or corner that the weights leave.
Vec3 TriangleShape::normal_at(std::size_t triangle, const std::array<double, 3>& weight) const {
  for (std::size_t k = 0; k < 3; ++k)
    if (weight[k] == 1.0) return at_point_[index_of(surface_.triangles[triangle][k])];
  for (std::size_t k = 0; k < 3; ++k)
    if (weight[k] == 0.0)
      return (normal_[triangle] + normal_[index_of(next_[triangle][(k + 1) % 3])]).normalized();
  return normal_[triangle];
}

SurfacePoint<3> TriangleShape::closest(const Vec3& x) const {
  double least = std::numeric_limits<double>::infinity();
  const std::int32_t best = tree_.nearest(
      x, [&](std::int32_t t) { return (x - foot(index_of(t), x).point).squaredNorm(); }, least);
  const Foot foot = this->foot(index_of(best), x);
  const Vec3 outwards = normal_at(index_of(best), foot.weight), away = x - foot.point;
  SurfacePoint<3> at{.point = foot.point, .feature = best};
  const double length = std::sqrt(least), side = away.dot(outwards) < 0.0 ? -1.0 : 1.0;
  at.distance = side * length;
  at.normal = length > tolerance_ ? Vec3(side / length * away) : outwards;
  return at;
}

void TriangleShape::entries(std::span<const Vec3> from, std::span<const Vec3> to,
                            std::vector<Entry<3>>& found) const {
  for (std::size_t i = 0; i < to.size(); ++i) {
    const Vec3 &a = from[i], &b = to[i];
    if (!bounds_.contains(b)) continue;
    const SurfacePoint<3> nearest = closest(b);
    if (nearest.distance >= -1e-3 * tolerance_) continue; // rounding, not contact
    Box<3> path{a.cwiseMin(b), a.cwiseMax(b)};
    path.low.array() -= tolerance_;
    path.high.array() += tolerance_;
    double latest = -1.0, shallowest = 0.0;
    std::int32_t through = -1;
    tree_.overlapping(path, [&](std::int32_t t) {
      const Vec3 corner = surface_.corners(index_of(t))[0];
      const Vec3& normal = normal_[index_of(t)];
      const double start = normal.dot(a - corner), stop = normal.dot(b - corner);
      if (stop >= 0.0 || start < -tolerance_) return;
      const double s = std::max(start, 0.0) / (std::max(start, 0.0) - stop);
      const Vec3 gate = a + s * (b - a);
      if ((foot(index_of(t), gate).point - gate).norm() > 10.0 * tolerance_) return;
      const bool later = s > latest || (s == latest && stop > shallowest);
      if (!later && !(s == latest && stop == shallowest && t < through)) return;
      latest = s, shallowest = stop, through = t;
    });
    Entry<3> entry{static_cast<std::int32_t>(i), nearest, 0.0};
    if (through >= 0) {
      const Vec3& normal = normal_[index_of(through)];
      const Vec3 corner = surface_.corners(index_of(through))[0];
      entry.at = {shallowest, normal, b - shallowest * normal, through};
      entry.start = normal.dot(a - corner);
    } else {
      entry.start = closest(a).distance;
    }
    found.push_back(entry);
  }
}

void TriangleShape::find_ridges() {
  std::vector<int> met(surface_.points.size(), 0); // ridges at a point
  for (std::size_t t = 0; t < normal_.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const auto other = index_of(next_[t][k]);
      const auto corner = surface_.corners(t);
      const Vec3 edge = corner[(k + 1) % 3] - corner[k];
      const double turn =
          std::atan2(edge.normalized().dot(normal_[t].cross(normal_[other])), normal_[t].dot(normal_[other]));
      if (turn < least_ridge) continue;
      for (const std::size_t end : {k, (k + 1) % 3}) ++met[index_of(surface_.triangles[t][end])];
      if (other < t) continue; // once from either side
      Ridge<3> ridge{.path = Ridge<3>::Path::straight, .section = {}};
      // v×u runs along the edge: the fan turns against it, from the other triangle's normal to this one's
      ridge.origin = corner[k];
      ridge.u = normal_[other];
      ridge.v = normal_[other].cross(edge.normalized());
      ridge.section = {{0, 0}, 0.0, {1, 0}, turn};
      ridge.length = edge.norm();
      ridges_.push_back(std::move(ridge));
    }
  // corners: normals of the triangles round a point, in their order
  std::vector<std::array<std::int32_t, 2>> start(surface_.points.size(), {-1, -1});
  for (std::size_t t = 0; t < normal_.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k)
      if (auto& first = start[index_of(surface_.triangles[t][k])]; first[0] < 0)
        first = {as<std::int32_t>(t), as<std::int32_t>(k)};
  for (std::size_t p = 0; p < surface_.points.size(); ++p) {
    if (met[p] < 6 || start[p][0] < 0) continue; // each ridge was met from both sides
    Ridge<3> point{.path = Ridge<3>::Path::corner, .section = {}};
    point.origin = surface_.points[p];
    auto t = index_of(start[p][0]);
    do {
      if (point.cone.empty() || (point.cone.back() - normal_[t]).norm() > 1e-6)
        point.cone.push_back(normal_[t]);
      const auto& own = surface_.triangles[t];
      const auto k = index_of(std::find(own.begin(), own.end(), as<std::int32_t>(p)) - own.begin());
      t = index_of(next_[t][(k + 2) % 3]); // across the edge that ends at the point
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
  const double size = (bounds_.high - bounds_.low).norm();
  for (std::size_t t = 0; t < normal_.size(); ++t) {
    const auto corner = surface_.corners(t);
    const Vec3 a = (corner[0] + corner[1] + corner[2]) / 3.0, b = a - size * normal_[t];
    tree_.along(a, b, [&](std::int32_t other) {
      const Vec3& normal = normal_[index_of(other)];
      const double facing = normal.dot(normal_[t]);
      if (index_of(other) == t || facing > -0.4) return;
      const Vec3 on = surface_.corners(index_of(other))[0];
      const double way = normal.dot(a - on) / facing;
      const Vec3 gate = a - way * normal_[t];
      if (way > 0.0 && (foot(index_of(other), gate).point - gate).norm() <= 1e3 * tolerance_)
        least_thickness_ = std::min(least_thickness_, 0.5 * way);
    });
  }
}

double TriangleShape::thickness_along(const Vec3& direction) const {
  std::vector<Vec3> middles;
  const std::size_t stride = 1 + normal_.size() / 2000; // enough to tell before a run
  for (std::size_t t = 0; t < normal_.size(); t += stride) {
    const auto corner = surface_.corners(t);
    middles.push_back((corner[0] + corner[1] + corner[2]) / 3.0);
  }
  return thickness_by_tracing(*this, middles, direction);
}

double TriangleShape::passed(const Vec3& from, const Vec3& to) const {
  return passed_by_tracing(*this, from, to);
}

} // namespace cnem::contact
