#include "voronoi/space/exchanges.hpp"

#include "core/index.hpp"

#include <algorithm>

namespace cnem::voronoi {

namespace {

constexpr std::size_t longest_ring = 9; // triangulations of a polygon of ten corners are 1,430
constexpr int most_removals = 24;

} // namespace

Face face_of(NodeIndex a, NodeIndex b, NodeIndex c) {
  Face face{a, b, c};
  std::sort(face.begin(), face.end());
  return face;
}

std::vector<FlipMesh::Nodes> key_of(std::vector<FlipMesh::Nodes> nodes) {
  for (FlipMesh::Nodes& node : nodes) std::sort(node.begin(), node.end());
  std::sort(nodes.begin(), nodes.end());
  return nodes;
}

SurfaceParts::SurfaceParts(const Cloud<3>& cloud, const IndexedVector<NodeIndex, NodeIndex>& first)
    : first_(first), begin_(cloud.position.size() + 2, 0), faces_(2 * cloud.facets.size()) {
  for (const auto& facet : cloud.facets) {
    const Face face = at_first(facet);
    for (const NodeIndex i : {face[0], face[1]}) ++begin_[index_of(i) + 2];
  }
  for (std::size_t i = 2; i < begin_.size(); ++i) begin_[i] += begin_[i - 1];
  for (const auto& facet : cloud.facets) {
    const Face face = at_first(facet);
    for (const NodeIndex i : {face[0], face[1]}) faces_[begin_[index_of(i) + 1]++] = face;
  }
}

Face SurfaceParts::at_first(const Facet<3>& facet) const {
  return face_of(first_[facet.node[0]], first_[facet.node[1]], first_[facet.node[2]]);
}

bool SurfaceParts::is_edge(const Edge& edge) const {
  const auto faces = at(edge.first);
  return std::any_of(faces.begin(), faces.end(), [&](const Face& face) {
    return std::find(face.begin(), face.end(), edge.second) != face.end();
  });
}

bool SurfaceParts::is_facet(const Face& face) const {
  const auto faces = at(face[0]);
  return std::find(faces.begin(), faces.end(), face) != faces.end();
}

std::vector<FlipMesh::Nodes> Exchanges::nodes_of(const std::vector<SimplexIndex>& tetrahedra) const {
  std::vector<FlipMesh::Nodes> nodes;
  for (const SimplexIndex t : tetrahedra) nodes.push_back(mesh.nodes(t));
  return nodes;
}

void Exchanges::add_removals(const Edge& edge, std::vector<Exchange>& exchanges) {
  const NodeIndex d = edge.first, e = edge.second;
  if (surface_.is_edge(edge)) return;
  const SimplexIndex start = mesh.stars().with(d, e);
  if (!exists(start)) return;
  const FlipMesh::Ring ring = mesh.ring(d, e, start);
  const std::size_t n = ring.around.size();
  if (n < 3 || n > longest_ring) return;
  // an edge of the convex hull goes where the hull is flat
  if (!ring.closed && mesh.sign(ring.around.front(), ring.around.back(), d, e) != 0) return;
  std::vector<std::array<std::size_t, 3>> triangles;
  std::vector<std::array<std::size_t, 2>> open{{0, n - 1}};
  int found = 0;
  const auto fill = [&](const auto& self) -> void {
    if (found >= most_removals) return;
    if (open.empty()) {
      Exchange exchange{ring.tetrahedra, {}};
      for (const auto& [i, j, k] : triangles) {
        exchange.fresh.push_back({ring.around[i], ring.around[j], ring.around[k], e});
        exchange.fresh.push_back({ring.around[i], ring.around[k], ring.around[j], d});
      }
      exchanges.push_back(std::move(exchange));
      ++found;
      return;
    }
    const std::size_t i = open.back()[0], k = open.back()[1];
    open.pop_back();
    if (k - i < 2) {
      self(self);
    } else {
      for (std::size_t j = i + 1; j < k; ++j) {
        const NodeIndex a = ring.around[i], b = ring.around[j], c = ring.around[k];
        if (mesh.sign(a, b, c, e) <= 0 || mesh.sign(a, c, b, d) <= 0) continue;
        triangles.push_back({i, j, k});
        open.push_back({i, j});
        open.push_back({j, k});
        self(self);
        open.pop_back();
        open.pop_back();
        triangles.pop_back();
      }
    }
    open.push_back({i, k});
  };
  fill(fill);
}

void Exchanges::add_split(const Face& face, std::vector<Exchange>& exchanges) {
  if (surface_.is_facet(face)) return;
  const SimplexIndex t = mesh.stars().with(face[0], face[1], face[2]);
  if (!exists(t)) return;
  std::size_t k = 0;
  while (std::find(face.begin(), face.end(), mesh.nodes(t)[k]) != face.end()) ++k;
  const SimplexIndex other = mesh.neighbours(t)[k];
  if (!exists(other)) return;
  std::size_t back = 0;
  while (mesh.neighbours(other)[back] != t) ++back;
  const NodeIndex d = mesh.nodes(t)[k], e = mesh.nodes(other)[back];
  Exchange exchange{{t, other}, {}};
  for (std::size_t q = 0; q < 3; ++q) {
    const NodeIndex a = mesh.nodes(t)[face_of_tetrahedron[k][q]],
                    b = mesh.nodes(t)[face_of_tetrahedron[k][(q + 1) % 3]];
    if (mesh.sign(d, e, a, b) <= 0) return;
    exchange.fresh.push_back({d, e, a, b});
  }
  exchanges.push_back(std::move(exchange));
}

} // namespace cnem::voronoi
