#include "evaluate/ply_cut.hpp"

#include "core/index.hpp"
#include "mechanics/broken.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace cnem::evaluate {
namespace {

constexpr double near_edge = 0.1; ///< feeds from the tip, at which a chain may begin
constexpr double clear = 0.1;     ///< feeds ahead of the rake face, from where on a surface is free
constexpr double half = 0.5;      ///< damage from which on matter counts as hurt

/// Cells of points as polygons, in the frame of the tool.
class Cells {
public:
  Cells(const CellGeometry<2>& cells, std::span<const Vec2> place) : cells_(cells) {
    vertex_.assign(cells.vertex.size(), Vec2::Zero());
    for (std::size_t v = 0; v < vertex_.size(); ++v)
      for (auto k = index_of(cells.vertex_begin[v]); k < index_of(cells.vertex_begin[v + 1]); ++k)
        vertex_[v] += cells.vertex_weight[k] * place[index_of(cells.vertex_node[k])];
    for (std::size_t c = 0; c + 1 < cells.begin.size(); ++c)
      each_side(c, [&](std::int32_t a, std::int32_t b) {
        auto [side, fresh] = sides_.try_emplace(std::minmax(a, b), std::array{c, none});
        if (!fresh) side->second[1] = c;
      });
  }

  std::size_t size() const { return cells_.begin.size() - 1; }
  /// use(neighbour, middle of the side); the neighbour is `none` where the side is part of the boundary.
  template<class Use> void each_neighbour(std::size_t cell, Use&& use) const {
    each_side(cell, [&](std::int32_t a, std::int32_t b) {
      const auto& pair = sides_.at(std::minmax(a, b));
      use(pair[0] == cell ? pair[1] : pair[0], Vec2(0.5 * (vertex_[index_of(a)] + vertex_[index_of(b)])));
    });
  }
  template<class Use> void each_vertex(std::size_t cell, Use&& use) const {
    for (auto k = index_of(cells_.begin[cell]); k < index_of(cells_.begin[cell + 1]); ++k)
      use(vertex_[index_of(cells_.index[k])]);
  }
  double nearest(std::size_t cell) const { ///< of its vertices to the tip, m
    double distance = INFINITY;
    each_vertex(cell, [&](const Vec2& x) { distance = std::min(distance, x.norm()); });
    return distance;
  }

  static constexpr std::size_t none = static_cast<std::size_t>(-1);

private:
  template<class Use> void each_side(std::size_t cell, Use&& use) const {
    const auto first = index_of(cells_.begin[cell]), last = index_of(cells_.begin[cell + 1]);
    for (auto k = first; k < last; ++k) use(cells_.index[k], cells_.index[k + 1 < last ? k + 1 : first]);
  }

  const CellGeometry<2>& cells_;
  std::vector<Vec2> vertex_;
  std::map<std::pair<std::int32_t, std::int32_t>, std::array<std::size_t, 2>> sides_;
};

/// Broken cells that hang together with those at the edge.
std::vector<std::size_t> broken_from_edge(const Cells& cells, std::span<const double> lost,
                                          std::span<const double> volume, double feed) {
  std::vector<std::size_t> reached;
  std::vector<char> seen(cells.size(), 0);
  const auto take = [&](std::size_t c) {
    if (seen[c] || lost[c] < 1.0) return;
    seen[c] = 1;
    reached.push_back(c);
  };
  for (std::size_t c = 0; c < cells.size(); ++c)
    if (lost[c] >= 1.0 && cells.nearest(c) < std::max(near_edge * feed, std::sqrt(volume[c]))) take(c);
  for (std::size_t k = 0; k < reached.size(); ++k)
    cells.each_neighbour(reached[k], [&](std::size_t other, const Vec2&) {
      if (other != Cells::none) take(other);
    });
  return reached;
}

/// Of the line x = a + y cot φ through the foremost vertices at each height of the feed but its ends.
double foremost_line(const Cells& cells, std::span<const std::size_t> broken, double feed) {
  constexpr int heights = 16;
  std::array<double, heights> foremost;
  foremost.fill(-INFINITY);
  for (const std::size_t c : broken)
    cells.each_vertex(c, [&](const Vec2& x) {
      const auto at = static_cast<int>(std::floor(heights * x.y() / feed));
      if (at > 0 && at < heights - 1) foremost[index_of(at)] = std::max(foremost[index_of(at)], x.x());
    });
  double n = 0.0, sx = 0.0, sy = 0.0, syy = 0.0, sxy = 0.0;
  for (int k = 1; k < heights - 1; ++k) {
    const double x = foremost[index_of(k)], y = (k + 0.5) * feed / heights;
    if (!std::isfinite(x)) continue;
    ++n, sx += x, sy += y, syy += y * y, sxy += x * y;
  }
  const double spread = n * syy - sy * sy;
  return spread > 0.0 ? std::atan2(spread, n * sxy - sx * sy) : unknown;
}

} // namespace

PlyCut look_at_plies(const PointState<2>& point, const Approximation<2>& approximation,
                     std::span<const Vec2> place, double feed, double cut) {
  PlyCut found;
  const Field& volume = approximation.mechanics.volume;
  const Field lost = lost_share(point);
  const Cells cells(approximation.cells, place);
  for (std::size_t p = 0; p < volume.size(); ++p) {
    const double fibre = std::max(point.fibre_tension_damage[p], point.fibre_compression_damage[p]);
    const double matrix =
        std::max({point.matrix_tension_damage[p], point.matrix_compression_damage[p], point.shear_damage[p]});
    found.fibre_area += fibre * volume[p];
    found.matrix_area += matrix * volume[p];
    if (fibre < half && matrix < half) continue;
    double below = 0.0, foremost = -INFINITY;
    cells.each_vertex(
        p, [&](const Vec2& x) { below = std::max(below, -x.y()), foremost = std::max(foremost, x.x()); });
    if (foremost < -cut) continue;
    if (fibre >= half) found.fibre_depth = std::max(found.fibre_depth, below);
    if (matrix >= half) found.matrix_depth = std::max(found.matrix_depth, below);
  }
  const std::vector<std::size_t> broken = broken_from_edge(cells, lost, volume, feed);
  found.parted = std::ranges::any_of(broken, [&](std::size_t c) {
    bool free = false;
    cells.each_neighbour(c, [&](std::size_t other, const Vec2& middle) {
      free = free || (other == Cells::none && middle.y() > half * feed && middle.x() > clear * feed);
    });
    return free;
  });
  if (found.parted) found.plane = foremost_line(cells, broken, feed);
  return found;
}

BrokenChip broken_chip(std::span<const double> cut, std::span<const double> force,
                       std::span<const double> parted) {
  constexpr double full = 0.9, lost = 0.5;
  BrokenChip chip;
  std::size_t top = 0; // row of the peak
  for (std::size_t k = 0; k < cut.size(); ++k) {
    if (force[k] > force[top]) top = k;
    chip.last = k;
    if (parted[k] == 0.0 && !(force[k] < lost * force[top])) continue;
    chip.completed = cut[k];
    break;
  }
  if (cut.empty() || !(force[top] > 0.0)) return {};
  chip.peak = force[top];
  std::size_t from = top, to = top; // the stretch round the peak in which the tool is fully engaged
  while (from > 0 && force[from - 1] >= full * chip.peak) --from;
  while (to < chip.last && force[to] >= full * chip.peak) ++to;
  chip.engaged = cut[from], chip.released = cut[to];
  return chip;
}

} // namespace cnem::evaluate
