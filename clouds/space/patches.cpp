#include "clouds/space/patches.hpp"

#include "clouds/generate_interior.hpp"
#include "core/index.hpp"
#include "voronoi/plane/edge_tree.hpp"
#include "voronoi/plane/triangulation.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace cnem::clouds {

double curved_spacing(double h, double radius) {
  constexpr double full_turn = 2.0 * std::numbers::pi;
  return std::min(h, std::max(radius * full_turn / 18.0, std::min(0.6 * h, radius * full_turn / 8.0)));
}

std::int32_t SurfaceBuilder::add(const Vec3& x) {
  cloud_.position.push_back(x);
  return as<std::int32_t>(cloud_.position.size()) - 1;
}

PieceIndex SurfaceBuilder::piece(const std::string& name) {
  const auto found = std::ranges::find(cloud_.piece_names, name);
  const auto piece = as<PieceIndex>(found - cloud_.piece_names.begin());
  if (found == cloud_.piece_names.end()) cloud_.piece_names.push_back(name);
  return piece;
}

std::vector<double> SurfaceBuilder::divide(const std::function<Vec3(double)>& curve, double length,
                                           double radius, double turn) const {
  const auto wanted = [&](double s) { return curved_spacing(spacing_.at(curve(s)), radius); };
  std::vector<double> s{0.0}, sum{0.0};
  if (spacing_.uniform()) {
    s.push_back(1.0);
    sum.push_back(length / wanted(0.0));
  }
  while (s.back() < 1.0) { // h changes by at most its growth (≤ 1) times the step
    const double step = std::min({0.2 * wanted(s.back()) / length, 1.0 / 8.0, 1.0 - s.back()});
    sum.push_back(sum.back() + step * length / wanted(s.back() + 0.5 * step));
    s.push_back(1.0 - s.back() - step < 1e-9 ? 1.0 : s.back() + step);
  }
  const bool curved = std::isfinite(radius);
  const double edges = curved ? std::ceil(sum.back() - 1e-6) : std::round(sum.back());
  const double least = std::ceil(8.0 * std::abs(turn) / (2.0 * std::numbers::pi) - 1e-6);
  const int count = static_cast<int>(std::max({edges, curved ? least : 1.0, 1.0}));
  std::vector<double> nodes{0.0};
  std::size_t interval = 1;
  for (int k = 1; k < count; ++k) {
    const double share = sum.back() * k / count;
    while (sum[interval] < share) ++interval;
    const double f = (share - sum[interval - 1]) / (sum[interval] - sum[interval - 1]);
    nodes.push_back(s[interval - 1] + f * (s[interval] - s[interval - 1]));
  }
  nodes.push_back(1.0);
  return nodes;
}

Cloud<3> SurfaceBuilder::take() {
  IndexedVector<NodeIndex, NodeIndex> number(cloud_.position.size(), NodeIndex::none);
  IndexedVector<NodeIndex, Vec3> used;
  for (Facet<3>& facet : cloud_.facets)
    for (NodeIndex& i : facet.node) {
      if (!exists(number[i])) {
        number[i] = used.next();
        used.push_back(cloud_.position[i]);
      }
      i = number[i];
    }
  cloud_.position = std::move(used);
  return std::move(cloud_);
}

void SurfaceBuilder::add_patch(const Patch& patch) {
  Cloud<2> plane;
  plane.piece_names = {"loop"};
  Polyline vertex; // [node of the plane]
  std::map<std::pair<double, double>, NodeIndex> seen;
  for (const PatchLoop& loop : patch.loops) {
    const std::size_t first = vertex.size(), count = loop.vertex.size();
    for (std::size_t k = 0; k < count; ++k) {
      const NodeIndex node = plane.position.next();
      const auto [twin, fresh] = seen.try_emplace({loop.place[k].x(), loop.place[k].y()}, node);
      if (!fresh) plane.twins.push_back({twin->second, node});
      plane.position.push_back(loop.place[k]);
      plane.facets.push_back({{node, as<NodeIndex>(first + (k + 1) % count)}, PieceIndex{0}});
      vertex.push_back(loop.vertex[k]);
    }
  }
  const voronoi::EdgeTree tree(plane);
  std::vector<Vec2> interior = patch.spacing.uniform()
                                   ? lattice_nodes(plane, tree, patch.spacing.spacing, Pattern::hexagonal)
                                   : front_nodes(plane, tree, patch.spacing);
  smooth_nodes(plane, tree, patch.spacing, interior);
  // Nodes that mirror each other at an edge would be four on a circle, and a flat tetrahedron.
  jitter_nodes(tree, patch.spacing, 0.08, 1 + cloud_.facets.size(), interior);
  for (const Vec2& x : interior) {
    plane.position.push_back(x);
    vertex.push_back(add(patch.on_surface(x)));
  }
  for (const auto& corner : voronoi::triangulate(plane).node) {
    Facet<3> facet{{}, patch.piece};
    for (std::size_t k = 0; k < 3; ++k) facet.node[k] = as<NodeIndex>(vertex[index_of(corner[k])]);
    if (patch.turned) std::swap(facet.node[1], facet.node[2]);
    cloud_.facets.push_back(facet);
  }
}

} // namespace cnem::clouds
