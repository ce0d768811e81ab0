#include "voronoi/space/winding.hpp"

#include "core/index.hpp"
#include "voronoi/space/exact.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace cnem::voronoi {

namespace {

/// How often a triangle, seen from above, runs round a point: 1, −1 or 0. Points on an edge belong to one of
/// the triangles that share it.
int turns_round(const std::array<Vec2, 3>& corner, const Vec2& x) {
  int turns = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec2 &a = corner[k], &b = corner[(k + 1) % 3];
    const bool right = a.x() <= x.x() && x.x() < b.x(), left = b.x() <= x.x() && x.x() < a.x();
    if (right && orientation(a, b, x) > 0) ++turns;
    if (left && orientation(b, a, x) > 0) --turns;
  }
  return turns;
}

} // namespace

Winding::Winding(const Cloud<3>& cloud) : cloud_(cloud) {
  const auto corner = [&](const Facet<3>& facet, std::size_t k) -> Vec2 {
    return cloud.position[facet.node[k]].head<2>();
  };
  constexpr double far = std::numeric_limits<double>::infinity();
  low_ = Vec2::Constant(far);
  Vec2 high = -low_;
  double size = 0.0;
  for (const auto& facet : cloud.facets)
    for (std::size_t k = 0; k < 3; ++k) {
      low_ = low_.cwiseMin(corner(facet, k));
      high = high.cwiseMax(corner(facet, k));
      size += (corner(facet, k) - corner(facet, (k + 1) % 3)).norm();
    }
  const Vec2 extent = high - low_;
  spacing_ = std::max({size / std::max(1.0, 3.0 * static_cast<double>(cloud.facets.size())),
                       1e-3 * extent.maxCoeff(), 1e-300});
  for (std::size_t k = 0; k < 2; ++k)
    columns_[k] = 1 + static_cast<std::size_t>(extent[static_cast<Eigen::Index>(k)] / spacing_);

  begin_.assign(columns_[0] * columns_[1] + 2, 0);
  const auto each_column = [&](const auto& visit) {
    for (const CloudFacetIndex f : cloud.facets.indices()) {
      const Vec2 a = corner(cloud.facets[f], 0), b = corner(cloud.facets[f], 1),
                 c = corner(cloud.facets[f], 2);
      const Vec2 least = a.cwiseMin(b).cwiseMin(c), most = a.cwiseMax(b).cwiseMax(c);
      const auto [i0, j0] = column(least.x(), least.y());
      const auto [i1, j1] = column(most.x(), most.y());
      for (std::size_t j = j0; j <= j1; ++j)
        for (std::size_t i = i0; i <= i1; ++i) visit(j * columns_[0] + i, f);
    }
  };
  each_column([&](std::size_t at, CloudFacetIndex) { ++begin_[at + 2]; });
  for (std::size_t i = 2; i < begin_.size(); ++i) begin_[i] += begin_[i - 1];
  facets_.resize(begin_.back());
  each_column([&](std::size_t at, CloudFacetIndex f) { facets_[begin_[at + 1]++] = f; });
}

std::array<std::size_t, 2> Winding::column(double x, double y) const {
  const auto place = [&](double along, std::size_t k) {
    return std::min(columns_[k] - 1, static_cast<std::size_t>(std::max(0.0, along / spacing_)));
  };
  return {place(x - low_.x(), 0), place(y - low_.y(), 1)};
}

int Winding::operator()(const Vec3& x) const {
  const auto [i, j] = column(x.x(), x.y());
  const std::size_t at = j * columns_[0] + i;
  int number = 0;
  for (std::uint32_t n = begin_[at]; n < begin_[at + 1]; ++n) {
    const auto& node = cloud_.facets[facets_[n]].node;
    const Vec3 &a = cloud_.position[node[0]], &b = cloud_.position[node[1]], &c = cloud_.position[node[2]];
    if (std::max({a.z(), b.z(), c.z()}) < x.z()) continue;
    const int turns = turns_round({Vec2(a.head<2>()), Vec2(b.head<2>()), Vec2(c.head<2>())}, x.head<2>());
    if (turns == 0) continue;
    // seen from a facet that looks up a point below it is on its inner side
    const int side = orientation(a, b, c, x);
    if (turns > 0 ? side < 0 : side >= 0) number += turns;
  }
  return number;
}

} // namespace cnem::voronoi
