#include "machining/dexels.hpp"

#include "core/geometry/clip_polygon.hpp"
#include "core/index.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <optional>

namespace cnem::machining {

namespace {

/// Where what is left, or what is met, is nothing but rounding, as a share of a cell.
constexpr double nothing = 1e-13;

double area_of(std::span<const Vec2> polygon) {
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

/// What clipping works in.
thread_local std::vector<Vec2> within, beyond, scratch;

} // namespace

/// A convex polygon, counter-clockwise. Its first side is the one that leaves matter: pieces are divided by
/// it first, which leaves the fewest.
class DexelLayer::Region {
public:
  Region(std::initializer_list<Vec2> corners) {
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

  enum class Place { outside, across, inside };
  Place of_cell(const Vec2& middle, const Vec2& size) const {
    bool inside = true;
    for (const Side& side : sides()) {
      const double height = side.height(middle), reach = side.reach(size);
      if (height >= reach) return Place::outside;
      inside = inside && height <= -reach;
    }
    return inside ? Place::inside : Place::across;
  }

  /// Leaves in `within` what of a piece lies in the region; false if that is nothing.
  bool meets(std::span<const Vec2> piece, double least) const {
    within.assign(piece.begin(), piece.end());
    for (const Side& side : sides()) {
      clip_polygon(within, scratch, [&](const Vec2& x) { return side.height(x); });
      if (within.size() < 3) return false;
    }
    return area_of(within) > least;
  }

private:
  std::array<Vec2, 4> corner_;
  std::array<Side, 4> side_;
  std::size_t count_ = 0;
};

namespace {

/// Adds a polygon that a rake takes.
void take(std::span<const Vec2> polygon, const Sweep* sweep, Bite& bite) {
  bite.area += area_of(polygon);
  if (!sweep) return;
  const Side from = Side::through(sweep->from.edge, sweep->from.inner),
             to = Side::through(sweep->to.inner, sweep->to.edge);
  const double scale = to.normal.norm() / from.normal.norm();
  for (const Vec2& x : polygon) {
    const double behind = std::max(0.0, -from.height(x) * scale), ahead = std::max(0.0, -to.height(x));
    if (!(behind + ahead > 0.0)) continue;
    const double share = behind / (behind + ahead);
    bite.begin = std::min(bite.begin, share);
    bite.end = std::max(bite.end, share);
  }
}

} // namespace

std::span<const Vec2> DexelLayer::Pieces::next(std::size_t piece, std::size_t& begin) const {
  const std::span<const Vec2> corners(corner.data() + begin, index_of(size[piece]));
  begin += corners.size();
  return corners;
}

void DexelLayer::Pieces::add(std::span<const Vec2> polygon) {
  corner.insert(corner.end(), polygon.begin(), polygon.end());
  size.push_back(static_cast<std::int32_t>(polygon.size()));
}

DexelLayer::DexelLayer(const Vec2& low, const Vec2& high, const Vec2& pitch) : low_(low) {
  for (const int axis : {0, 1}) {
    const double width = high[axis] - low[axis];
    const double cells = std::max(1.0, std::ceil(width / pitch[axis] - 1e-9));
    count_[index_of(axis)] = static_cast<std::size_t>(cells);
    size_[axis] = width / cells;
  }
  cell_.assign(count_[0] * count_[1], full);
}

std::array<Vec2, 4> DexelLayer::square(std::size_t i, std::size_t j) const {
  const auto corner = [&](std::size_t x, std::size_t y) {
    return Vec2(low_.x() + static_cast<double>(x) * size_.x(), low_.y() + static_cast<double>(y) * size_.y());
  };
  return {corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)};
}

/// Calls visit(i, j, place) for the cells with matter that a region may share something with.
template<class Visit> void DexelLayer::meet(const Region& region, Visit&& visit) const {
  const std::span<const Vec2> corner = region.corners();
  const auto range = [&](int axis, double from, double to) {
    const double last = static_cast<double>(count_[index_of(axis)]) - 1.0;
    const double first = std::floor((from - low_[axis]) / size_[axis]);
    const double end = std::floor((to - low_[axis]) / size_[axis]);
    if (end < 0.0 || first > last) return std::pair<std::size_t, std::size_t>{0, 0};
    return std::pair{static_cast<std::size_t>(std::max(0.0, first)),
                     static_cast<std::size_t>(std::min(last, end)) + 1};
  };
  double left = corner[0].x(), right = left;
  for (const Vec2& x : corner) {
    left = std::min(left, x.x());
    right = std::max(right, x.x());
  }
  const auto [i_from, i_to] = range(0, left, right);
  for (std::size_t i = i_from; i < i_to; ++i) {
    const double x0 = low_.x() + static_cast<double>(i) * size_.x(), x1 = x0 + size_.x();
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (std::size_t k = 0; k < corner.size(); ++k) {
      const Vec2 &a = corner[k], &b = corner[(k + 1) % corner.size()];
      if (std::max(a.x(), b.x()) < x0 || std::min(a.x(), b.x()) > x1) continue;
      const double slope = a.x() == b.x() ? 0.0 : (b.y() - a.y()) / (b.x() - a.x());
      const double least = std::min(a.y(), b.y()), most = std::max(a.y(), b.y());
      const auto at = [&](const Vec2& c) {
        return std::clamp(a.y() + (std::clamp(c.x(), x0, x1) - a.x()) * slope, least, most);
      };
      for (const double y : {at(a), at(b)}) {
        low = std::min(low, y);
        high = std::max(high, y);
      }
    }
    if (low > high) continue;
    const auto [j_from, j_to] = range(1, low, high);
    for (std::size_t j = j_from; j < j_to; ++j) {
      if (cell_[cell(i, j)] == empty) continue;
      const Vec2 middle =
          low_ + size_.cwiseProduct(Vec2(static_cast<double>(i) + 0.5, static_cast<double>(j) + 0.5));
      if (const Region::Place place = region.of_cell(middle, size_); place != Region::Place::outside)
        visit(i, j, place);
    }
  }
}

namespace {

/// The convex regions that a sweep consists of, the way of the edge first: one, or two triangles where it is
/// not convex, without those that the rake leaves backwards.
template<class Region> std::array<std::optional<Region>, 2> regions(const Sweep& sweep) {
  const Region whole{sweep.to.edge, sweep.from.edge, sweep.from.inner, sweep.to.inner};
  if (whole.convex()) return {whole, std::nullopt};
  std::array<std::optional<Region>, 2> parts;
  if (const Region outer{sweep.to.edge, sweep.from.edge, sweep.from.inner}; outer.convex()) parts[0] = outer;
  if (const Region inner{sweep.to.edge, sweep.from.inner, sweep.to.inner}; inner.convex()) parts[1] = inner;
  return parts;
}

} // namespace

Bite DexelLayer::ask(const Sweep& sweep) const {
  Bite bite;
  const double least = nothing * size_.prod();
  for (const std::optional<Region>& region : regions<Region>(sweep)) {
    if (!region) continue;
    meet(*region, [&](std::size_t i, std::size_t j, Region::Place place) {
      const std::int32_t index = cell_[cell(i, j)];
      if (index == full) {
        const std::array<Vec2, 4> whole = square(i, j);
        if (place == Region::Place::inside)
          take(whole, &sweep, bite);
        else if (region->meets(whole, least))
          take(within, &sweep, bite);
        return;
      }
      const Pieces& pieces = cut_[index_of(index)];
      for (std::size_t k = 0, begin = 0; k < pieces.size.size(); ++k)
        if (region->meets(pieces.next(k, begin), least)) take(within, &sweep, bite);
    });
  }
  return bite;
}

void DexelLayer::erase(const Region& region, const Sweep* sweep, Bite& bite) {
  const double least = nothing * size_.prod();
  meet(region, [&](std::size_t i, std::size_t j, Region::Place place) {
    std::int32_t& index = cell_[cell(i, j)];
    if (index == full) {
      const std::array<Vec2, 4> whole = square(i, j);
      if (place == Region::Place::inside) {
        take(whole, sweep, bite);
        index = empty;
        return;
      }
      if (!region.meets(whole, least)) return;
      if (free_.empty()) {
        index = static_cast<std::int32_t>(cut_.size());
        cut_.emplace_back();
      } else {
        index = free_.back();
        free_.pop_back();
      }
      cut_[index_of(index)].add(whole);
    }
    Pieces& pieces = cut_[index_of(index)];
    thread_local Pieces left;
    left.corner.clear();
    left.size.clear();
    for (std::size_t k = 0, begin = 0; k < pieces.size.size(); ++k) {
      const std::span<const Vec2> piece = pieces.next(k, begin);
      if (!region.meets(piece, least)) {
        left.add(piece);
        continue;
      }
      take(within, sweep, bite);
      within.assign(piece.begin(), piece.end());
      for (const Side& side : region.sides()) {
        beyond = within;
        clip_polygon(beyond, scratch, [&](const Vec2& x) { return -side.height(x); });
        if (const double area = area_of(beyond); area > least) {
          left.add(beyond);
        } else {
          bite.area += area;
        }
        clip_polygon(within, scratch, [&](const Vec2& x) { return side.height(x); });
      }
    }
    std::swap(pieces, left);
    if (pieces.size.empty()) {
      free_.push_back(index);
      index = empty;
    }
  });
}

Bite DexelLayer::erase(const Sweep& sweep) {
  Bite bite;
  for (const std::optional<Region>& region : regions<Region>(sweep))
    if (region) erase(*region, &sweep, bite);
  return bite;
}

void DexelLayer::erase_disc(const Vec2& centre, double radius) {
  constexpr int sectors = 1440;
  constexpr double angle = 2.0 * std::numbers::pi / sectors;
  const double out = radius * std::sqrt(angle / std::sin(angle)); // of as large an area as the disc
  const auto corner = [&](int k) {
    return Vec2(centre + out * Vec2(std::cos(angle * k), std::sin(angle * k)));
  };
  Bite bite;
  for (int k = 0; k < sectors; ++k) erase({corner(k), corner((k + 1) % sectors), centre}, nullptr, bite);
}

void DexelLayer::erase_box(const Vec2& low, const Vec2& high) {
  Bite bite;
  erase({low, Vec2(high.x(), low.y()), high, Vec2(low.x(), high.y())}, nullptr, bite);
}

double DexelLayer::area() const {
  std::size_t whole = 0;
  double sum = 0.0;
  for (const std::int32_t index : cell_) {
    if (index == full) ++whole;
    if (index < 0) continue;
    const Pieces& pieces = cut_[index_of(index)];
    for (std::size_t k = 0, begin = 0; k < pieces.size.size(); ++k) sum += area_of(pieces.next(k, begin));
  }
  return sum + static_cast<double>(whole) * size_.prod();
}

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
  std::sort(parts.begin(), parts.end(), [](const Interval& a, const Interval& b) { return a.low < b.low; });
  std::vector<Interval> merged;
  const double close = 1e-9 * size_[axis];
  for (const Interval& part : parts)
    if (!merged.empty() && part.low <= merged.back().high + close)
      merged.back().high = std::max(merged.back().high, part.high);
    else
      merged.push_back(part);
  return merged;
}

} // namespace cnem::machining
