#pragma once
// Convex regions that a rake sweeps, and pieces of matter that they divide. For machining/dexels.cpp.
#include "core/geometry/clip_polygon.hpp"
#include "core/vec.hpp"

#include <array>
#include <cassert>
#include <initializer_list>
#include <optional>
#include <span>
#include <vector>

namespace cnem::machining {

inline double area_of(std::span<const Vec2> polygon) {
  double twice = 0.0;
  for (std::size_t k = 2; k < polygon.size(); ++k)
    twice += cross(polygon[k - 1] - polygon[0], polygon[k] - polygon[0]);
  return 0.5 * twice;
}

/// The side of a region: height ≤ 0 within.
struct Side {
  Vec2 normal = Vec2::Zero(); ///< outwards, of any length
  double offset = 0.0;
  /// Of the line through two corners, the region on the left.
  static Side through(const Vec2& a, const Vec2& b) {
    const Vec2 normal = right_normal(b - a);
    return {normal, normal.dot(a)};
  }
  double height(const Vec2& x) const { return normal.dot(x) - offset; }
  /// Half of what the height changes by over a rectangle.
  double reach(const Vec2& size) const { return 0.5 * normal.cwiseAbs().dot(size); }
};

/// A convex polygon, counter-clockwise. Its first side is the one that leaves matter: pieces are divided by
/// it first, which leaves the fewest.
class Region {
public:
  Region(std::initializer_list<Vec2> corners) {
    assert(corners.size() >= 3 && corners.size() <= corner_.size());
    for (const Vec2& corner : corners) corner_[count_++] = corner;
    for (std::size_t k = 0; k < count_; ++k) side_[k] = Side::through(corner_[k], corner_[(k + 1) % count_]);
  }
  bool convex() const {
    for (std::size_t k = 0; k < count_; ++k)
      for (std::size_t other = 0; other < count_; ++other)
        if (side_[k].height(corner_[other]) > 1e-12 * side_[k].normal.squaredNorm()) return false;
    return area_of(corners()) > 0.0;
  }
  std::span<const Vec2> corners() const { return {corner_.data(), count_}; }
  std::span<const Side> sides() const { return {side_.data(), count_}; }

  /// The sides that may divide a cell, one bit each; none where the cell lies outside.
  std::optional<unsigned> sides_across(const Vec2& middle, const Vec2& size) const {
    unsigned across = 0;
    for (std::size_t k = 0; k < count_; ++k) {
      const double height = side_[k].height(middle), reach = side_[k].reach(size);
      if (height >= reach) return std::nullopt;
      if (height > -reach) across |= 1U << k;
    }
    return across;
  }

private:
  std::array<Vec2, 4> corner_;
  std::array<Side, 4> side_;
  std::size_t count_ = 0;
};

/// A piece divided by a region: what lies within, and the parts beyond its sides, one behind the other.
class Division {
public:
  /// False if no more than `least`, m², lies within. sides: those that may divide the piece.
  template<bool parts_beyond>
  bool divide(std::span<const Vec2> piece, std::span<const Side> sides, unsigned across, double least) {
    within.assign(piece.begin(), piece.end());
    beyond.clear();
    size.clear();
    for (std::size_t k = 0; k < sides.size(); ++k) {
      if (!(across & 1U << k)) continue;
      split_polygon(within, inside_, outside_, [&](const Vec2& x) { return sides[k].height(x); });
      if (inside_.size() < 3) return false;
      if (outside_.size() < 3) continue;
      std::swap(within, inside_);
      if constexpr (parts_beyond) {
        beyond.insert(beyond.end(), outside_.begin(), outside_.end());
        size.push_back(outside_.size());
      }
    }
    return area_of(within) > least;
  }
  std::vector<Vec2> within, beyond;
  std::vector<std::size_t> size; ///< numbers of corners of the parts beyond

private:
  std::vector<Vec2> inside_, outside_;
};

} // namespace cnem::machining
