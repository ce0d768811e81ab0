#include "machining/dexels.hpp"

#include "core/error.hpp"
#include "core/index.hpp"
#include "machining/swept_region.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <fmt/format.h>
#include <numbers>
#include <optional>

namespace cnem::machining {

namespace {

/// Where what is left, or what is met, is nothing but rounding, as a share of a cell.
constexpr double nothing = 1e-13;

thread_local Division division;

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

DexelLayer::DexelLayer(const Vec2& low, const Vec2& high, const Vec2& pitch,
                       const std::vector<std::array<Vec2, 4>>& pieces)
    : DexelLayer(low, high, pitch) {
  cell_.assign(cell_.size(), empty);
  const double least = nothing * size_.prod(), whole = size_.prod() * (1.0 - 1e-12);
  std::vector<std::vector<std::size_t>> of_row(count_[1]);
  const auto extent = [&](std::size_t piece, int axis) {
    double from = HUGE_VAL, to = -HUGE_VAL;
    for (const Vec2& corner : pieces[piece]) {
      from = std::min(from, corner[axis]);
      to = std::max(to, corner[axis]);
    }
    return range(axis, from, to);
  };
  for (std::size_t p = 0; p < pieces.size(); ++p)
    for (auto [j, end] = extent(p, 1); j < end; ++j) of_row[j].push_back(p);
  // Row by row: what lies within cells is kept of those alone that are not full.
  std::vector<Pieces> within(count_[0]);
  for (std::size_t j = 0; j < count_[1]; ++j) {
    for (const std::size_t p : of_row[j]) {
      // Of a trapezoid that ends in a tip the side without length divides nothing.
      std::vector<Side> sides;
      for (std::size_t k = 0; k < 4; ++k)
        if (const Vec2& one = pieces[p][k], &next = pieces[p][(k + 1) % 4]; one != next)
          sides.push_back(Side::through(one, next));
      if (sides.size() < 3) continue;
      for (auto [i, end] = extent(p, 0); i < end; ++i)
        if (division.divide<false>(square(i, j), sides, ~0U, least)) within[i].add(division.within);
    }
    for (std::size_t i = 0; i < count_[0]; ++i) {
      if (within[i].size.empty()) continue;
      double area = 0.0;
      for (std::size_t p = 0, begin = 0; p < within[i].size.size(); ++p)
        area += area_of(within[i].next(p, begin));
      if (area >= whole)
        cell_[cell(i, j)] = full;
      else {
        cell_[cell(i, j)] = static_cast<std::int32_t>(cut_.size());
        cut_.push_back(within[i]);
      }
      within[i].corner.clear();
      within[i].size.clear();
    }
  }
}

std::array<Vec2, 4> DexelLayer::square(std::size_t i, std::size_t j) const {
  const auto corner = [&](std::size_t x, std::size_t y) {
    return Vec2(low_.x() + static_cast<double>(x) * size_.x(), low_.y() + static_cast<double>(y) * size_.y());
  };
  return {corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)};
}

/// Cells of an axis that an interval meets, m: from, and behind the last.
std::pair<std::size_t, std::size_t> DexelLayer::range(int axis, double from, double to) const {
  const double last = static_cast<double>(count_[index_of(axis)]) - 1.0;
  const double first = std::floor((from - low_[axis]) / size_[axis]);
  const double end = std::floor((to - low_[axis]) / size_[axis]);
  if (end < 0.0 || first > last) return {0, 0};
  return {static_cast<std::size_t>(std::max(0.0, first)), static_cast<std::size_t>(std::min(last, end)) + 1};
}

/// Calls visit(i, j, sides) for the cells with matter that a region may share something with; sides: those
/// that may divide them.
template<class Visit> void DexelLayer::meet(const Region& region, Visit&& visit) const {
  const std::span<const Vec2> corner = region.corners();
  Vec2 low = corner[0], high = low;
  for (const Vec2& x : corner) {
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
  }
  // Rows of cells along the longer side of the region: the fewer.
  const int across = high.x() - low.x() < high.y() - low.y() ? 0 : 1, along = 1 - across;
  const auto [row_from, row_to] = range(across, low[across], high[across]);
  for (std::size_t row = row_from; row < row_to; ++row) {
    const double from = low_[across] + static_cast<double>(row) * size_[across], to = from + size_[across];
    double least = HUGE_VAL, most = -HUGE_VAL;
    for (std::size_t k = 0; k < corner.size(); ++k) {
      const Vec2 &a = corner[k], &b = corner[k + 1 < corner.size() ? k + 1 : 0];
      const double way = b[across] - a[across];
      if (std::max(a[across], b[across]) < from || std::min(a[across], b[across]) > to) continue;
      const double slope = way == 0.0 ? 0.0 : (b[along] - a[along]) / way;
      for (const Vec2* c : {&a, &b}) {
        const double at = a[along] + (std::clamp((*c)[across], from, to) - a[across]) * slope;
        least = std::min(least, at);
        most = std::max(most, at);
      }
    }
    // Rounding may lead a little out of the region, not out of its box.
    const auto [first, end] = range(along, std::max(least, low[along]), std::min(most, high[along]));
    for (std::size_t k = first; k < end; ++k) {
      const std::size_t i = across == 0 ? row : k, j = across == 0 ? k : row;
      if (cell_[cell(i, j)] == empty) continue;
      const Vec2 middle =
          low_ + size_.cwiseProduct(Vec2(static_cast<double>(i) + 0.5, static_cast<double>(j) + 0.5));
      if (const auto sides = region.sides_across(middle, size_)) visit(i, j, *sides);
    }
  }
}

namespace {

/// The convex regions that a sweep consists of, the way of the edge first: one, or two triangles where it is
/// not convex, without those that the rake leaves backwards.
std::array<std::optional<Region>, 2> regions(const Sweep& sweep) {
  const Region whole{sweep.to.edge, sweep.from.edge, sweep.from.inner, sweep.to.inner};
  if (whole.convex()) return {whole, std::nullopt};
  std::array<std::optional<Region>, 2> parts;
  if (const Region outer{sweep.to.edge, sweep.from.edge, sweep.from.inner}; outer.convex()) parts[0] = outer;
  if (const Region inner{sweep.to.edge, sweep.from.inner, sweep.to.inner}; inner.convex()) parts[1] = inner;
  return parts;
}

} // namespace

bool DexelLayer::misses(const Sweep& sweep) const {
  const Vec2 high = this->high();
  const auto& [a, b] = sweep;
  const Vec2 least = a.edge.cwiseMin(a.inner).cwiseMin(b.edge).cwiseMin(b.inner);
  const Vec2 most = a.edge.cwiseMax(a.inner).cwiseMax(b.edge).cwiseMax(b.inner);
  return (least.array() >= high.array()).any() || (most.array() <= low_.array()).any();
}

Bite DexelLayer::ask(const Sweep& sweep) const {
  Bite bite;
  if (misses(sweep)) return bite;
  const double least = nothing * size_.prod();
  for (const std::optional<Region>& region : regions(sweep)) {
    if (!region) continue;
    const auto ask_piece = [&](std::span<const Vec2> piece, unsigned across) {
      if (division.divide<false>(piece, region->sides(), across, least)) take(division.within, &sweep, bite);
    };
    meet(*region, [&](std::size_t i, std::size_t j, unsigned across) {
      const std::int32_t index = cell_[cell(i, j)];
      if (index == full) {
        ask_piece(square(i, j), across);
        return;
      }
      const Pieces& pieces = cut_[index_of(index)];
      for (std::size_t k = 0, begin = 0; k < pieces.size.size(); ++k)
        ask_piece(pieces.next(k, begin), across);
    });
  }
  return bite;
}

void DexelLayer::erase(const Region& region, const Sweep* sweep, Bite& bite) {
  const double least = nothing * size_.prod();
  thread_local Pieces left;
  meet(region, [&](std::size_t i, std::size_t j, unsigned across) {
    std::int32_t& index = cell_[cell(i, j)];
    left.corner.clear();
    left.size.clear();
    bool taken = false;
    const auto erase_piece = [&](std::span<const Vec2> piece) {
      if (!division.divide<true>(piece, region.sides(), across, least)) {
        left.add(piece);
        return;
      }
      taken = true;
      take(division.within, sweep, bite);
      std::size_t begin = 0;
      for (const std::size_t corners : division.size) {
        const std::span<const Vec2> part(division.beyond.data() + begin, corners);
        begin += corners;
        if (const double area = area_of(part); area > least)
          left.add(part);
        else
          bite.area += area;
      }
    };
    if (index == full) {
      erase_piece(square(i, j));
      if (!taken) return;
      if (!left.size.empty()) {
        if (free_.empty()) {
          index = static_cast<std::int32_t>(cut_.size());
          cut_.emplace_back();
        } else {
          index = free_.back();
          free_.pop_back();
        }
      }
    } else {
      const Pieces& pieces = cut_[index_of(index)];
      for (std::size_t k = 0, begin = 0; k < pieces.size.size(); ++k) erase_piece(pieces.next(k, begin));
      if (!taken) return;
      if (left.size.empty()) free_.push_back(index);
    }
    if (left.size.empty())
      index = empty;
    else
      std::swap(cut_[index_of(index)], left);
  });
}

Bite DexelLayer::erase(const Sweep& sweep) {
  Bite bite;
  if (misses(sweep)) return bite;
  for (const std::optional<Region>& region : regions(sweep))
    if (region) erase(*region, &sweep, bite);
  return bite;
}

double DexelLayer::erase_disc(const Vec2& centre, double radius) {
  constexpr int sectors = 1440;
  constexpr double angle = 2.0 * std::numbers::pi / sectors;
  const double out = radius * std::sqrt(angle / std::sin(angle)); // of as large an area as the disc
  const auto corner = [&](int k) {
    return Vec2(centre + out * Vec2(std::cos(angle * k), std::sin(angle * k)));
  };
  Bite bite;
  for (int k = 0; k < sectors; ++k) erase({corner(k), corner((k + 1) % sectors), centre}, nullptr, bite);
  return bite.area;
}

void DexelLayer::erase_box(const Vec2& low, const Vec2& high) {
  Bite bite;
  erase({low, Vec2(high.x(), low.y()), high, Vec2(low.x(), high.y())}, nullptr, bite);
}

void DexelLayer::archive(Archive& archive, const std::string& path) {
  const std::size_t cells = cell_.size();
  archive.integers(path + "cell", cell_);
  archive.integers(path + "free", free_);
  std::vector<std::int32_t> pieces, corners;
  std::vector<double> place;
  for (const Pieces& cell : cut_) {
    pieces.push_back(static_cast<std::int32_t>(cell.size.size()));
    corners.insert(corners.end(), cell.size.begin(), cell.size.end());
    for (const Vec2& x : cell.corner) place.insert(place.end(), {x.x(), x.y()});
  }
  archive.integers(path + "pieces", pieces);
  archive.integers(path + "corners", corners);
  archive.list(path + "place", "m", place);
  if (!archive.loading()) return;
  cut_.assign(pieces.size(), {});
  std::size_t next = 0, at = 0;
  bool good = cell_.size() == cells;
  for (const std::int32_t index : cell_)
    good = good && index >= full && index < static_cast<std::int32_t>(cut_.size());
  for (const std::int32_t index : free_)
    good = good && index >= 0 && index < static_cast<std::int32_t>(cut_.size());
  for (std::size_t k = 0; good && k < cut_.size(); ++k) {
    for (std::int32_t piece = 0; good && piece < pieces[k]; ++piece) {
      good = next < corners.size() && corners[next] >= 3 && at + 2 * index_of(corners[next]) <= place.size();
      if (!good) break;
      cut_[k].size.push_back(corners[next]);
      for (std::int32_t c = 0; c < corners[next]; ++c, at += 2)
        cut_[k].corner.emplace_back(place[at], place[at + 1]);
      ++next;
    }
  }
  if (!good || next != corners.size() || at != place.size())
    throw IoError(path + " holds no layer of dexels of this case");
}

void DexelLayer::archive_whole(Archive& archive, const std::string& path) {
  archive.vector<2>(path + "low", "m", low_);
  archive.vector<2>(path + "size", "m", size_);
  for (const std::size_t axis : {0U, 1U})
    archive.integer(fmt::format("{}count.{}", path, axis), count_[axis]);
  if (archive.loading()) {
    constexpr std::size_t most = 1U << 30U;
    const auto [nx, ny] = count_;
    if (nx < 1 || ny < 1 || nx > most || ny > most / nx || !(size_.minCoeff() > 0.0) || !low_.allFinite())
      throw IoError(path + " holds no layer of dexels");
    cell_.assign(nx * ny, full);
  }
  this->archive(archive, path);
}

DexelLayer::DexelLayer(Archive& archive, const std::string& path) { archive_whole(archive, path); }

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

} // namespace cnem::machining
