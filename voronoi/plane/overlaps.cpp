#include "voronoi/plane/overlaps.hpp"

#include "core/error.hpp"
#include "core/geometry/cell_complex.hpp"
#include "core/machine/parallel.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <vector>

namespace cnem::voronoi {

namespace {

using NodesOfTriangle = Simplex<2>;
using Triangles = IndexedVector<SimplexIndex, NodesOfTriangle>;

/// A part of an old triangle.
struct Part {
  SimplexIndex old;
  double volume; ///< m², of revolution m³ over 2π
};

class Overlaps {
public:
  Overlaps(const IndexedVector<NodeIndex, Vec2>& position, std::span<const NodesOfTriangle> old,
           std::span<const NodesOfTriangle> now, Space space)
      : position_(position), space_(space), old_(turned(old)), now_(turned(now)) {}

  SourceRows<SimplexIndex> run() {
    find_kept();
    cut();
    return rows();
  }

private:
  const Vec2& at(NodeIndex i) const { return position_[i]; }

  /// Each counter-clockwise from its lowest node.
  Triangles turned(std::span<const NodesOfTriangle> list) const {
    Triangles triangles;
    triangles.reserve(list.size());
    for (NodesOfTriangle corner : list) {
      std::rotate(corner.begin(), std::min_element(corner.begin(), corner.end()), corner.end());
      if (cross(at(corner[1]) - at(corner[0]), at(corner[2]) - at(corner[0])) < 0.0)
        std::swap(corner[1], corner[2]);
      triangles.push_back(corner);
    }
    return triangles;
  }

  /// Which triangles are in both, and of those that are not, which old ones are at each node.
  void find_kept() {
    kept_.assign(now_.size(), SimplexIndex::none);
    stays_.assign(old_.size(), 0);
    const CellLists<SimplexIndex> lowest = group_by_cell<SimplexIndex>(
        position_.size(), old_.size(), [&](std::size_t k) { return std::array{old_[k][0]}; });
    for (const SimplexIndex t : now_.indices())
      for (const SimplexIndex k : lowest.of(now_[t][0]))
        if (old_[k] == now_[t]) {
          kept_[t] = k;
          stays_[k] = 1;
        }
    at_node_ = group_by_cell<SimplexIndex>(position_.size(), old_.size(), [&](std::size_t k) {
      return std::span<const NodeIndex>(old_[k].data(), stays_[k] ? 0 : old_[k].size());
    });
  }

  void cut() {
    std::vector<SimplexIndex> changed;
    for (const SimplexIndex t : now_.indices())
      if (!exists(kept_[t])) changed.push_back(t);
    part_.resize(now_.size());
    for_each_block(changed.size(), [&](std::size_t begin, std::size_t end) {
      Cutter cutter;
      for (std::size_t c = begin; c < end; ++c) part_[changed[c]] = parts_of(changed[c], cutter);
    });
  }

  /// Lists that are used again.
  struct Cutter {
    std::vector<SimplexIndex> reached;
    std::vector<Vec2> polygon, before;
  };

  /// All old triangles that touch t are reached from those at its corners.
  std::vector<Part> parts_of(SimplexIndex t, Cutter& cutter) const {
    constexpr double least = 1e-12; // of the smaller triangle: what is less is rounding
    const double own = volume_of(now_[t]);
    std::vector<Part> parts;
    cutter.reached.clear();
    const auto reach = [&](SimplexIndex k) {
      if (std::find(cutter.reached.begin(), cutter.reached.end(), k) == cutter.reached.end())
        cutter.reached.push_back(k);
    };
    for (const NodeIndex i : now_[t])
      for (const SimplexIndex k : at_node_.of(i)) reach(k);
    for (std::size_t r = 0; r < cutter.reached.size(); ++r) {
      const SimplexIndex k = cutter.reached[r];
      common(now_[t], old_[k], cutter);
      if (cutter.polygon.empty()) continue;
      if (const double volume = volume_of(cutter.polygon, at(now_[t][0]));
          volume > least * std::min(own, volume_of(old_[k])))
        parts.push_back({k, volume});
      for (std::size_t e = 0; e < 3; ++e) {
        const NodeIndex a = old_[k][e], b = old_[k][(e + 1) % 3];
        for (const SimplexIndex across : at_node_.of(a))
          if (std::find(old_[across].begin(), old_[across].end(), b) != old_[across].end()) reach(across);
      }
    }
    std::sort(parts.begin(), parts.end(), [](const Part& a, const Part& b) { return a.old < b.old; });
    return parts;
  }

  /// The part that `b` has of `a`, seen from the first corner of a.
  void common(const NodesOfTriangle& a, const NodesOfTriangle& b, Cutter& cutter) const {
    const Vec2& origin = at(a[0]);
    cutter.polygon.clear();
    for (const NodeIndex i : b) cutter.polygon.emplace_back(at(i) - origin);
    for (std::size_t k = 0; k < 3 && !cutter.polygon.empty(); ++k)
      keep_left(at(a[k]) - origin, at(a[(k + 1) % 3]) - origin, cutter);
  }

  /// What of a convex polygon is to the left of the line from a to b (Sutherland and Hodgman 1974).
  static void keep_left(const Vec2& a, const Vec2& b, Cutter& cutter) {
    cutter.before.swap(cutter.polygon);
    cutter.polygon.clear();
    const std::vector<Vec2>& corner = cutter.before;
    const auto side = [&](const Vec2& x) { return cross(b - a, x - a); };
    double last = side(corner.back());
    for (std::size_t k = 0; k < corner.size(); ++k) {
      const Vec2 &from = corner[k == 0 ? corner.size() - 1 : k - 1], &to = corner[k];
      const double next = side(to);
      if ((last < 0.0 && next > 0.0) || (last > 0.0 && next < 0.0))
        cutter.polygon.emplace_back(from + last / (last - next) * (to - from));
      if (next >= 0.0) cutter.polygon.push_back(to);
      last = next;
    }
  }

  /// Of a polygon with corners seen from `origin`.
  double volume_of(std::span<const Vec2> polygon, const Vec2& origin) const {
    double area = 0.0, moment = 0.0;
    for (std::size_t k = 1; k + 1 < polygon.size(); ++k) {
      const double part = 0.5 * cross(polygon[k] - polygon[0], polygon[k + 1] - polygon[0]);
      area += part;
      moment += part * (polygon[0].x() + polygon[k].x() + polygon[k + 1].x()) / 3.0;
    }
    return space_ == Space::plane ? area : origin.x() * area + moment;
  }
  double volume_of(const NodesOfTriangle& corner) const {
    const Vec2& origin = at(corner[0]);
    const std::array<Vec2, 3> seen{Vec2(0, 0), at(corner[1]) - origin, at(corner[2]) - origin};
    return volume_of(seen, origin);
  }

  /// Throws unless the parts of a triangle make up the whole.
  void check_whole(const NodesOfTriangle& corner, double parts) const {
    constexpr double loss = 1e-6, rounding = 1e-12;
    const double whole = volume_of(corner);
    double longest = 0.0;
    for (std::size_t e = 0; e < 3; ++e)
      longest = std::max(longest, (at(corner[e]) - at(corner[(e + 1) % 3])).squaredNorm());
    if (space_ == Space::revolution) longest *= std::abs(at(corner[0]).x()) + std::sqrt(longest);
    if (parts > 0.0 && std::abs(parts - whole) <= loss * whole + rounding * longest) return;
    throw GeometryError(fmt::format("triangles that were renewed cover {:.9g} of that at ({:g}, {:g}) m, "
                                    "expected all of it: the domain has folded over itself",
                                    parts / whole, at(corner[0]).x(), at(corner[0]).y()));
  }

  SourceRows<SimplexIndex> rows() const {
    IndexedVector<SimplexIndex, double> given(old_.size(), 0.0);
    for (const SimplexIndex t : now_.indices()) {
      if (exists(kept_[t])) continue;
      double sum = 0.0;
      for (const Part& part : part_[t]) {
        given[part.old] += part.volume;
        sum += part.volume;
      }
      check_whole(now_[t], sum);
    }
    for (const SimplexIndex k : old_.indices())
      if (!stays_[k]) check_whole(old_[k], given[k]);
    SourceRows<SimplexIndex> rows{{0}, {}, {}};
    rows.begin.reserve(now_.size() + 1);
    for (const SimplexIndex t : now_.indices()) {
      if (exists(kept_[t])) {
        rows.from.push_back(kept_[t]);
        rows.weight.push_back(1.0);
      }
      for (const Part& part : part_[t]) {
        rows.from.push_back(part.old);
        rows.weight.push_back(part.volume / given[part.old]);
      }
      rows.begin.push_back(as<std::int32_t>(rows.from.size()));
    }
    return rows;
  }

  const IndexedVector<NodeIndex, Vec2>& position_;
  Space space_;
  Triangles old_, now_;
  IndexedVector<SimplexIndex, SimplexIndex> kept_;      ///< [new] the same old one; none: there was none
  IndexedVector<SimplexIndex, char> stays_;             ///< [old] whether it is in both
  CellLists<SimplexIndex> at_node_;                     ///< old ones that are not in both
  IndexedVector<SimplexIndex, std::vector<Part>> part_; ///< [new] empty for those that are in both
};

} // namespace

SourceRows<SimplexIndex> overlaps(const IndexedVector<NodeIndex, Vec2>& position,
                                  std::span<const Simplex<2>> old, std::span<const Simplex<2>> now,
                                  Space space) {
  return Overlaps(position, old, now, space).run();
}

} // namespace cnem::voronoi
