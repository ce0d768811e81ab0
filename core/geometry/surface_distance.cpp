#include "core/geometry/surface_distance.hpp"

#include "core/index.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <tuple>
#include <utility>

namespace cnem {
namespace {

Box<3> box_of(const std::array<Vec3, 3>& x) {
  return {x[0].cwiseMin(x[1]).cwiseMin(x[2]), x[0].cwiseMax(x[1]).cwiseMax(x[2])};
}

double angle_at(const std::array<Vec3, 3>& x, std::size_t k) {
  const Vec3 e = x[(k + 1) % 3] - x[k], f = x[(k + 2) % 3] - x[k];
  return std::atan2(e.cross(f).norm(), e.dot(f));
}

} // namespace

SurfaceDistance::SurfaceDistance(TriangleSurface surface)
    : surface_(std::move(surface)), at_point_(surface_.points.size(), Vec3::Zero()) {
  const std::size_t n = surface_.triangles.size();
  std::vector<Box<3>> boxes;
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
  std::vector<std::tuple<std::int32_t, std::int32_t, std::size_t, std::size_t>> sides;
  for (std::size_t t = 0; t < n; ++t)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int32_t a = surface_.triangles[t][k], b = surface_.triangles[t][(k + 1) % 3];
      sides.emplace_back(std::min(a, b), std::max(a, b), t, k);
    }
  std::sort(sides.begin(), sides.end());
  assert(sides.size() % 2 == 0);
  across_.resize(n);
  for (std::size_t s = 0; s < sides.size(); s += 2) {
    const auto [low, high, t, k] = sides[s];
    const auto [low2, high2, other, l] = sides[s + 1];
    across_[t][k] = as<std::int32_t>(other);
    across_[other][l] = as<std::int32_t>(t);
  }
}

SurfaceDistance::Foot SurfaceDistance::foot(std::size_t triangle, const Vec3& x) const {
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
Vec3 SurfaceDistance::normal_at(std::size_t triangle, const std::array<double, 3>& weight) const {
  for (std::size_t k = 0; k < 3; ++k)
    if (weight[k] == 1.0) return at_point_[index_of(surface_.triangles[triangle][k])];
  for (std::size_t k = 0; k < 3; ++k)
    if (weight[k] == 0.0)
      return (normal_[triangle] + normal_[index_of(across_[triangle][(k + 1) % 3])]).normalized();
  return normal_[triangle];
}

SurfaceDistance::Nearest SurfaceDistance::nearest(const Vec3& x, double bound) const {
  double least = bound * bound;
  const std::int32_t best = tree_.nearest(
      x, [&](std::int32_t t) { return (x - foot(index_of(t), x).point).squaredNorm(); }, least);
  if (best < 0) return {bound, x, Vec3::Zero(), best};
  const Foot at = foot(index_of(best), x);
  const Vec3 outwards = normal_at(index_of(best), at.weight);
  const double side = (x - at.point).dot(outwards) < 0.0 ? -1.0 : 1.0;
  return {side * std::sqrt(least), at.point, outwards, best};
}

} // namespace cnem
