#include "machining/blank.hpp"

#include "core/error.hpp"
#include "core/geometry/plane_section.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace cnem::machining {

void LeftWorkpiece::archive(Archive& archive) {
  std::vector<double> low, thickness;
  for (const Slice& slice : slices) {
    low.push_back(slice.low);
    thickness.push_back(slice.thickness);
  }
  archive.list("workpiece/low", "m", low);
  archive.list("workpiece/thickness", "m", thickness);
  archive.number("workpiece/turned", "1", turned);
  archive.integer("workpiece/steps_of_turn", steps_of_turn);
  const auto path = [](std::size_t k) { return fmt::format("workpiece/layer/{}/", k); };
  if (!archive.loading()) {
    for (std::size_t k = 0; k < layers.size(); ++k) layers[k].archive_whole(archive, path(k));
    return;
  }
  bool good = !low.empty() && low.size() == thickness.size() && steps_of_turn > 0 && turned >= 0.0;
  slices.clear();
  layers.clear();
  for (std::size_t k = 0; good && k < low.size(); ++k) {
    good = thickness[k] > 0.0;
    slices.push_back({low[k], thickness[k]});
    layers.emplace_back(archive, path(k));
  }
  if (!good) throw IoError("workpiece/ holds no layers");
}

std::vector<std::array<Vec2, 4>> section_pieces(const TriangleSurface& surface, double height) {
  std::vector<std::array<Vec2, 2>> sides; // upwards
  std::vector<double> level;
  for (const SectionLoop& loop : cut(surface, {.at = Vec3(0.0, 0.0, height)}))
    for (std::size_t k = 0; k < loop.point.size(); ++k) {
      Vec2 a = loop.point[k], b = loop.point[(k + 1) % loop.point.size()];
      level.push_back(a.y());
      if (a.y() == b.y()) continue;
      if (a.y() > b.y()) std::swap(a, b);
      sides.push_back({a, b});
    }
  std::sort(level.begin(), level.end());
  level.erase(std::unique(level.begin(), level.end()), level.end());
  std::vector<std::array<Vec2, 4>> pieces;
  struct Crossing {
    double low, high; ///< m, x at both levels
  };
  std::vector<Crossing> crossing;
  for (std::size_t k = 0; k + 1 < level.size(); ++k) {
    const double low = level[k], high = level[k + 1];
    crossing.clear();
    for (const auto& [a, b] : sides) {
      if (a.y() > low || b.y() < high) continue;
      const auto at = [&a = a, &b = b](double y) {
        return y == b.y() ? b.x() : a.x() + (y - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
      };
      crossing.push_back({at(low), at(high)});
    }
    std::sort(crossing.begin(), crossing.end(), [](const Crossing& one, const Crossing& other) {
      return one.low + one.high < other.low + other.high;
    });
    for (std::size_t i = 0; i + 1 < crossing.size(); i += 2)
      pieces.push_back({Vec2(crossing[i].low, low), Vec2(crossing[i + 1].low, low),
                        Vec2(crossing[i + 1].high, high), Vec2(crossing[i].high, high)});
  }
  return pieces;
}

} // namespace cnem::machining
