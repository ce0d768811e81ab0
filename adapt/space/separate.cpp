#include "adapt/space/separate.hpp"

#include "adapt/space/boundary_planes.hpp"
#include "core/geometry/facets.hpp"
#include "core/index.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace cnem::adapt {
namespace {

using voronoi::face_of_tetrahedron;
using voronoi::Tetrahedra;
using Parts = IndexedVector<SimplexIndex, std::int32_t>;

/// Which double of its corners a tetrahedron takes, [tetrahedron][corner]; 0: the node itself.
using Doubles = IndexedVector<SimplexIndex, std::array<NodeIndex, 4>>;

std::size_t corner_of(const Tetrahedra& mesh, SimplexIndex t, NodeIndex i) {
  const auto& node = mesh.node[t];
  return static_cast<std::size_t>(std::find(node.begin(), node.end(), i) - node.begin());
}

/// The tetrahedra around a node in sets that faces at the node connect within a part; the largest first, and
/// of equal ones that of the first tetrahedron.
std::vector<std::vector<SimplexIndex>> sets_around(const Cloud<3>& cloud, const SpaceStructure& structure,
                                                   const Parts& part, NodeIndex i) {
  const Tetrahedra& mesh = structure.mesh;
  const auto around = structure.tetrahedra.of(i);
  std::vector<char> seen(around.size(), 0);
  std::vector<std::vector<SimplexIndex>> sets;
  for (std::size_t first = 0; first < around.size(); ++first) {
    if (seen[first]) continue;
    seen[first] = 1;
    std::vector<SimplexIndex> set{around[first]};
    for (std::size_t n = 0; n < set.size(); ++n) {
      const std::size_t own = corner_of(mesh, set[n], i);
      for (std::size_t k = 0; k < 4; ++k) {
        const SimplexIndex next = mesh.neighbour[set[n]][k];
        if (k == own || !exists(next) || part[next] != part[set[n]]) continue;
        const auto place = std::lower_bound(around.begin(), around.end(), next) - around.begin();
        if (seen[index_of(place)]) continue;
        seen[index_of(place)] = 1;
        set.push_back(next);
      }
    }
    sets.push_back(std::move(set));
  }
  const auto volume = [&](const std::vector<SimplexIndex>& set) {
    double sum = 0.0;
    for (const SimplexIndex t : set) sum += volume_of(cloud, mesh.node[t]);
    return sum;
  };
  if (!sets.empty()) {
    const auto largest = std::max_element(
        sets.begin(), sets.end(), [&](const auto& a, const auto& b) { return volume(a) < volume(b); });
    std::rotate(sets.begin(), largest, largest + 1);
  }
  return sets;
}

/// Moves the doubles apart: against the mean normal of the new facets at each, within its other facets. Where
/// these leave no way, as on a rough surface, within those of plane pieces alone.
void set_apart(WorkingBody& body, std::size_t first_new, const std::vector<NodeIndex>& moved, double gap,
               const BoundaryPlanes& planes) {
  const Cloud<3>& cloud = body.cloud();
  IndexedVector<NodeIndex, Vec3> normal(body.size(), Vec3::Zero());
  IndexedVector<NodeIndex, std::vector<CloudFacetIndex>> kept(body.size());
  for (const CloudFacetIndex f : cloud.facets.indices()) {
    const Vec3 n = area_normal<3>(corners_of<3>(cloud.facets[f], cloud.position));
    for (const NodeIndex i : cloud.facets[f].node) {
      if (index_of(f) >= first_new)
        normal[i] += n;
      else
        kept[i].push_back(f);
    }
  }
  std::vector<Vec3> place;
  for (const NodeIndex i : moved) {
    const Vec3 straight = normal[i].norm() > 0.0 ? Vec3(-normal[i].normalized()) : Vec3::Zero();
    Vec3 way = straight;
    constexpr int times = 3; // where facets meet at an angle
    for (int n = 0; n < times; ++n)
      for (const CloudFacetIndex f : kept[i]) {
        const Vec3 other = area_normal<3>(corners_of<3>(cloud.facets[f], cloud.position)).normalized();
        way -= other * other.dot(way);
      }
    constexpr double least = 0.1;
    if (way.norm() < least) way = straight;
    place.push_back(body.at(i) + 0.5 * gap * body.spacing(i) * planes.keep(kept[i], way));
  }
  for (std::size_t n = 0; n < moved.size(); ++n) body.place(moved[n], place[n]);
}

/// Between faces of tetrahedra a cut has teeth as long as their edges: nodes of it go to the mean of their
/// neighbours on it, on the boundary to that of those there, within its facets, as far as no tetrahedron
/// loses most of its volume.
void smooth_cut(WorkingBody& body, const SpaceStructure& structure, const Parts& part,
                const BoundaryPlanes& planes) {
  const Tetrahedra& mesh = structure.mesh;
  const Cloud<3>& cloud = body.cloud();
  std::vector<std::array<NodeIndex, 2>> edges;
  IndexedVector<NodeIndex, std::vector<Vec3>> kept(body.size());
  IndexedVector<NodeIndex, char> on_cut(body.size(), 0);
  for (const SimplexIndex t : mesh.node.indices())
    for (std::size_t k = 0; k < 4; ++k) {
      if (exists(mesh.facet[t][k]) || part[mesh.neighbour[t][k]] == part[t]) continue;
      for (std::size_t c = 0; c < 3; ++c) {
        const NodeIndex a = mesh.node[t][face_of_tetrahedron[k][c]],
                        b = mesh.node[t][face_of_tetrahedron[k][(c + 1) % 3]];
        on_cut[a] = 1;
        edges.push_back({std::min(a, b), std::max(a, b)});
      }
    }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  for (const auto& facet : cloud.facets) {
    const Vec3 n = area_normal<3>(corners_of<3>(facet, cloud.position)).normalized();
    for (const NodeIndex i : facet.node)
      if (on_cut[i]) kept[i].push_back(n);
  }
  const CellLists<NodeIndex> beside = other_ends(body.size(), edges);
  std::vector<double> least; // volumes that tetrahedra keep, m³
  constexpr double most_lost = 0.7;
  for (const auto& node : mesh.node) least.push_back((1.0 - most_lost) * volume_of(cloud, node));
  const IndexedVector<NodeIndex, Vec3> start = cloud.position;
  constexpr double farthest_off = 0.01; // how far nodes may leave their facets, which the tools are beside
  const auto off = [&](NodeIndex i, const Vec3& x) {
    double most = 0.0;
    for (const Vec3& normal : kept[i]) most = std::max(most, std::abs(normal.dot(x - start[i])));
    return most;
  };
  constexpr int times = 5;
  for (int n = 0; n < times; ++n)
    for (const NodeIndex i : body.nodes()) {
      if (!on_cut[i] || body.held(i)) continue;
      const Vec3 from = body.at(i);
      Vec3 sum = Vec3::Zero();
      double count = 0.0;
      for (const NodeIndex k : beside.of(i))
        if (kept[i].empty() || !kept[k].empty()) {
          sum += body.at(k);
          count += 1.0;
        }
      if (count < 2.0) continue;
      Vec3 way = 0.5 * (sum / count - from);
      constexpr int projections = 3;
      for (int m = 0; m < projections; ++m)
        for (const Vec3& normal : kept[i]) way -= normal * normal.dot(way);
      const Vec3 to = from + planes.keep(i, way);
      if (off(i, to) > farthest_off * body.spacing(i)) continue;
      body.place(i, to);
      for (const SimplexIndex t : structure.tetrahedra.of(i))
        if (volume_of(cloud, mesh.node[t]) < least[index_of(t)]) {
          body.place(i, from);
          break;
        }
    }
}

} // namespace

void separate(WorkingBody& body, const SpaceStructure& structure, const SeparationRules& rules,
              PassReport& report) {
  if (body.node().broken.empty()) return;
  const Parts part = parts_between(body.cloud(), structure.mesh, body.node().broken, rules.least_part);
  if (part.empty()) return;
  const Tetrahedra& mesh = structure.mesh;
  const Cloud<3> before = body.cloud(); // whose volumes share matter out
  const BoundaryPlanes planes(before, Plane::piece);
  smooth_cut(body, structure, part, planes);

  Doubles corner = mesh.node;
  std::vector<Parcel> parcels;
  std::vector<NodeIndex> moved;
  for (const NodeIndex i : before.position.indices()) {
    const auto sets = sets_around(before, structure, part, i);
    if (sets.size() < 2) continue;
    double all = 0.0;
    for (const auto& set : sets)
      for (const SimplexIndex t : set) all += volume_of(before, mesh.node[t]);
    moved.push_back(i);
    for (std::size_t s = 1; s < sets.size(); ++s) {
      const NodeIndex made = body.double_node(i);
      double own = 0.0;
      for (const SimplexIndex t : sets[s]) {
        corner[t][corner_of(mesh, t, i)] = made;
        own += volume_of(before, mesh.node[t]);
      }
      parcels.push_back({i, made, own / all});
      moved.push_back(made);
    }
  }
  assert(!moved.empty());

  IndexedVector<CloudFacetIndex, Facet<3>> facets = before.facets;
  IndexedVector<CloudFacetIndex, Facet<3>> opened;
  for (const SimplexIndex t : mesh.node.indices())
    for (std::size_t k = 0; k < 4; ++k) {
      const auto& face = face_of_tetrahedron[k];
      const std::array<NodeIndex, 3> now{corner[t][face[0]], corner[t][face[1]], corner[t][face[2]]};
      if (const CloudFacetIndex f = mesh.facet[t][k]; exists(f)) {
        for (NodeIndex& i : facets[f].node)
          for (std::size_t c = 0; c < 3; ++c)
            if (mesh.node[t][face[c]] == before.facets[f].node[index_of(&i - facets[f].node.data())])
              i = now[c];
      } else if (part[mesh.neighbour[t][k]] != part[t]) {
        opened.push_back({now, rules.piece});
      }
    }
  const std::size_t first_new = facets.size();
  facets.insert(facets.end(), opened.begin(), opened.end());
  body.set_boundary(std::move(facets));
  body.move(parcels);
  set_apart(body, first_new, moved, rules.gap, planes);

  report.cuts += *std::max_element(part.begin(), part.end());
  report.opened += static_cast<int>(opened.size() / 2);
}

} // namespace cnem::adapt
