#include "machining/structure/theoretical_tool.hpp"

#include "core/index.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

namespace cnem::machining {

namespace {

/// Points of a cell by which its share is told, along each axis.
constexpr int points = 8;

bool is_in(const std::vector<Interval>& matter, double y) {
  return std::any_of(matter.begin(), matter.end(),
                     [y](const Interval& of) { return y >= of.low && y <= of.high; });
}

/// Which points of cells lie in the workpiece, and whether they are still there. What earlier turns or an
/// earlier run have taken was there.
class Samples {
public:
  Samples(const Part& part, const MillingProcess& process, const std::function<Vec3(const Vec3&)>& in_cut)
      : cells_(part.cells()) {
    const Workpiece block = process.workpiece();
    const std::vector<Slice>& slices = process.slices();
    for (std::size_t c = 0; c < cells_; ++c)
      for (int n = 0; n < points * points * points; ++n) {
        const Vec3 share(n / (points * points) + 0.5, n / points % points + 0.5, n % points + 0.5);
        const Vec3 size = part.high(c) - part.low(c);
        const Vec3 at = in_cut(part.low(c) + size.cwiseProduct(share) / points);
        if (((at - block.low).array() <= 0.0).any() || ((block.high - at).array() <= 0.0).any()) continue;
        const auto above =
            std::upper_bound(slices.begin() + 1, slices.end(), at.z(),
                             [](double height, const Slice& slice) { return height < slice.low; });
        line_[{index_of(above - slices.begin()) - 1, at.x()}].emplace_back(c, at.y());
      }
    if (!process.has_surface()) return;
    for (auto& [where, points_there] : line_) {
      const std::vector<Interval> matter = process.layers()[where.first].matter(1, where.second);
      std::erase_if(points_there, [&](const auto& point) { return !is_in(matter, point.second); });
    }
  }

  /// [cell] of all points.
  std::vector<double> taken(const MillingProcess& process) const {
    std::vector<double> share(cells_, 0.0);
    for (const auto& [where, points_there] : line_) {
      const auto& [layer, x] = where;
      const std::vector<Interval> matter = process.layers()[layer].matter(1, x);
      for (const auto& [cell, y] : points_there)
        if (!is_in(matter, y)) share[cell] += 1.0 / (points * points * points);
    }
    return share;
  }

private:
  std::size_t cells_;
  std::map<std::pair<std::size_t, double>, std::vector<std::pair<std::size_t, double>>>
      line_; ///< [layer, x] cells and y
};

} // namespace

TheoreticalTool::TheoreticalTool(const Part& part, MillingProcess rigid,
                                 const std::function<Vec3(const Vec3&)>& in_cut, const Intervals& intervals)
    : intervals_(intervals) {
  const Samples samples(part, rigid, in_cut);
  const auto note = [&] {
    std::vector<double> presence = part.presence(), taken = samples.taken(rigid);
    for (std::size_t c = 0; c < presence.size(); ++c) presence[c] *= 1.0 - intervals.most * taken[c];
    presence_.push_back(std::move(presence));
  };
  note();
  while (!rigid.at_end()) {
    rigid.advance();
    if (rigid.steps() % intervals.interval == 0 || rigid.at_end()) note();
  }
}

const std::vector<double>& TheoreticalTool::presence(std::int64_t step) const {
  return presence_[std::min(index_of(step / intervals_.interval), presence_.size() - 1)];
}

} // namespace cnem::machining
