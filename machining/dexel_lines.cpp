// What of the workpiece lies on a line.
#include "machining/dexels.hpp"

#include "core/index.hpp"
#include "machining/swept_region.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace cnem::machining {

namespace {

/// In order, those that touch as one. close: m
std::vector<Interval> merged(std::vector<Interval> parts, double close) {
  std::sort(parts.begin(), parts.end(), [](const Interval& a, const Interval& b) { return a.low < b.low; });
  std::vector<Interval> merged;
  for (const Interval& part : parts)
    if (!merged.empty() && part.low <= merged.back().high + close)
      merged.back().high = std::max(merged.back().high, part.high);
    else
      merged.push_back(part);
  return merged;
}

/// Takes from a part of a line, m along it, what is not between two values of a coordinate. A line along them
/// is one of those that go through the cells between them, but for rounding.
void clip(Interval& part, double from, double along, double low, double high) {
  if (along == 0.0) return;
  const double a = (low - from) / along, b = (high - from) / along;
  part.low = std::max(part.low, std::min(a, b));
  part.high = std::min(part.high, std::max(a, b));
}

/// The same of what is not in a convex polygon.
void clip(Interval& part, const Vec2& from, const Vec2& along, std::span<const Vec2> polygon) {
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Side side = Side::through(polygon[k], polygon[(k + 1) % polygon.size()]);
    const double height = side.height(from), slope = side.normal.dot(along); // within where ≤ 0
    if (slope > 0.0)
      part.high = std::min(part.high, -height / slope);
    else if (slope < 0.0)
      part.low = std::max(part.low, -height / slope);
    else if (height > 0.0)
      part.high = part.low;
  }
}

} // namespace

std::vector<Interval> DexelLayer::matter(int axis, double place) const {
  const int across = 1 - axis;
  const double row = std::floor((place - low_[across]) / size_[across]);
  std::vector<Interval> parts;
  if (row < 0.0 || row >= static_cast<double>(count_[index_of(across)])) return parts;
  for (std::size_t k = 0; k < count_[index_of(axis)]; ++k) {
    const auto other = static_cast<std::size_t>(row);
    const std::int32_t index = axis == 0 ? cell_[cell(k, other)] : cell_[cell(other, k)];
    if (index == full)
      parts.push_back({low_[axis] + static_cast<double>(k) * size_[axis],
                       low_[axis] + static_cast<double>(k + 1) * size_[axis]});
    if (index < 0) continue;
    const Pieces& pieces = cut_[index_of(index)];
    for (std::size_t p = 0, begin = 0; p < pieces.size.size(); ++p) {
      const std::span<const Vec2> polygon = pieces.next(p, begin);
      Interval part{HUGE_VAL, -HUGE_VAL};
      for (std::size_t c = 0; c < polygon.size(); ++c) {
        const Vec2 &a = polygon[c], &b = polygon[(c + 1) % polygon.size()];
        if ((a[across] <= place) == (b[across] <= place)) continue;
        const double at = a[axis] + (place - a[across]) / (b[across] - a[across]) * (b[axis] - a[axis]);
        part.low = std::min(part.low, at);
        part.high = std::max(part.high, at);
      }
      if (part.low < part.high) parts.push_back(part);
    }
  }
  return merged(std::move(parts), 1e-9 * size_[axis]);
}

std::vector<Interval> DexelLayer::matter(const Vec2& from, const Vec2& along, double length) const {
  const auto within = [&](int axis, std::size_t k, Interval& part) {
    const double low = low_[axis] + static_cast<double>(k) * size_[axis];
    clip(part, from[axis], along[axis], low, low + size_[axis]);
  };
  const double close = 1e-9 * size_.minCoeff(), end_x = from.x() + length * along.x();
  const auto [from_x, to_x] = range(0, std::min(from.x(), end_x) - close, std::max(from.x(), end_x) + close);
  std::vector<Interval> parts;
  for (std::size_t i = from_x; i < to_x; ++i) {
    Interval column{0.0, length};
    within(0, i, column);
    if (!(column.low < column.high)) continue;
    const double y = from.y() + column.low * along.y(), end_y = from.y() + column.high * along.y();
    const auto [from_y, to_y] = range(1, std::min(y, end_y) - close, std::max(y, end_y) + close);
    for (std::size_t j = from_y; j < to_y; ++j) {
      const std::int32_t index = cell_[cell(i, j)];
      if (index == full) {
        Interval part = column;
        within(1, j, part);
        if (part.low < part.high) parts.push_back(part);
      }
      if (index < 0) continue;
      const Pieces& pieces = cut_[index_of(index)];
      for (std::size_t p = 0, begin = 0; p < pieces.size.size(); ++p) {
        Interval part{0.0, length};
        clip(part, from, along, pieces.next(p, begin));
        if (part.low < part.high) parts.push_back(part);
      }
    }
  }
  return merged(std::move(parts), close);
}

} // namespace cnem::machining
