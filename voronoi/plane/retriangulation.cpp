#include "voronoi/plane/retriangulation.hpp"

#include "core/index.hpp"
#include "voronoi/exact.hpp"
#include "voronoi/plane/boundary_checks.hpp"
#include "voronoi/plane/plain_boundary.hpp"
#include "voronoi/plane/simplex_order.hpp"

#include <algorithm>
#include <utility>

namespace cnem::voronoi {

namespace {

/// One side of a triangle on its way to that of the triangle across.
struct HalfEdge {
  NodeIndex other;       ///< its later node, in the list of its earlier one
  bool forwards;         ///< from the earlier to the later
  SimplexIndex triangle; ///< none: both of its triangles are known
  std::int32_t corner;   ///< opposite
};

class Retriangulation {
public:
  explicit Retriangulation(const Cloud<2>& cloud) : cloud_(cloud), leaving_(outgoing_facets(cloud)) {}

  std::optional<Triangulation> run() {
    const auto named = [&](NodeIndex i) { return exists(i) && i < cloud_.position.next(); };
    for (const TriangleNodes& corner : cloud_.simplices)
      if (!std::all_of(corner.begin(), corner.end(), named)) return std::nullopt;
    mesh_.node = cloud_.simplices;
    if (!connect() || !runs_counter_clockwise() || !is_plain_boundary(cloud_)) return std::nullopt;
    flip();
    number_by_nodes(mesh_, cloud_.position.size());
    if (!has_all_nodes()) return std::nullopt;
    return std::move(mesh_);
  }

private:
  const Vec2& at(NodeIndex i) const { return cloud_.position[i]; }

  /// Finds what is across the sides of which that is not known. False unless each side has one triangle to
  /// either side, or is a facet with one on its left.
  bool connect() {
    constexpr std::array unknown{SimplexIndex::none, SimplexIndex::none, SimplexIndex::none};
    mesh_.neighbour = cloud_.across;
    mesh_.neighbour.resize(mesh_.node.size(), unknown);
    mesh_.facet.assign(mesh_.node.size(),
                       {CloudFacetIndex::none, CloudFacetIndex::none, CloudFacetIndex::none});
    std::vector<std::size_t> begin(cloud_.position.size() + 1, 0);
    const auto for_each_side = [&](const auto& visit) {
      for (const SimplexIndex t : mesh_.node.indices())
        for (std::int32_t k = 0; k < 3; ++k) {
          if (exists(mesh_.neighbour[t][index_of(k)])) continue;
          const NodeIndex from = mesh_.node[t][index_of(next_corner(k))],
                          to = mesh_.node[t][index_of(next_corner(next_corner(k)))];
          visit(std::min(from, to), HalfEdge{std::max(from, to), from < to, t, k});
        }
    };
    for_each_side([&](NodeIndex low, const HalfEdge&) { ++begin[index_of(low) + 1]; });
    for (std::size_t i = 0; i + 1 < begin.size(); ++i) begin[i + 1] += begin[i];
    std::vector<HalfEdge> sides(begin.back());
    std::vector<std::size_t> end(begin.begin(), begin.end() - 1);
    bool fits = true;
    for_each_side([&](NodeIndex low, const HalfEdge& side) {
      const auto first = sides.begin() + static_cast<std::ptrdiff_t>(begin[index_of(low)]),
                 last = sides.begin() + static_cast<std::ptrdiff_t>(end[index_of(low)]);
      const auto across = std::find_if(first, last, [&](const HalfEdge& s) { return s.other == side.other; });
      if (across == last) {
        sides[end[index_of(low)]++] = side;
        return;
      }
      fits = fits && exists(across->triangle) && across->forwards != side.forwards;
      if (!fits) return;
      mesh_.neighbour[side.triangle][index_of(side.corner)] = across->triangle;
      mesh_.neighbour[across->triangle][index_of(across->corner)] = side.triangle;
      across->triangle = SimplexIndex::none; // it has both
    });
    if (!fits) return false;
    std::size_t facets = 0;
    for (const NodeIndex low : cloud_.position.indices())
      for (std::size_t s = begin[index_of(low)]; s < end[index_of(low)]; ++s) {
        const HalfEdge& side = sides[s];
        if (!exists(side.triangle)) continue;
        const NodeIndex from = side.forwards ? low : side.other, to = side.forwards ? side.other : low;
        const CloudFacetIndex facet = leaving_[from];
        if (!exists(facet) || cloud_.facets[facet].node[1] != to) return false;
        mesh_.facet[side.triangle][index_of(side.corner)] = facet;
        ++facets;
      }
    return facets == cloud_.facets.size();
  }

  bool has_all_nodes() const {
    return std::all_of(mesh_.triangle_of_node.begin(), mesh_.triangle_of_node.end(),
                       [](SimplexIndex t) { return exists(t); });
  }

  bool runs_counter_clockwise() const {
    return std::all_of(mesh_.node.begin(), mesh_.node.end(),
                       [&](const TriangleNodes& n) { return orientation(at(n[0]), at(n[1]), at(n[2])) > 0; });
  }

  void flip() {
    for (const SimplexIndex t : mesh_.node.indices())
      for (std::int32_t k = 0; k < 3; ++k)
        if (mesh_.neighbour[t][index_of(k)] < t) waiting_.emplace_back(t, k);
    std::reverse(waiting_.begin(), waiting_.end());
    while (!waiting_.empty()) {
      const auto [t, k] = waiting_.back();
      waiting_.pop_back();
      const SimplexIndex o = mesh_.neighbour[t][index_of(k)];
      if (!exists(o)) continue;
      const auto& back = mesh_.neighbour[o];
      const auto m = as<std::int32_t>(std::find(back.begin(), back.end(), t) - back.begin());
      const auto& [p, a, b] = mesh_.node[t];
      if (!in_circle(at(p), at(a), at(b), at(mesh_.node[o][index_of(m)]))) continue;
      flip(t, k, o, m);
    }
  }

  /// pab and qba become paq and pqb, with p opposite the side in t and q in o.
  void flip(SimplexIndex t, std::int32_t k, SimplexIndex o, std::int32_t m) {
    const auto next = [](std::int32_t corner) { return index_of(next_corner(corner)); };
    const auto last = [](std::int32_t corner) { return index_of(next_corner(next_corner(corner))); };
    const TriangleNodes tn = mesh_.node[t], on = mesh_.node[o];
    const auto ta = mesh_.neighbour[t], oa = mesh_.neighbour[o];
    const auto tf = mesh_.facet[t], of = mesh_.facet[o];
    const NodeIndex p = tn[index_of(k)], a = tn[next(k)], b = tn[last(k)], q = on[index_of(m)];
    mesh_.node[t] = {p, a, q};
    mesh_.neighbour[t] = {oa[next(m)], o, ta[last(k)]};
    mesh_.facet[t] = {of[next(m)], CloudFacetIndex::none, tf[last(k)]};
    mesh_.node[o] = {p, q, b};
    mesh_.neighbour[o] = {oa[last(m)], ta[next(k)], t};
    mesh_.facet[o] = {of[last(m)], tf[next(k)], CloudFacetIndex::none};
    const auto meet = [&](SimplexIndex outer, SimplexIndex before, SimplexIndex now) {
      if (exists(outer))
        *std::find(mesh_.neighbour[outer].begin(), mesh_.neighbour[outer].end(), before) = now;
    };
    meet(oa[next(m)], o, t);
    meet(ta[next(k)], t, o);
    for (const auto& [triangle, corner] : {std::pair(t, 0), {t, 2}, {o, 0}, {o, 1}})
      waiting_.emplace_back(triangle, corner);
  }

  const Cloud<2>& cloud_;
  IndexedVector<NodeIndex, CloudFacetIndex> leaving_; ///< facet that leaves it
  Triangulation mesh_;
  std::vector<std::pair<SimplexIndex, std::int32_t>> waiting_; ///< sides to look at: those opposite a corner
};

} // namespace

std::optional<Triangulation> retriangulate(const Cloud<2>& cloud) {
  if (cloud.simplices.empty() || !cloud.twins.empty()) return std::nullopt;
  return Retriangulation(cloud).run();
}

} // namespace cnem::voronoi
