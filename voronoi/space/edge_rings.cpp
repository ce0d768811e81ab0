#include "voronoi/space/edge_rings.hpp"

#include "core/machine/parallel.hpp"

#include <algorithm>
#include <cassert>

namespace cnem::voronoi {
namespace {

/// A tetrahedron with an edge: going round counter-clockwise the way in is across from corner `out`, the way
/// on from corner `in`.
struct Step {
  SimplexIndex tetrahedron;
  std::size_t in, out;
};

std::size_t index_in(const auto& list, auto item) {
  const std::size_t k = list[0] == item ? 0 : list[1] == item ? 1 : list[2] == item ? 2 : 3;
  assert(list[k] == item);
  return k;
}

/// The next one; there has to be one.
Step following(const Tetrahedra& mesh, const Step& at) {
  const SimplexIndex next = mesh.neighbour[at.tetrahedron][at.in];
  return {next, index_in(mesh.node[next], mesh.node[at.tetrahedron][at.out]),
          index_in(mesh.neighbour[next], at.tetrahedron)};
}

struct Block {
  std::vector<std::array<NodeIndex, 2>> end;
  std::vector<std::int32_t> size;
  std::vector<DualPointIndex> point;
};

/// Adds the ring of an edge of tetrahedron `start.tetrahedron` when it begins there.
void add_ring(const Tetrahedra& mesh, const std::array<NodeIndex, 2>& end, const Step& start, Block& block) {
  const std::size_t first = block.point.size();
  const CloudFacetIndex behind = mesh.facet[start.tetrahedron][start.out];
  const bool open = exists(behind);
  if (open) block.point.push_back(dual_point_of(mesh, behind));
  block.point.push_back(dual_point_of(start.tetrahedron));
  for (Step at = start;;) {
    const CloudFacetIndex ahead = mesh.facet[at.tetrahedron][at.in];
    if (exists(ahead)) {
      if (!open) return block.point.resize(first); // it begins elsewhere
      block.point.push_back(dual_point_of(mesh, ahead));
      break;
    }
    at = following(mesh, at);
    if (at.tetrahedron == start.tetrahedron) break;
    if (!open && at.tetrahedron < start.tetrahedron) return block.point.resize(first);
    block.point.push_back(dual_point_of(at.tetrahedron));
  }
  block.end.push_back(end);
  block.size.push_back(static_cast<std::int32_t>(block.point.size() - first));
}

} // namespace

EdgeRings edge_rings(const Tetrahedra& mesh) {
  const std::size_t count = mesh.node.size();
  std::vector<Block> list(blocks(count));
  for_each_block(count, [&](std::size_t begin, std::size_t end) {
    Block& block = list[begin / block_size];
    for (std::size_t k = begin; k < end; ++k) {
      const auto t = as<SimplexIndex>(k);
      for (auto [a, b, in, out] : edges_of_tetrahedron) {
        // the faces across from `in` and `out` are those ahead and behind
        if (mesh.node[t][a] > mesh.node[t][b]) {
          std::swap(a, b);
          std::swap(in, out);
        }
        add_ring(mesh, {mesh.node[t][a], mesh.node[t][b]}, {t, in, out}, block);
      }
    }
  });

  EdgeRings rings;
  std::size_t edges = 0, points = 0;
  for (const Block& block : list) {
    edges += block.end.size();
    points += block.point.size();
  }
  rings.end.reserve(edges);
  rings.begin.reserve(edges + 1);
  rings.point.reserve(points);
  rings.begin.push_back(0);
  for (const Block& block : list) {
    rings.end.insert(rings.end.end(), block.end.begin(), block.end.end());
    rings.point.insert(rings.point.end(), block.point.begin(), block.point.end());
    for (const std::int32_t size : block.size) rings.begin.push_back(rings.begin.back() + size);
  }
  return rings;
}

} // namespace cnem::voronoi
