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
  const TriangleFoot at = foot(index_of(best), x);
  const Vec3 outwards = normal_at(index_of(best), at.weight);
  const double side = (x - at.point).dot(outwards) < 0.0 ? -1.0 : 1.0;
  return {side * std::sqrt(least), at.point, outwards, best};
}

} // namespace cnem
