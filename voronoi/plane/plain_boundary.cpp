#include "voronoi/plane/plain_boundary.hpp"

#include "core/index.hpp"
#include "voronoi/exact.hpp"

#include <algorithm>
#include <vector>

namespace cnem::voronoi {

namespace {

/// A facet with the box around it.
struct Boxed {
  NodeIndex a, b;
  double left, right, low, high; ///< m
};

class PlainBoundary {
public:
  explicit PlainBoundary(const Cloud<2>& cloud) : cloud_(cloud) {
    facets_.reserve(cloud.facets.size());
    for (const Facet<2>& facet : cloud.facets) {
      const auto [a, b] = facet.node;
      const auto [left, right] = std::minmax(at(a).x(), at(b).x());
      const auto [low, high] = std::minmax(at(a).y(), at(b).y());
      facets_.push_back({a, b, left, right, low, high});
    }
  }

  /// A sweep over x.
  bool facets_are_apart() {
    std::sort(facets_.begin(), facets_.end(), [](const Boxed& f, const Boxed& g) { return f.left < g.left; });
    std::vector<Boxed> open;
    for (const Boxed& facet : facets_) {
      std::erase_if(open, [&](const Boxed& other) { return other.right < facet.left; });
      for (const Boxed& other : open)
        if (other.low <= facet.high && other.high >= facet.low && !are_apart(facet, other)) return false;
      open.push_back(facet);
    }
    return true;
  }

  /// Expects facets that are apart: then a loop has all of the others on one side.
  bool loops_nest() const {
    IndexedVector<NodeIndex, std::int32_t> loop(cloud_.position.size(), -1);
    std::vector<NodeIndex> lowest;
    IndexedVector<NodeIndex, NodeIndex> next(cloud_.position.size(), NodeIndex::none), before = next;
    for (const Facet<2>& facet : cloud_.facets) {
      const auto [a, b] = facet.node;
      next[a] = b;
      before[b] = a;
    }
    for (const Facet<2>& facet : cloud_.facets) {
      if (loop[facet.node[0]] >= 0) continue;
      NodeIndex least = facet.node[0];
      for (NodeIndex i = least; loop[i] < 0; i = next[i]) {
        loop[i] = as<std::int32_t>(lowest.size());
        if (std::pair(at(i).y(), at(i).x()) < std::pair(at(least).y(), at(least).x())) least = i;
      }
      lowest.push_back(least);
    }
    for (const NodeIndex i : lowest) {
      // the boundary turns left at the lowest node of an outer loop
      const int turn = orientation(at(before[i]), at(i), at(next[i]));
      int around = 0; // how often the other loops of its body run round this one
      for (const Boxed& f : facets_) {
        if (loop[f.a] == loop[i] || !cloud_.one_body(f.a, i) || f.high <= at(i).y() || f.low > at(i).y())
          continue;
        const int side = orientation(at(f.a), at(f.b), at(i));
        const bool up = at(f.b).y() > at(f.a).y();
        if (up && side > 0) ++around;
        if (!up && side < 0) --around;
      }
      if (turn == 0 || around != (turn > 0 ? 0 : 1)) return false;
    }
    return true;
  }

private:
  const Vec2& at(NodeIndex i) const { return cloud_.position[i]; }

  bool are_apart(const Boxed& f, const Boxed& g) const {
    if (!cloud_.one_body(f.a, g.a)) return true;
    if (f.b == g.a) return f.a != g.b && passes_on(f.a, f.b, g.b);
    if (g.b == f.a) return passes_on(g.a, g.b, f.b);
    return same_side(f.a, f.b, g.a, g.b) || same_side(g.a, g.b, f.a, f.b);
  }
  /// From a over b to c without going back over the same line.
  bool passes_on(NodeIndex a, NodeIndex b, NodeIndex c) const {
    return orientation(at(a), at(b), at(c)) != 0 || (at(a) - at(b)).dot(at(c) - at(b)) < 0.0;
  }
  /// Whether c and d lie on one side of the line ab, off it.
  bool same_side(NodeIndex a, NodeIndex b, NodeIndex c, NodeIndex d) const {
    return orientation(at(a), at(b), at(c)) * orientation(at(a), at(b), at(d)) > 0;
  }

  const Cloud<2>& cloud_;
  std::vector<Boxed> facets_;
};

} // namespace

bool is_plain_boundary(const Cloud<2>& cloud) {
  PlainBoundary boundary(cloud);
  return boundary.facets_are_apart() && boundary.loops_nest();
}

} // namespace cnem::voronoi
