#include "voronoi/space/flip_mesh.hpp"

#include "core/index.hpp"
#include "voronoi/space/exact.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

namespace cnem::voronoi {

namespace {

std::array<NodeIndex, 3> sorted_face(const FlipMesh::Nodes& node, std::size_t k) {
  const auto& [a, b, c] = face_of_tetrahedron[k];
  std::array<NodeIndex, 3> face{node[a], node[b], node[c]};
  std::sort(face.begin(), face.end());
  return face;
}

/// The other two nodes, p and q, such that d, e, p, q are right-handed.
std::array<NodeIndex, 2> others(const FlipMesh::Nodes& node, NodeIndex d, NodeIndex e) {
  std::size_t at_d = 0, at_e = 0;
  while (node[at_d] != d) ++at_d;
  while (node[at_e] != e) ++at_e;
  const auto& face = face_of_tetrahedron[at_d];
  for (std::size_t k = 0; k < 3; ++k)
    if (face[k] == at_e) return {node[face[(k + 1) % 3]], node[face[(k + 2) % 3]]};
  return {NodeIndex::none, NodeIndex::none};
}

} // namespace

FlipMesh::FlipMesh(const Cloud<3>& cloud, Delaunay& mesh) : cloud_(cloud), mesh_(mesh), stars_(mesh) {}

int FlipMesh::sign(NodeIndex a, NodeIndex b, NodeIndex c, NodeIndex d) const {
  return orientation(at(a), at(b), at(c), at(d));
}

FlipMesh::Ring FlipMesh::ring(NodeIndex d, NodeIndex e, SimplexIndex start) const {
  const auto beyond = [&](SimplexIndex t, NodeIndex corner) {
    std::size_t k = 0;
    while (mesh_.node[t][k] != corner) ++k;
    return mesh_.neighbour[t][k];
  };
  Ring ring;
  SimplexIndex first = start;
  do { // back to the convex hull, if it is there
    const SimplexIndex last = beyond(first, others(mesh_.node[first], d, e)[1]);
    if (!exists(last)) break;
    first = last;
  } while (first != start);
  for (SimplexIndex t = first; exists(t);) {
    const auto [p, q] = others(mesh_.node[t], d, e);
    ring.tetrahedra.push_back(t);
    ring.around.push_back(p);
    t = beyond(t, p);
    if (t == first) {
      ring.closed = true;
      return ring;
    }
    if (!exists(t)) ring.around.push_back(q);
  }
  return ring;
}

std::vector<SimplexIndex> FlipMesh::replace(std::span<const SimplexIndex> old, std::span<const Nodes> fresh) {
  struct Side {
    std::array<NodeIndex, 3> face;
    SimplexIndex tetrahedron; ///< that has it
    std::size_t k;
  };
  std::vector<Side> sides; // of what is around the hole, then of what is in it; none: convex hull
  for (const SimplexIndex t : old)
    for (std::size_t k = 0; k < 4; ++k) {
      const SimplexIndex next = mesh_.neighbour[t][k];
      if (std::find(old.begin(), old.end(), next) != old.end()) continue;
      std::size_t back = 0;
      if (exists(next))
        while (mesh_.neighbour[next][back] != t) ++back;
      sides.push_back({sorted_face(mesh_.node[t], k), next, back});
    }
  gaps_.insert(gaps_.end(), old.rbegin(), old.rend());
  for (const SimplexIndex t : old) mesh_.node[t].fill(NodeIndex::none);

  std::vector<SimplexIndex> made;
  for (const Nodes& node : fresh) {
    SimplexIndex t = mesh_.node.next();
    if (gaps_.empty()) {
      mesh_.node.push_back(node);
      mesh_.neighbour.emplace_back();
    } else {
      t = gaps_.back();
      gaps_.pop_back();
      mesh_.node[t] = node;
    }
    mesh_.neighbour[t].fill(SimplexIndex::none);
    made.push_back(t);
    stars_.placed(t);
    for (std::size_t k = 0; k < 4; ++k) {
      const auto face = sorted_face(node, k);
      const auto other =
          std::find_if(sides.begin(), sides.end(), [&](const Side& s) { return s.face == face; });
      if (other == sides.end()) {
        sides.push_back({face, t, k});
        continue;
      }
      mesh_.neighbour[t][k] = other->tetrahedron;
      if (exists(other->tetrahedron)) mesh_.neighbour[other->tetrahedron][other->k] = t;
      *other = sides.back();
      sides.pop_back();
    }
  }
  // what is left was or is on the convex hull
  assert(std::all_of(sides.begin(), sides.end(), [&](const Side& s) {
    return !exists(s.tetrahedron) || !exists(mesh_.neighbour[s.tetrahedron][s.k]);
  }));
  return made;
}

void FlipMesh::finish() {
  IndexedVector<SimplexIndex, SimplexIndex> number(mesh_.node.size(), SimplexIndex::none);
  SimplexIndex next{};
  for (const SimplexIndex t : mesh_.node.indices())
    if (exists(mesh_.node[t][0])) number[t] = std::exchange(next, as<SimplexIndex>(index_of(next) + 1));
  for (const SimplexIndex t : number.indices()) {
    if (!exists(number[t])) continue;
    mesh_.node[number[t]] = mesh_.node[t];
    for (std::size_t k = 0; k < 4; ++k) {
      const SimplexIndex across = mesh_.neighbour[t][k];
      mesh_.neighbour[number[t]][k] = exists(across) ? number[across] : SimplexIndex::none;
    }
  }
  mesh_.node.resize(index_of(next));
  mesh_.neighbour.resize(index_of(next));
}

} // namespace cnem::voronoi
