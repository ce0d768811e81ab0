#include "core/index.hpp"
#include "voronoi/plane/cells.hpp"
#include "voronoi/plane/locate.hpp"

namespace cnem::voronoi {

namespace {

/// Polygons of the cells, each from one round through the triangles of its node.
class PolygonBuilder {
public:
  PolygonBuilder(const Cloud<2>& cloud, const Triangulation& mesh, const Circumcircles& circles,
                 const Cells& cells)
      : cloud_(cloud), mesh_(mesh), circles_(circles), cells_(cells),
        vertex_of_triangle_(mesh.node.size(), -1), vertex_of_crossing_(cells.crossing.size(), -1) {}

  CellGeometry<2> build() {
    IndexedVector<NodeIndex, bool> on_boundary(index_of(cloud_.nodes()), false);
    for (const auto& facet : cloud_.facets) on_boundary[facet.node[0]] = true;
    result_.index.reserve(7 * index_of(cloud_.nodes()));
    result_.vertex.reserve(mesh_.node.size() + 2 * cloud_.facets.size());
    result_.vertex_begin.push_back(0);
    result_.begin.push_back(0);
    for (const NodeIndex i : cloud_.position.indices()) {
      add_cell(i, on_boundary[i]);
      result_.begin.push_back(static_cast<std::int32_t>(result_.index.size()));
    }
    return std::move(result_);
  }

private:
  void add_cell(NodeIndex node, bool on_boundary) {
    const SimplexIndex first = mesh_.triangle_of_node[node];
    SimplexIndex t = first;
    std::int32_t k = 0;
    while (mesh_.node[t][index_of(k)] != node) ++k;
    if (on_boundary) {
      result_.index.push_back(new_vertex(cloud_.position[node], {{node, 1.0}}));
      leave_wall(t, next_corner(next_corner(k)));
    }
    while (true) {
      if (cells_.hidden_of_triangle[t] < 0) result_.index.push_back(centre_vertex(t));
      const std::int32_t exit = next_corner(k);
      const SimplexIndex across = mesh_.neighbour[t][index_of(exit)];
      if (!exists(across)) {
        reach_wall(t, exit);
        return;
      }
      std::int32_t back = 0;
      while (mesh_.neighbour[across][index_of(back)] != t) ++back;
      cross_edge(t, exit, across, back);
      if (across == first) return;
      t = across;
      k = next_corner(back);
    }
  }

  CloudFacetIndex hider(SimplexIndex t) const {
    const std::int32_t hidden = cells_.hidden_of_triangle[t];
    return hidden < 0 ? CloudFacetIndex::none : cells_.hidden[index_of(hidden)].facet;
  }

  /// The ends on the boundary of the facet dual to the edge between two triangles.
  void cross_edge(SimplexIndex t, std::int32_t exit, SimplexIndex across, std::int32_t back) {
    const CloudFacetIndex from = hider(t), to = hider(across);
    if (from == to) return;
    if (exists(from)) add_end(t, exit);
    if (exists(to)) add_end(across, back);
  }

  void leave_wall(SimplexIndex t, std::int32_t k) {
    const CloudFacetIndex facet = mesh_.facet[t][index_of(k)];
    if (hider(t) == facet) return;
    result_.index.push_back(crossing_vertex(cells_.crossing_of_facet[facet]));
    if (exists(hider(t))) add_end(t, k);
  }

  void reach_wall(SimplexIndex t, std::int32_t k) {
    const CloudFacetIndex facet = mesh_.facet[t][index_of(k)];
    if (hider(t) == facet) return;
    if (exists(hider(t))) add_end(t, k);
    result_.index.push_back(crossing_vertex(cells_.crossing_of_facet[facet]));
  }

  void add_end(SimplexIndex t, std::int32_t k) {
    const auto& hidden = cells_.hidden[index_of(cells_.hidden_of_triangle[t])];
    result_.index.push_back(crossing_vertex(hidden.crossing[index_of(k)]));
  }

  std::int32_t crossing_vertex(std::int32_t crossing) {
    auto& vertex = vertex_of_crossing_[index_of(crossing)];
    if (vertex >= 0) return vertex;
    const auto& [facet, s] = cells_.crossing[index_of(crossing)];
    const auto& [a, b] = cloud_.facets[facet].node;
    return vertex =
               new_vertex((1.0 - s) * cloud_.position[a] + s * cloud_.position[b], {{a, 1.0 - s}, {b, s}});
  }

  std::int32_t centre_vertex(SimplexIndex t) {
    auto& vertex = vertex_of_triangle_[t];
    if (vertex >= 0) return vertex;
    const Vec2& x = circles_.centre[t];
    const SimplexIndex in = walk(cloud_, mesh_, t, x).triangle;
    const auto weight = barycentric(cloud_, mesh_, in, x);
    const auto& nodes = mesh_.node[in];
    return vertex = new_vertex(x, {{nodes[0], weight[0]}, {nodes[1], weight[1]}, {nodes[2], weight[2]}});
  }

  std::int32_t new_vertex(const Vec2& x, std::initializer_list<std::pair<NodeIndex, double>> weights) {
    result_.vertex.push_back(x);
    for (const auto& [node, weight] : weights) {
      result_.vertex_node.push_back(node);
      result_.vertex_weight.push_back(weight);
    }
    result_.vertex_begin.push_back(static_cast<std::int32_t>(result_.vertex_node.size()));
    return static_cast<std::int32_t>(result_.vertex.size()) - 1;
  }

  const Cloud<2>& cloud_;
  const Triangulation& mesh_;
  const Circumcircles& circles_;
  const Cells& cells_;
  IndexedVector<SimplexIndex, std::int32_t> vertex_of_triangle_; ///< −1: not yet made
  std::vector<std::int32_t> vertex_of_crossing_;                 ///< −1: not yet made
  CellGeometry<2> result_;
};

} // namespace

CellGeometry<2> cell_geometry(const Cloud<2>& cloud, const Triangulation& mesh, const Circumcircles& circles,
                              const Cells& cells) {
  return PolygonBuilder(cloud, mesh, circles, cells).build();
}

} // namespace cnem::voronoi
