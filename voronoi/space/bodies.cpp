#include "voronoi/space/bodies.hpp"

#include "core/disjoint_sets.hpp"
#include "core/index.hpp"

#include <algorithm>
#include <cassert>
#include <tuple>
#include <utility>

namespace cnem::voronoi {

IndexedVector<NodeIndex, std::int32_t> bodies_of(const Tetrahedra& mesh) {
  const std::size_t nodes = mesh.of_node.size();
  DisjointSets together(nodes);
  for (const auto& node : mesh.node)
    for (std::size_t k = 1; k < 4; ++k) together.join(index_of(node[0]), index_of(node[k]));
  IndexedVector<NodeIndex, std::int32_t> body(nodes, -1);
  std::int32_t bodies = 0;
  for (const NodeIndex i : body.indices()) { // the first of each comes before the others
    const auto first = as<NodeIndex>(together.first(index_of(i)));
    body[i] = first == i ? bodies++ : body[first];
  }
  return bodies > 1 ? body : IndexedVector<NodeIndex, std::int32_t>{};
}

std::vector<SingleBody> single_bodies(const Cloud<3>& cloud) {
  const auto body_of = [&](NodeIndex i) { return index_of(cloud.body.empty() ? 0 : cloud.body[i]); };
  std::vector<SingleBody> bodies;
  IndexedVector<NodeIndex, NodeIndex> number(cloud.position.size());
  for (const NodeIndex i : cloud.position.indices()) {
    if (bodies.size() <= body_of(i)) bodies.resize(body_of(i) + 1);
    SingleBody& body = bodies[body_of(i)];
    number[i] = body.node.next();
    body.node.push_back(i);
    body.cloud.position.push_back(cloud.position[i]);
  }
  for (const CloudFacetIndex f : cloud.facets.indices()) {
    Facet<3> facet = cloud.facets[f];
    SingleBody& body = bodies[body_of(facet.node[0])];
    for (NodeIndex& i : facet.node) i = number[i];
    body.facet.push_back(f);
    body.cloud.facets.push_back(facet);
  }
  for (const auto& [a, b] : cloud.twins)
    if (cloud.one_body(a, b)) bodies[body_of(a)].cloud.twins.push_back({number[a], number[b]});
  std::erase_if(bodies, [](const SingleBody& body) { return body.node.empty(); });
  for (SingleBody& body : bodies) body.cloud.piece_names = cloud.piece_names;
  return bodies;
}

Tetrahedra joined(const Cloud<3>& cloud, const std::vector<SingleBody>& bodies,
                  const std::vector<Tetrahedra>& meshes) {
  assert(bodies.size() == meshes.size());
  struct Source {
    std::array<NodeIndex, 4> node;
    std::size_t body;
    SimplexIndex tetrahedron;
    bool operator<(const Source& other) const { return node < other.node; }
  };
  std::vector<Source> order;
  for (std::size_t b = 0; b < bodies.size(); ++b)
    for (const SimplexIndex t : meshes[b].node.indices()) {
      auto node = meshes[b].node[t];
      for (NodeIndex& i : node) i = bodies[b].node[i];
      order.push_back({node, b, t});
    }
  std::sort(order.begin(), order.end());
  std::vector<IndexedVector<SimplexIndex, SimplexIndex>> number(bodies.size());
  for (std::size_t b = 0; b < bodies.size(); ++b) number[b].resize(meshes[b].node.size());
  for (std::size_t n = 0; n < order.size(); ++n)
    number[order[n].body][order[n].tetrahedron] = as<SimplexIndex>(n);
  Tetrahedra mesh;
  mesh.of_node.assign(cloud.position.size(), SimplexIndex::none);
  for (const auto& [node, b, t] : order) {
    const SimplexIndex made = mesh.node.next();
    mesh.node.push_back(node);
    auto neighbour = meshes[b].neighbour[t];
    for (SimplexIndex& other : neighbour)
      if (exists(other)) other = number[b][other];
    mesh.neighbour.push_back(neighbour);
    auto facet = meshes[b].facet[t];
    for (CloudFacetIndex& f : facet)
      if (exists(f)) f = bodies[b].facet[f];
    mesh.facet.push_back(facet);
    for (const NodeIndex i : node)
      if (!exists(mesh.of_node[i])) mesh.of_node[i] = made;
  }
  return mesh;
}

} // namespace cnem::voronoi
