#include "machining/dexels.hpp"

#include <algorithm>
#include <cmath>

namespace cnem::machining {

namespace {

/// Length of the matter within [low, high].
double length_within(std::span<const Interval> matter, double low, double high) {
  double sum = 0.0;
  for (const Interval& piece : matter)
    sum += std::max(0.0, std::min(high, piece.high) - std::max(low, piece.low));
  return sum;
}

void take_away(std::vector<Interval>& matter, double low, double high) {
  for (std::size_t i = 0; i < matter.size();) {
    Interval& piece = matter[i];
    if (piece.high <= low || piece.low >= high) {
      ++i;
    } else if (piece.low < low && piece.high > high) {
      const Interval rest{high, piece.high};
      piece.high = low;
      matter.insert(matter.begin() + static_cast<std::ptrdiff_t>(i) + 1, rest);
      return;
    } else if (piece.low < low) {
      piece.high = low;
      ++i;
    } else if (piece.high > high) {
      piece.low = high;
      ++i;
    } else {
      matter.erase(matter.begin() + static_cast<std::ptrdiff_t>(i));
    }
  }
}

} // namespace

DexelLayer::DexelLayer(const Vec2& low, const Vec2& high, const Vec2& pitch) {
  for (const int along : {0, 1}) {
    const int across = 1 - along;
    Lines& lines = set_[index(along)];
    const double width = high[across] - low[across];
    const auto count = static_cast<std::size_t>(std::ceil(width / pitch[across] - 1e-9));
    lines.begin = low[across];
    lines.pitch = width / static_cast<double>(count);
    lines.line.assign(count, {Interval{low[along], high[along]}});
  }
}

/// Calls visit(line, low, high) for the parts of lines behind the path.
template<class Visit> void DexelLayer::meet(int axis, const Sweep& sweep, Visit&& visit) const {
  const Lines& lines = set_[index(axis)];
  const int across = 1 - axis;
  const double a = sweep.a[across], b = sweep.b[across];
  const auto next = [&](double x) { return std::ceil((x - lines.begin) / lines.pitch - 0.5); };
  const double from = std::min(next(a), next(b)), to = std::max(next(a), next(b));
  const double last = std::min(to, static_cast<double>(lines.line.size()));
  for (double i = std::max(from, 0.0); i < last; ++i) {
    const auto line = static_cast<std::size_t>(i);
    if (lines.line[line].empty()) continue;
    const double edge = sweep.a[axis] + (place(axis, line) - a) / (b - a) * (sweep.b[axis] - sweep.a[axis]);
    const double behind = edge - std::copysign(sweep.reach[axis], sweep.normal[axis]);
    visit(line, std::min(edge, behind), std::max(edge, behind));
  }
}

DexelLayer::Sample DexelLayer::sample(int axis, double line, const Sweep& sweep) const {
  const Lines& lines = set_[index(axis)];
  const Vec2 middle = 0.5 * (sweep.a + sweep.b), way = (sweep.b - sweep.a).normalized();
  const double there = lines.begin + (line + 0.5) * lines.pitch;
  const double path = (there - middle[1 - axis]) / way[1 - axis];
  Sample sample{.edge = path, .end = path, .chip = 0.0};
  if (line < 0.0 || line >= static_cast<double>(lines.line.size())) return sample;
  // The edge on its circle, also beyond the step.
  const Vec2 out = (sweep.normal * sweep.radius + path * way).normalized();
  const double edge =
      middle[axis] + path * way[axis] - path * path / (2.0 * sweep.radius) * sweep.normal[axis];
  const double behind = edge - std::copysign(sweep.reach[axis], sweep.normal[axis]);
  const double length = length_within(lines.line[static_cast<std::size_t>(line)], std::min(edge, behind),
                                      std::max(edge, behind));
  if (!(length > 0.0)) return sample;
  // The far end of the matter, seen from the axis of the cutter: inwards, and along the path.
  const Vec2 far = -std::copysign(length, out[axis]) * Vec2::Unit(axis);
  const double inward = -far.dot(out), along = far.dot(Vec2(out.y(), -out.x()));
  sample.end = path + sweep.radius * std::atan2(along, sweep.radius - inward);
  sample.chip = (inward * (2.0 * sweep.radius - inward) - along * along) / (2.0 * sweep.radius);
  return sample;
}

std::optional<double> DexelLayer::chip(const Sweep& sweep) const {
  const int axis = std::abs(sweep.normal.x()) > std::abs(sweep.normal.y()) ? 0 : 1;
  const Lines& lines = set_[index(axis)];
  const auto next = [&](const Vec2& x) { return std::ceil((x[1 - axis] - lines.begin) / lines.pitch - 0.5); };
  const double first = next(sweep.a), last = next(sweep.b);
  if (first == last) return std::nullopt;
  // Upwards lines `first` … `last` − 1 are met, downwards `first` − 1 … `last`.
  const double forward = last > first ? 1.0 : -1.0, offset = forward > 0.0 ? 0.0 : -1.0;
  double sum = 0.0;
  for (double line = first + offset; line != last + offset; line += forward) {
    const Sample here = sample(axis, line, sweep), ahead = sample(axis, line + forward, sweep);
    sum += here.chip;
    constexpr double most = 0.2; // of the chip: beyond, the lines see the end of a cut
    if (here.chip > 0.0 && ahead.chip > 0.0 && ahead.end > here.end)
      sum += std::clamp((here.edge - here.end) / (ahead.end - here.end) * (ahead.chip - here.chip),
                        -most * here.chip, most * here.chip);
  }
  return sum / std::abs(last - first);
}

void DexelLayer::erase(const Sweep& sweep) {
  for (const int axis : {0, 1})
    meet(axis, sweep, [&](std::size_t line, double low, double high) {
      take_away(set_[index(axis)].line[line], low, high);
    });
}

/// ends: the part of a line at a place across, where its length is positive.
template<class Ends> void DexelLayer::erase_between(int axis, const Ends& ends) {
  for (std::size_t i = 0; i < lines(axis); ++i)
    if (const Interval part = ends(axis, place(axis, i)); part.low < part.high)
      take_away(set_[index(axis)].line[i], part.low, part.high);
}

void DexelLayer::erase_disc(const Vec2& centre, double radius) {
  for (const int axis : {0, 1})
    erase_between(axis, [&](int along, double place) {
      const double away = place - centre[1 - along],
                   half = std::sqrt(std::max(0.0, radius * radius - away * away));
      return Interval{centre[along] - half, centre[along] + half};
    });
}

void DexelLayer::erase_box(const Vec2& low, const Vec2& high) {
  for (const int axis : {0, 1})
    erase_between(axis, [&](int along, double place) {
      const bool within = place > low[1 - along] && place < high[1 - along];
      return within ? Interval{low[along], high[along]} : Interval{};
    });
}

double DexelLayer::area(int axis) const {
  double sum = 0.0;
  for (const std::vector<Interval>& matter : set_[index(axis)].line)
    sum += set_[index(axis)].pitch * length_within(matter, -HUGE_VAL, HUGE_VAL);
  return sum;
}

} // namespace cnem::machining
