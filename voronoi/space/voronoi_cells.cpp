#include "voronoi/space/voronoi_cells.hpp"

#include "core/error.hpp"
#include "core/geometry/facets.hpp"
#include "core/geometry/place_text.hpp"
#include "core/machine/parallel.hpp"
#include "voronoi/space/median_cells.hpp"

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <utility>

namespace cnem::voronoi {
namespace {

Vec<3> middle_of(const Cloud<3>& cloud, const std::array<NodeIndex, 2>& end) {
  return 0.5 * (cloud.position[end[0]] + cloud.position[end[1]]);
}

bool is_open(std::span<const DualPointIndex> ring, const Cloud<3>& cloud, const DualPoints& points) {
  return index_of(ring.front()) >= points.place.size() - cloud.facets.size();
}

/// Calls body(p, q) for the dual points of each triangle of a fan.
template<class Body>
void for_each_triangle(const Cloud<3>& cloud, const VoronoiCells& cells, EdgeIndex edge, Body&& body) {
  const auto ring = cells.rings.of(edge);
  for (std::size_t k = 0; k + 1 < ring.size(); ++k) body(ring[k], ring[k + 1]);
  if (!is_open(ring, cloud, cells.points)) body(ring.back(), ring.front());
}

void set_volumes(const Cloud<3>& cloud, const IndexedVector<EdgeIndex, Vec<3>>& normal, VoronoiCells& cells) {
  cells.volume.assign(cloud.position.size(), 0.0);
  for (const EdgeIndex e : normal.indices()) {
    const auto& [a, b] = cells.rings.end[e];
    const double of_both = normal[e].dot(cloud.position[b] - cloud.position[a]);
    cells.volume[index_of(a)] += of_both;
    cells.volume[index_of(b)] += of_both;
  }
  for (double& volume : cells.volume) volume /= 6.0;
}

/// [cell] a quarter of the volumes of its tetrahedra, m³.
Field median_volumes(const Cloud<3>& cloud, const Tetrahedra& mesh) {
  Field volume(cloud.position.size(), 0.0);
  for (const auto& node : mesh.node) {
    const double quarter = 0.25 * measure<3>({cloud.position[node[0]], cloud.position[node[1]],
                                              cloud.position[node[2]], cloud.position[node[3]]});
    for (const NodeIndex i : node) volume[index_of(i)] += quarter;
  }
  return volume;
}

/// Draws in the points round cells that are too small; false when there is none.
bool draw_in_small_cells(const Cloud<3>& cloud, const Tetrahedra& mesh, const Field& median,
                         IndexedVector<EdgeIndex, Vec<3>>& normal, VoronoiCells& cells) {
  constexpr double least = 0.15;
  std::vector<std::uint8_t> small(cells.volume.size());
  bool any = false;
  for (std::size_t i = 0; i < small.size(); ++i) {
    small[i] = !(cells.volume[i] >= least * median[i]);
    any = any || small[i];
  }
  if (!any) return false;
  const auto is_small = [&](NodeIndex i) { return small[index_of(i)] != 0; };
  IndexedVector<DualPointIndex, std::uint8_t> drawn(cells.points.place.size());
  for (const SimplexIndex t : mesh.node.indices())
    if (std::any_of(mesh.node[t].begin(), mesh.node[t].end(), is_small)) {
      draw_in(cloud, mesh, cells.points, t);
      drawn[dual_point_of(t)] = 1;
    }
  for (const EdgeIndex e : cells.rings.end.indices()) {
    const auto ring = cells.rings.of(e);
    if (std::any_of(ring.begin(), ring.end(), [&](DualPointIndex p) { return drawn[p] != 0; }))
      normal[e] = facet_normal(cloud, cells, e);
  }
  set_volumes(cloud, normal, cells);
  return true;
}

} // namespace

Vec<3> facet_normal(const Cloud<3>& cloud, const VoronoiCells& cells, EdgeIndex edge) {
  const Vec<3> middle = middle_of(cloud, cells.rings.end[edge]);
  Vec<3> sum = Vec<3>::Zero();
  for_each_triangle(cloud, cells, edge, [&](DualPointIndex p, DualPointIndex q) {
    sum += (cells.points.place[p] - middle).cross(cells.points.place[q] - middle);
  });
  return 0.5 * sum;
}

CellLists<NodeIndex> neighbours(std::size_t cells, const EdgeRings& rings) {
  CellLists<NodeIndex> lists = other_ends(cells, rings.end);
  for (std::size_t i = 0; i < cells; ++i) {
    const auto list = lists.of(i);
    if (std::adjacent_find(list.begin(), list.end()) == list.end()) continue;
    auto edges = static_cast<const std::vector<std::array<NodeIndex, 2>>&>(rings.end);
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    return other_ends(cells, edges);
  }
  return lists;
}

VoronoiCells voronoi_cells(const Cloud<3>& cloud, const Tetrahedra& mesh, const Circumspheres& spheres) {
  VoronoiCells cells;
  cells.points = dual_points(cloud, mesh, spheres);
  cells.rings = edge_rings(mesh);
  const std::size_t edges = cells.rings.end.size(), nodes = cloud.position.size();
  IndexedVector<EdgeIndex, Vec<3>> normal(edges);
  for_each_block(edges, [&](std::size_t begin, std::size_t end) {
    for (std::size_t e = begin; e < end; ++e) normal[e] = facet_normal(cloud, cells, as<EdgeIndex>(e));
  });
  set_volumes(cloud, normal, cells);

  const Field median = median_volumes(cloud, mesh);
  for (std::size_t i = 0; i < nodes; ++i)
    if (!(median[i] > 0.0))
      throw GeometryError("the tetrahedra of the node at " + place_text(cloud.position[i]) +
                          " m have no volume");
  constexpr int most_halvings = 60;
  for (int n = 0; draw_in_small_cells(cloud, mesh, median, normal, cells); ++n)
    if (n == most_halvings)
      throw GeometryError(
          "cells stay without volume wherever their points are put: nodes are on one plane to "
          "rounding");
  return cells;
}

void facet_polygon(const Cloud<3>& cloud, const VoronoiCells& cells, EdgeIndex edge,
                   std::vector<Vec<3>>& polygon) {
  const auto ring = cells.rings.of(edge);
  polygon.clear();
  for (const DualPointIndex p : ring) polygon.push_back(cells.points.place[p]);
  if (is_open(ring, cloud, cells.points)) polygon.push_back(middle_of(cloud, cells.rings.end[edge]));
}

CellComplex<3> cell_complex(const Cloud<3>& cloud, const Tetrahedra& mesh, const VoronoiCells& cells) {
  CellComplex<3> complex;
  complex.volume = cells.volume;
  complex.boundary = thirds_of_facets(cloud);
  complex.neighbours = neighbours(cloud.position.size(), cells.rings);
  complex.interior.reserve(cells.rings.point.size());
  const std::size_t tetrahedra = mesh.node.size();
  const auto holder = [&](DualPointIndex p) {
    return index_of(p) < tetrahedra ? cells.points.holder[index_of(p)] : SimplexIndex::none;
  };
  for (const EdgeIndex e : cells.rings.end.indices()) {
    const Vec<3> middle = middle_of(cloud, cells.rings.end[e]);
    for_each_triangle(cloud, cells, e, [&](DualPointIndex p, DualPointIndex q) {
      complex.interior.push_back({cells.rings.end[e],
                                  {holder(p), holder(q)},
                                  {middle, cells.points.place[p], cells.points.place[q]}});
    });
  }
  assert(is_closed<3>(cloud, complex));
  return complex;
}

} // namespace cnem::voronoi
