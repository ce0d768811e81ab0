#include "voronoi/plane/cells.hpp"

#include "core/error.hpp"
#include "core/index.hpp"
#include "voronoi/plane/boundary_checks.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <fmt/format.h>

namespace cnem::voronoi {

namespace {

class CellBuilder {
public:
  CellBuilder(const Cloud<2>& cloud, const Triangulation& mesh, const Circumcircles& circles)
      : cloud_(cloud), mesh_(mesh), circles_(circles),
        facet_triangle_(cloud.facets.size(), SimplexIndex::none) {}

  Cells build() {
    cells_.hidden_of_triangle.assign(mesh_.node.size(), -1);
    cells_.crossing_of_facet.assign(cloud_.facets.size(), -1);
    cells_.crossing.reserve(cloud_.facets.size());
    cells_.boundary.reserve(2 * cloud_.facets.size());
    cells_.volume.assign(cloud_.position.size(), 0.0);
    for (const SimplexIndex t : mesh_.node.indices())
      for (std::size_t k = 0; k < 3; ++k)
        if (exists(mesh_.facet[t][k])) facet_triangle_[mesh_.facet[t][k]] = t;
    for (const CloudFacetIndex f : cloud_.facets.indices()) share_facet(f);
    add_interior();
    add_neighbours();
    return std::move(cells_);
  }

private:
  const Vec2& at(NodeIndex node) const { return cloud_.position[node]; }

  /// The circumcentre of t is on the far side of the facet's line. For the triangle at the facet, and from
  /// there for each neighbour of a hidden triangle, this means hidden by the facet itself: the bisector of
  /// the common edge meets the line inside both circles, where no end of the facet can be.
  bool is_beyond(SimplexIndex t, CloudFacetIndex facet) const {
    const auto& [a, b] = cloud_.facets[facet].node;
    return cross(at(b) - at(a), circles_.centre[t] - at(a)) < 0.0;
  }

  /// The part of the facet that belongs to `cell` ends at s.
  void end_piece(CloudFacetIndex facet, NodeIndex cell, double s0, double s1) {
    cells_.boundary.push_back({cell, facet, {{{s0}, {s1}}}});
    const auto& [a, b] = cloud_.facets[facet].node;
    const Vec2 edge = at(b) - at(a);
    cells_.volume[index_of(cell)] += 0.5 * (s1 - s0) * cross(at(a) - at(cell), edge);
  }

  /// Where the bisector of nodes i and j, which passes through the hidden `centre`, meets the facet. Both
  /// nodes are on the near side and the centre is beyond, so that this is always between the midpoint and the
  /// centre.
  double crossing_parameter(CloudFacetIndex facet, NodeIndex i, NodeIndex j, const Vec2& centre) const {
    const auto& [a, b] = cloud_.facets[facet].node;
    const Vec2 edge = at(b) - at(a), middle = 0.5 * (at(i) + at(j));
    const double near = std::max(cross(edge, middle - at(a)), 0.0), beyond = -cross(edge, centre - at(a));
    const Vec2 x = middle + (centre - middle) * (near / (near + beyond));
    return (x - at(a)).dot(edge) / edge.squaredNorm();
  }

  /// Divides a boundary facet among cells. The triangles whose circumcentres it hides are connected with it
  /// (a circle with a hidden centre meets the facet in a chord, and so do those between); going round them
  /// clockwise from one end of the facet to the other gives its owners in order. Which triangles these are is
  /// decided once, so that the cells close even where rounding decides it.
  void share_facet(CloudFacetIndex facet) {
    const auto& [a, b] = cloud_.facets[facet].node;
    const SimplexIndex first = facet_triangle_[facet];
    if (cells_.hidden_of_triangle[first] >= 0 || !is_beyond(first, facet)) {
      cells_.crossing_of_facet[facet] = static_cast<std::int32_t>(cells_.crossing.size());
      cells_.crossing.push_back({facet, 0.5});
      end_piece(facet, a, 0.0, 0.5);
      end_piece(facet, b, 0.5, 1.0);
      return;
    }
    std::int32_t entry = 0;
    while (mesh_.facet[first][index_of(entry)] != facet) ++entry;
    hide(first, facet);
    NodeIndex owner = a;
    double s = 0.0;
    stack_ = {{first, next_corner(entry)}, {first, next_corner(next_corner(entry))}};
    while (!stack_.empty()) {
      const auto [t, k] = stack_.back();
      stack_.pop_back();
      const SimplexIndex across = mesh_.neighbour[t][index_of(k)];
      if (exists(across) && cells_.hidden_of_triangle[across] < 0 && is_beyond(across, facet)) {
        hide(across, facet);
        std::int32_t back = 0;
        while (mesh_.neighbour[across][index_of(back)] != t) ++back;
        stack_.emplace_back(across, next_corner(back));
        stack_.emplace_back(across, next_corner(next_corner(back)));
        continue;
      }
      const NodeIndex to = mesh_.node[t][index_of(next_corner(k))];
      const double end = std::clamp(crossing_parameter(facet, owner, to, circles_.centre[t]), s, 1.0);
      cells_.hidden[index_of(cells_.hidden_of_triangle[t])].crossing[index_of(k)] =
          static_cast<std::int32_t>(cells_.crossing.size());
      cells_.crossing.push_back({facet, end});
      end_piece(facet, owner, s, end);
      owner = to;
      s = end;
    }
    end_piece(facet, b, s, 1.0);
  }

  void hide(SimplexIndex t, CloudFacetIndex facet) {
    cells_.hidden_of_triangle[t] = static_cast<std::int32_t>(cells_.hidden.size());
    cells_.hidden.push_back({facet, {-1, -1, -1}});
  }

  Vec2 position(std::int32_t crossing) const {
    const auto& [facet, s] = cells_.crossing[index_of(crossing)];
    const auto& [a, b] = cloud_.facets[facet].node;
    return (1.0 - s) * at(a) + s * at(b);
  }

  /// End of the facet dual to edge k of triangle t, on the side of t.
  Vec2 end_point(SimplexIndex t, std::int32_t k) const {
    const std::int32_t hidden = cells_.hidden_of_triangle[t];
    return hidden < 0 ? circles_.centre[t] : position(cells_.hidden[index_of(hidden)].crossing[index_of(k)]);
  }

  CloudFacetIndex hider(SimplexIndex t) const {
    const std::int32_t hidden = cells_.hidden_of_triangle[t];
    return hidden < 0 ? CloudFacetIndex::none : cells_.hidden[index_of(hidden)].facet;
  }

  void add_interior() {
    cells_.interior.reserve(mesh_.node.size() * 3 / 2 + cloud_.facets.size());
    for (const SimplexIndex t : mesh_.node.indices()) {
      const CloudFacetIndex hidden_by = hider(t);
      for (std::int32_t k = 0; k < 3; ++k) {
        const SimplexIndex across = mesh_.neighbour[t][index_of(k)];
        if (across > t) continue; // each edge once, from its later triangle
        Vec2 start;
        if (!exists(across)) {
          const CloudFacetIndex facet = mesh_.facet[t][index_of(k)];
          if (hidden_by == facet) continue;
          start = position(cells_.crossing_of_facet[facet]);
        } else {
          if (exists(hidden_by) && hidden_by == hider(across)) continue;
          std::int32_t back = 0;
          while (mesh_.neighbour[across][index_of(back)] != t) ++back;
          start = end_point(across, back);
        }
        const Vec2 end = end_point(t, k);
        const NodeIndex i = mesh_.node[t][index_of(next_corner(k))],
                        j = mesh_.node[t][index_of(next_corner(next_corner(k)))];
        cells_.interior.push_back({{i, j}, {across, t}, {start, end}});
        cells_.volume[index_of(i)] += 0.5 * cross(start - at(i), end - start);
        cells_.volume[index_of(j)] -= 0.5 * cross(start - at(j), end - start);
      }
    }
  }

  void add_neighbours() {
    std::vector<std::array<NodeIndex, 2>> edges;
    edges.reserve(3 * cloud_.position.size());
    for (const SimplexIndex t : mesh_.node.indices())
      for (std::size_t k = 0; k < 3; ++k)
        if (mesh_.neighbour[t][k] < t)
          edges.push_back({mesh_.node[t][(k + 1) % 3], mesh_.node[t][(k + 2) % 3]});
    cells_.neighbours = other_ends(cloud_.position.size(), edges);
  }

  const Cloud<2>& cloud_;
  const Triangulation& mesh_;
  const Circumcircles& circles_;
  Cells cells_;
  IndexedVector<CloudFacetIndex, SimplexIndex> facet_triangle_; ///< the triangle on its left
  std::vector<std::pair<SimplexIndex, std::int32_t>> stack_;
};

/// Whether the cells fill the domain, to rounding.
[[maybe_unused]] bool fill(const Cloud<2>& cloud, const Cells& cells) {
  double sum = 0.0, size = 0.0;
  for (const double v : cells.volume) sum += v;
  for (const Vec2& x : cloud.position) size = std::max(size, x.cwiseAbs().maxCoeff());
  const double area = enclosed_measure(cloud);
  return std::abs(sum - area) <= 1e-11 * area + 1e-13 * size * size;
}

} // namespace

Cells constrained_cells(const Cloud<2>& cloud, const Triangulation& mesh, const Circumcircles& circles) {
  Cells cells = CellBuilder(cloud, mesh, circles).build();
  for (const NodeIndex i : cloud.position.indices())
    if (!(cells.volume[index_of(i)] > 0.0))
      throw GeometryError(
          fmt::format("the cell of {} has no area (V = {:.3g} m²): its neighbours are too close "
                      "to each other or to one line",
                      describe_node(cloud, i), cells.volume[index_of(i)]));
  assert(is_closed(cloud, cells));
  assert(fill(cloud, cells));
  return cells;
}

} // namespace cnem::voronoi
