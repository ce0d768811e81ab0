#include "voronoi/space/walls.hpp"

#include "core/error.hpp"
#include "core/index.hpp"
#include "voronoi/space/surface.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace cnem::voronoi {

namespace {

constexpr CloudFacetIndex no_facet = CloudFacetIndex::none;

/// Three nodes in increasing order, and whether it took an even permutation to put them there.
struct Triple {
  std::array<NodeIndex, 3> node;
  bool even;

  Triple(NodeIndex a, NodeIndex b, NodeIndex c) : node{a, b, c}, even(true) {
    const auto swap = [&](std::size_t p, std::size_t q) {
      if (node[p] <= node[q]) return;
      std::swap(node[p], node[q]);
      even = !even;
    };
    swap(0, 1), swap(1, 2), swap(0, 1);
  }
};

/// Facets by the lowest of their nodes.
class FacetTable {
public:
  FacetTable(const Cloud<3>& cloud, const IndexedVector<NodeIndex, NodeIndex>& first)
      : begin_(cloud.position.size() + 2, 0), entries_(cloud.facets.size(), Entry{{}, {}, no_facet, false}) {
    const auto triple = [&](const Facet<3>& facet) {
      return Triple(first[facet.node[0]], first[facet.node[1]], first[facet.node[2]]);
    };
    for (const auto& facet : cloud.facets) ++begin_[index_of(triple(facet).node[0]) + 2];
    for (std::size_t i = 2; i < begin_.size(); ++i) begin_[i] += begin_[i - 1];
    for (const CloudFacetIndex f : cloud.facets.indices()) {
      const Triple key = triple(cloud.facets[f]);
      entries_[begin_[index_of(key.node[0]) + 1]++] = {key.node[1], key.node[2], f, key.even};
    }
  }

  /// The facets with these nodes: the one with the given sense, and the one with the other.
  std::array<CloudFacetIndex, 2> find(const Triple& key) const {
    std::array<CloudFacetIndex, 2> found{no_facet, no_facet};
    const std::size_t lowest = index_of(key.node[0]);
    for (std::uint32_t e = begin_[lowest]; e < begin_[lowest + 1]; ++e)
      if (entries_[e].middle == key.node[1] && entries_[e].highest == key.node[2])
        found[entries_[e].even == key.even ? 0 : 1] = entries_[e].facet;
    return found;
  }

private:
  struct Entry {
    NodeIndex middle, highest;
    CloudFacetIndex facet;
    bool even;
  };
  std::vector<std::uint32_t> begin_;
  std::vector<Entry> entries_;
};

[[noreturn]] void throw_inside_out(const Cloud<3>& cloud, const std::array<NodeIndex, 3>& node) {
  throw GeometryError(fmt::format(
      "the surface is inside out at {}, {}, {}: expected normals out of the domain",
      describe_node(cloud, node[0]), describe_node(cloud, node[1]), describe_node(cloud, node[2])));
}

} // namespace

Walls find_walls(const Cloud<3>& cloud, const Delaunay& mesh) {
  const FacetTable table(cloud, mesh.first);
  IndexedVector<NodeIndex, std::uint8_t> on_surface(cloud.position.size(), 0);
  for (const auto& facet : cloud.facets)
    for (const NodeIndex i : facet.node) on_surface[mesh.first[i]] = 1;

  enum Seen : std::uint8_t { no = 0, behind = 1, ahead = 2 };
  IndexedVector<CloudFacetIndex, std::uint8_t> seen(cloud.facets.size(), Seen::no);
  Walls walls;
  walls.facet.assign(mesh.node.size(), {no_facet, no_facet, no_facet, no_facet});
  walls.blocked.assign(mesh.node.size(), 0);
  const auto stands = [&](SimplexIndex t, std::size_t k, CloudFacetIndex inner, CloudFacetIndex outer) {
    if (exists(inner)) {
      walls.facet[t][k] = inner;
      seen[inner] |= Seen::behind;
    }
    if (exists(outer)) seen[outer] |= Seen::ahead;
    walls.blocked[t] |= static_cast<std::uint8_t>(1U << k);
  };
  for (const SimplexIndex t : mesh.node.indices()) {
    const auto& node = mesh.node[t];
    const int count = on_surface[node[0]] + on_surface[node[1]] + on_surface[node[2]] + on_surface[node[3]];
    if (count < 3) continue;
    for (std::size_t k = 0; k < 4; ++k) {
      if (count == 3 && on_surface[node[k]]) continue;
      const SimplexIndex next = mesh.neighbour[t][k];
      if (exists(next) && next < t) continue; // the face has been looked at from there
      const auto& [a, b, c] = face_of_tetrahedron[k];
      const auto [inner, outer] = table.find({node[a], node[b], node[c]});
      if (!exists(inner) && !exists(outer)) continue;
      stands(t, k, inner, outer);
      if (!exists(next)) continue;
      const auto& back = mesh.neighbour[next];
      stands(next, index_of(std::find(back.begin(), back.end(), t) - back.begin()), outer, inner);
    }
  }
  for (const CloudFacetIndex f : seen.indices()) {
    if (seen[f] == Seen::no) walls.lost.push_back(f);
    if (seen[f] == Seen::ahead) walls.beyond.push_back(f);
  }
  return walls;
}

IndexedVector<SimplexIndex, std::uint8_t> inside_of_walls(const Cloud<3>& cloud, const Delaunay& mesh,
                                                          const Walls& walls) {
  if (!walls.beyond.empty()) throw_inside_out(cloud, cloud.facets[walls.beyond.front()].node);
  IndexedVector<SimplexIndex, std::uint8_t> inside(mesh.node.size(), 0);
  std::vector<SimplexIndex> stack;
  const auto mark = [&](SimplexIndex t) {
    if (inside[t]) return;
    inside[t] = 1;
    stack.push_back(t);
  };
  for (const SimplexIndex t : mesh.node.indices()) {
    if (walls.blocked[t])
      for (const CloudFacetIndex f : walls.facet[t])
        if (exists(f)) mark(t);
    while (!stack.empty()) {
      const SimplexIndex at = stack.back();
      stack.pop_back();
      for (std::size_t k = 0; k < 4; ++k)
        if (!(walls.blocked[at] >> k & 1U) && exists(mesh.neighbour[at][k])) mark(mesh.neighbour[at][k]);
    }
  }
  for (const SimplexIndex t : mesh.node.indices())
    for (std::size_t k = 0; inside[t] && k < 4; ++k) {
      const bool open = !(walls.blocked[t] >> k & 1U) && !exists(mesh.neighbour[t][k]);
      if (open || ((walls.blocked[t] >> k & 1U) && !exists(walls.facet[t][k])))
        throw_inside_out(cloud,
                         {mesh.node[t][face_of_tetrahedron[k][0]], mesh.node[t][face_of_tetrahedron[k][1]],
                          mesh.node[t][face_of_tetrahedron[k][2]]});
    }
  return inside;
}

IndexedVector<SimplexIndex, std::array<NodeIndex, 4>>
own_nodes(const Cloud<3>& cloud, const Delaunay& mesh, const Walls& walls,
          const IndexedVector<SimplexIndex, std::uint8_t>& inside) {
  IndexedVector<SimplexIndex, std::array<NodeIndex, 4>> own = mesh.node;
  if (!mesh.coincident) return own;
  IndexedVector<NodeIndex, std::uint8_t> shared(cloud.position.size(), 0);
  for (const NodeIndex i : mesh.first.indices())
    if (mesh.first[i] != i) shared[i] = shared[mesh.first[i]] = 1;
  IndexedVector<SimplexIndex, std::uint8_t> told(mesh.node.size(), 0);
  std::vector<SimplexIndex> stack;
  for (const SimplexIndex start : mesh.node.indices()) {
    if (!walls.blocked[start] || !inside[start]) continue;
    for (const CloudFacetIndex f : walls.facet[start]) {
      if (!exists(f)) continue;
      for (const NodeIndex i : cloud.facets[f].node) {
        if (!shared[i]) continue;
        const NodeIndex place = mesh.first[i];
        const auto visit = [&](SimplexIndex t) {
          std::size_t k = 0;
          while (mesh.node[t][k] != place) ++k;
          if (!(told[t] >> k & 1U)) {
            told[t] |= static_cast<std::uint8_t>(1U << k);
            own[t][k] = i;
            stack.push_back(t);
          } else if (own[t][k] != i) {
            throw GeometryError(
                fmt::format("the surface touches itself: {} meets node {} on the inner side of {}",
                            describe_node(cloud, i), index_of(own[t][k]), describe_facet(cloud, f)));
          }
        };
        visit(start);
        while (!stack.empty()) {
          const SimplexIndex t = stack.back();
          stack.pop_back();
          for (std::size_t k = 0; k < 4; ++k) {
            const SimplexIndex next = mesh.neighbour[t][k];
            if (mesh.node[t][k] == place || walls.blocked[t] >> k & 1U || !exists(next)) continue;
            if (inside[next]) visit(next);
          }
        }
      }
    }
  }
  return own;
}

} // namespace cnem::voronoi
