#include "voronoi/plane/edge_tree.hpp"

#include "voronoi/order.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace cnem::voronoi {

EdgeTree::EdgeTree(const Cloud<2>& cloud) {
  std::vector<Vec2> middles;
  middles.reserve(cloud.facets.size());
  for (const Facet<2>& f : cloud.facets)
    middles.push_back(0.5 *
                      (cloud.position[std::size_t(f.node[0])] + cloud.position[std::size_t(f.node[1])]));
  edges_.reserve(cloud.facets.size());
  for (const std::int32_t k : hilbert_order(middles)) {
    const Facet<2>& f = cloud.facets[std::size_t(k)];
    const Vec2 a = cloud.position[std::size_t(f.node[0])], b = cloud.position[std::size_t(f.node[1])];
    if (a.y() <= b.y())
      edges_.push_back({a, b});
    else
      edges_.push_back({b, a});
  }
  const std::size_t leaves = std::bit_ceil((edges_.size() + leaf_size - 1) / leaf_size);
  constexpr double far = std::numeric_limits<double>::infinity();
  boxes_.assign(2 * leaves - 1, Box{Vec2(far, far), Vec2(-far, -far)});
  first_leaf_ = static_cast<int>(leaves - 1);
  for (std::size_t e = 0; e < edges_.size(); ++e) {
    Box& box = boxes_[std::size_t(first_leaf_) + e / leaf_size];
    for (const Vec2& x : edges_[e]) {
      box.low = box.low.cwiseMin(x);
      box.high = box.high.cwiseMax(x);
    }
  }
  for (std::size_t k = leaves - 1; k-- > 0;) {
    const Box &left = boxes_[2 * k + 1], &right = boxes_[2 * k + 2];
    boxes_[k] = {left.low.cwiseMin(right.low), left.high.cwiseMax(right.high)};
  }
}

double EdgeTree::distance(const Vec2& x, double bound) const {
  double best = bound * bound;
  const auto to_box = [&](int k) {
    const Box& box = boxes_[std::size_t(k)];
    const double dx = std::max({box.low.x() - x.x(), x.x() - box.high.x(), 0.0});
    const double dy = std::max({box.low.y() - x.y(), x.y() - box.high.y(), 0.0});
    return dx * dx + dy * dy;
  };
  std::array<int, 64> stack;
  int depth = 0;
  stack[0] = 0;
  while (depth >= 0) {
    const int k = stack[std::size_t(depth--)];
    if (to_box(k) >= best) continue;
    if (k < first_leaf_) { // the nearer child is looked at first
      const bool left_first = to_box(2 * k + 1) <= to_box(2 * k + 2);
      stack[std::size_t(++depth)] = left_first ? 2 * k + 2 : 2 * k + 1;
      stack[std::size_t(++depth)] = left_first ? 2 * k + 1 : 2 * k + 2;
      continue;
    }
    const std::size_t begin = std::size_t(k - first_leaf_) * leaf_size;
    for (std::size_t e = begin; e < std::min(begin + leaf_size, edges_.size()); ++e) {
      const Vec2 ab = edges_[e][1] - edges_[e][0], ax = x - edges_[e][0];
      const double s = std::clamp(ax.dot(ab) / ab.squaredNorm(), 0.0, 1.0);
      best = std::min(best, (ax - s * ab).squaredNorm());
    }
  }
  return std::sqrt(best);
}

bool EdgeTree::inside(const Vec2& x) const {
  bool odd = false;
  std::array<int, 64> stack;
  int depth = 0;
  stack[0] = 0;
  while (depth >= 0) {
    const int k = stack[std::size_t(depth--)];
    const Box& box = boxes_[std::size_t(k)];
    if (x.y() < box.low.y() || x.y() >= box.high.y() || x.x() > box.high.x()) continue;
    if (k < first_leaf_) {
      stack[std::size_t(++depth)] = 2 * k + 1;
      stack[std::size_t(++depth)] = 2 * k + 2;
      continue;
    }
    const std::size_t begin = std::size_t(k - first_leaf_) * leaf_size;
    for (std::size_t e = begin; e < std::min(begin + leaf_size, edges_.size()); ++e) {
      const auto& [a, b] = edges_[e]; // a below b: the ray to +x crosses when x is on their left
      if (a.y() <= x.y() && x.y() < b.y() && cross(b - a, x - a) > 0.0) odd = !odd;
    }
  }
  return odd;
}

} // namespace cnem::voronoi
