#pragma once
// A tree of boxes in space: which of many things are near a place, without looking at all of them.
#include "core/geometry/box.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace cnem {

/// Halves boxes at the median of their middles, along the longest side, down to four. O(n log n) to make.
class BoxTree {
public:
  BoxTree() = default;
  explicit BoxTree(std::vector<Box<3>> boxes);

  bool empty() const { return order_.empty(); }

  /// visit(number) for all boxes that overlap one; in an order that depends on the boxes alone.
  template<class Visit> void overlapping(const Box<3>& box, Visit&& visit) const {
    if (!empty()) descend(0, box, visit);
  }

  /// The same for all boxes that the straight path from → to meets.
  template<class Visit> void along(const Vec3& from, const Vec3& to, Visit&& visit) const {
    if (!empty()) follow(0, from, to, visit);
  }

  /// The number of the thing nearest to x, of several as near the first; distance2(number): of a thing, m².
  /// −1 without any. `least` is its distance², and on entry the bound below which one counts.
  template<class Distance2> std::int32_t nearest(const Vec3& x, Distance2&& distance2, double& least) const {
    std::int32_t best = -1;
    if (!empty()) approach(0, x, distance2, least, best);
    return best;
  }

private:
  struct Branch {
    Box<3> box;
    std::int32_t first = 0, count = 0; ///< of `order_`: a leaf; else count = 0
    std::int32_t left = -1, right = -1;
  };
  std::int32_t grow(std::span<std::int32_t> part);

  template<class Visit> void descend(std::size_t at, const Box<3>& box, Visit&& visit) const {
    const Branch& branch = branch_[at];
    if (!overlap(branch.box, box)) return;
    for (std::int32_t k = 0; k < branch.count; ++k)
      if (const std::int32_t i = order_[index(branch.first + k)]; overlap(box_[index(i)], box)) visit(i);
    if (branch.count > 0) return;
    descend(index(branch.left), box, visit);
    descend(index(branch.right), box, visit);
  }

  template<class Visit> void follow(std::size_t at, const Vec3& from, const Vec3& to, Visit&& visit) const {
    const Branch& branch = branch_[at];
    if (!meets(branch.box, from, to)) return;
    for (std::int32_t k = 0; k < branch.count; ++k)
      if (const std::int32_t i = order_[index(branch.first + k)]; meets(box_[index(i)], from, to)) visit(i);
    if (branch.count > 0) return;
    follow(index(branch.left), from, to, visit);
    follow(index(branch.right), from, to, visit);
  }

  template<class Distance2>
  void approach(std::size_t at, const Vec3& x, Distance2&& distance2, double& least,
                std::int32_t& best) const {
    const Branch& branch = branch_[at];
    if (from_box(branch.box, x) > least) return;
    for (std::int32_t k = 0; k < branch.count; ++k) {
      const std::int32_t i = order_[index(branch.first + k)];
      if (from_box(box_[index(i)], x) > least) continue;
      const double d = distance2(i);
      if (d < least || (d == least && i < best)) least = d, best = i;
    }
    if (branch.count > 0) return;
    const auto one = index(branch.left), other = index(branch.right);
    const bool swapped = from_box(branch_[other].box, x) < from_box(branch_[one].box, x);
    approach(swapped ? other : one, x, distance2, least, best);
    approach(swapped ? one : other, x, distance2, least, best);
  }

  static bool meets(const Box<3>& box, const Vec3& from, const Vec3& to) {
    double enter = 0.0, leave = 1.0;
    for (int k = 0; k < 3; ++k) {
      const double way = to[k] - from[k];
      if (way == 0.0) {
        if (from[k] < box.low[k] || from[k] > box.high[k]) return false;
        continue;
      }
      const double low = (box.low[k] - from[k]) / way, high = (box.high[k] - from[k]) / way;
      enter = std::max(enter, std::min(low, high));
      leave = std::min(leave, std::max(low, high));
    }
    return enter <= leave + 1e-9;
  }
  static double from_box(const Box<3>& box, const Vec3& x) {
    return (x - x.cwiseMax(box.low).cwiseMin(box.high)).squaredNorm();
  }
  static std::size_t index(std::int32_t i) { return static_cast<std::size_t>(i); }

  std::vector<Box<3>> box_;
  std::vector<std::int32_t> order_;
  std::vector<Branch> branch_;
};

} // namespace cnem
