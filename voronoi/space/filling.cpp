#include "voronoi/space/filling.hpp"

#include "core/error.hpp"
#include "core/geometry/facets.hpp"
#include "core/index.hpp"
#include "voronoi/space/facet_flips.hpp"
#include "voronoi/space/flat_flips.hpp"
#include "voronoi/space/opened.hpp"
#include "voronoi/space/surface.hpp"

#include <algorithm>
#include <cassert>
#include <fmt/format.h>
#include <utility>

namespace cnem::voronoi {

namespace {

/// [new corner] old corner, so that the lowest node is first: even permutations.
constexpr std::array<std::array<std::size_t, 4>, 4> from_corner = {
    {{0, 1, 2, 3}, {1, 0, 3, 2}, {2, 3, 0, 1}, {3, 2, 1, 0}}};

/// An even permutation that puts the lowest node first and the next lowest second.
std::array<std::size_t, 4> canonical(const std::array<NodeIndex, 4>& node) {
  const auto low = std::min_element(node.begin(), node.end()) - node.begin();
  auto order = from_corner[index_of(low)];
  while (node[order[1]] > node[order[2]] || node[order[1]] > node[order[3]])
    order = {order[0], order[2], order[3], order[1]};
  return order;
}

[[noreturn]] void throw_flat(const Cloud<3>& cloud, const std::array<NodeIndex, 4>& node) {
  throw GeometryError(
      fmt::format("{}, {}, {} and {}, which two facets join, are on one plane to rounding: the "
                  "boundary has to be recovered first",
                  describe_node(cloud, node[0]), describe_node(cloud, node[1]), describe_node(cloud, node[2]),
                  describe_node(cloud, node[3])));
}

[[noreturn]] void throw_lost(const Cloud<3>& cloud, const std::vector<CloudFacetIndex>& lost) {
  throw GeometryError(fmt::format("{} of {} facets are no faces of Delaunay tetrahedra, the first {}: the "
                                  "boundary has to be recovered first",
                                  lost.size(), cloud.facets.size(), describe_facet(cloud, lost.front())));
}

} // namespace

bool is_flat(const std::array<Vec3, 4>& x) {
  double longest = 0.0, size = 0.0;
  for (std::size_t a = 0; a < 4; ++a) {
    size = std::max(size, x[a].cwiseAbs().maxCoeff());
    for (std::size_t b = 0; b < a; ++b) longest = std::max(longest, (x[a] - x[b]).squaredNorm());
  }
  constexpr double rounding = 1e-10; // of the length, and places are known to about 1e-15 of their distance
  return 6.0 * measure<3>(x) <= longest * (rounding * std::sqrt(longest) + 1e-14 * size);
}

namespace {

Tetrahedra numbered(const Cloud<3>& cloud, const Delaunay& mesh, const Walls& walls,
                    const IndexedVector<SimplexIndex, std::uint8_t>& inside) {
  const auto own = own_nodes(cloud, mesh, walls, inside);

  struct Entry {
    std::array<NodeIndex, 4> node;
    SimplexIndex from;
  };
  std::vector<std::uint32_t> begin(cloud.position.size() + 2, 0);
  for (const SimplexIndex t : own.indices())
    if (inside[t]) ++begin[index_of(*std::min_element(own[t].begin(), own[t].end())) + 2];
  for (std::size_t i = 2; i < begin.size(); ++i) begin[i] += begin[i - 1];
  std::vector<Entry> entries(begin.back());
  for (const SimplexIndex t : own.indices()) {
    if (!inside[t]) continue;
    const auto order = canonical(own[t]);
    const std::array node{own[t][order[0]], own[t][order[1]], own[t][order[2]], own[t][order[3]]};
    entries[begin[index_of(node[0]) + 1]++] = {node, t};
  }
  for (std::size_t i = 0; i + 2 < begin.size(); ++i)
    std::sort(entries.begin() + begin[i], entries.begin() + begin[i + 1],
              [](const Entry& a, const Entry& b) { return a.node < b.node; });

  IndexedVector<SimplexIndex, SimplexIndex> number(own.size(), SimplexIndex::none);
  for (std::size_t n = 0; n < entries.size(); ++n) number[entries[n].from] = as<SimplexIndex>(n);

  Tetrahedra result;
  result.node.resize(entries.size());
  result.neighbour.resize(entries.size());
  result.facet.resize(entries.size());
  result.of_node.assign(cloud.position.size(), SimplexIndex::none);
  for (const SimplexIndex t : result.node.indices()) {
    const SimplexIndex from = entries[index_of(t)].from;
    const auto order = canonical(own[from]);
    int facets = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      const bool wall = walls.blocked[from] >> order[k] & 1U;
      result.node[t][k] = own[from][order[k]];
      result.facet[t][k] = walls.facet[from][order[k]];
      result.neighbour[t][k] = wall ? SimplexIndex::none : number[mesh.neighbour[from][order[k]]];
      if (!exists(result.of_node[result.node[t][k]])) result.of_node[result.node[t][k]] = t;
      facets += wall;
    }
    const auto& node = result.node[t];
    if (facets > 1 && is_flat({cloud.position[node[0]], cloud.position[node[1]], cloud.position[node[2]],
                               cloud.position[node[3]]}))
      throw_flat(cloud, node);
  }
  for (const NodeIndex i : cloud.position.indices())
    if (!exists(result.of_node[i]))
      throw GeometryError(fmt::format("{} lies outside the domain", describe_node(cloud, i)));
  return result;
}

} // namespace

Filling filling(const Cloud<3>& cloud, Delaunay mesh) {
  Walls walls = find_walls(cloud, mesh);
  if (!walls.lost.empty()) {
    if (auto held = filling_at_once(cloud, mesh, walls)) return std::move(*held);
    if (auto opened = filling_of_opened(cloud, walls.lost)) return std::move(*opened);
  }
  return held_filling(cloud, std::move(mesh), std::move(walls));
}

std::optional<Filling> filling_at_once(const Cloud<3>& cloud, const Delaunay& mesh, const Walls& walls) {
  constexpr std::size_t most = 20; // of all facets one, of those that are lost
  if (most * walls.lost.size() > cloud.facets.size()) return std::nullopt;
  try {
    Delaunay flipped = mesh;
    HeldFacets held = hold_facets(cloud, flipped, walls, 1);
    if (!held.at_once) return std::nullopt;
    Filling result = filling(cloud, std::move(flipped), std::move(held.walls));
    result.flipped = true;
    return result;
  } catch (const GeometryError&) { return std::nullopt; } // what the others say of it tells more
}

Filling held_filling(const Cloud<3>& cloud, Delaunay mesh, Walls walls) {
  const bool lost = !walls.lost.empty();
  if (lost) walls = hold_facets(cloud, mesh, std::move(walls)).walls;
  if (!walls.lost.empty()) throw_lost(cloud, walls.lost);
  Filling result = filling(cloud, std::move(mesh), std::move(walls));
  result.flipped = result.flipped || lost;
  return result;
}

Filling filling(const Cloud<3>& cloud, Delaunay mesh, Walls walls) {
  assert(walls.lost.empty());
  auto inside = inside_of_walls(cloud, mesh, walls);
  const bool flipped = exchange_flat(cloud, mesh, inside);
  if (flipped) {
    walls = find_walls(cloud, mesh);
    inside = inside_of_walls(cloud, mesh, walls);
  }
  return {numbered(cloud, mesh, walls, inside), flipped};
}

Tetrahedra in_order(const Cloud<3>& cloud, const Delaunay& inside) {
  const IndexedVector<SimplexIndex, std::uint8_t> all(inside.node.size(), 1);
  return numbered(cloud, inside, find_walls(cloud, inside), all);
}

} // namespace cnem::voronoi
