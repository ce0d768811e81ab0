#include "app/problem/bodies.hpp"
#include "contact/periods.hpp"
#include "core/error.hpp"
#include "core/geometry/mates.hpp"
#include "core/index.hpp"
#include "core/operators/resampling.hpp"

#include "voronoi/plane/triangulation.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <map>

namespace cnem::app {

namespace {

/// The part of the domain each node is in, by one of its nodes: parts are connected through triangles.
IndexedVector<NodeIndex, NodeIndex> parts(const Cloud<2>& cloud, const voronoi::Triangulation& mesh) {
  IndexedVector<NodeIndex, NodeIndex> root(cloud.position.size());
  for (const NodeIndex i : root.indices()) root[i] = i;
  const auto find = [&](NodeIndex i) {
    while (root[i] != i) i = root[i] = root[root[i]];
    return i;
  };
  for (const auto& [a, b, c] : mesh.node) {
    root[find(b)] = find(a);
    root[find(c)] = find(a);
  }
  for (const NodeIndex i : root.indices()) root[i] = find(i);
  return root;
}

/// A node of the triangle that holds the point, or of the nearest one.
NodeIndex node_at(const Cloud<2>& cloud, const voronoi::Triangulation& mesh, const Vec2& x) {
  NodeIndex best{};
  double depth = -std::numeric_limits<double>::infinity();
  for (const auto& triangle : mesh.node) {
    double inside = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec2 &a = cloud.position[triangle[k]], &b = cloud.position[triangle[(k + 1) % 3]];
      inside = std::min(inside, cross(b - a, x - a) / (b - a).norm());
    }
    if (inside > depth) depth = inside, best = triangle[0];
  }
  return best;
}

double distance_to(const std::vector<Vec2>& polyline, const Vec2& x) {
  double best = (x - polyline.front()).norm();
  for (std::size_t k = 1; k < polyline.size(); ++k) {
    const Vec2 along = polyline[k] - polyline[k - 1];
    const double s = std::clamp((x - polyline[k - 1]).dot(along) / along.squaredNorm(), 0.0, 1.0);
    best = std::min(best, (x - polyline[k - 1] - s * along).norm());
  }
  return best;
}

/// The length along a polyline up to its point nearest to x.
double arc_at(const std::vector<Vec2>& polyline, const Vec2& x) {
  double before = 0.0, arc = 0.0, nearest = std::numeric_limits<double>::infinity();
  for (std::size_t k = 1; k < polyline.size(); ++k) {
    const Vec2 along = polyline[k] - polyline[k - 1];
    const double s = std::clamp((x - polyline[k - 1]).dot(along) / along.squaredNorm(), 0.0, 1.0);
    if (const double distance = (x - polyline[k - 1] - s * along).norm(); distance < nearest) {
      nearest = distance;
      arc = before + s * along.norm();
    }
    before += along.norm();
  }
  return arc;
}

/// The nodes on the two faces of an interface, face + first.
std::vector<std::array<NodeIndex, 2>> face_pairs(const Cloud<2>& cloud, const std::string& name) {
  const std::vector<NodeIndex> left = nodes_of<2>(facets_of<2>(cloud, {name + "+"}));
  const std::vector<NodeIndex> right = nodes_of<2>(facets_of<2>(cloud, {name + "-"}));
  const auto on = [](const std::vector<NodeIndex>& face, NodeIndex node) {
    return std::binary_search(face.begin(), face.end(), node);
  };
  std::vector<std::array<NodeIndex, 2>> pairs;
  for (const auto& [a, b] : cloud.twins) {
    if (on(left, a) && on(right, b)) pairs.push_back({a, b});
    if (on(left, b) && on(right, a)) pairs.push_back({b, a});
  }
  return pairs;
}

template<int dim>
std::vector<std::array<NodeIndex, 2>> matching_nodes(const input::Case& input, const input::Periodicity& spec,
                                                     const Cloud<dim>& cloud) {
  try {
    return shifted_nodes(cloud, sides_of(spec, cloud));
  } catch (const GeometryError& error) {
    throw input.error(fmt::format("periodic.{}.pieces", spec.name),
                      fmt::format("{}, expected '{}' to be a shifted copy of '{}' with the same nodes",
                                  error.what(), spec.pieces[1], spec.pieces[0]));
  }
}

} // namespace

template<int dim>
std::vector<Facet<dim>> facets_of(const Cloud<dim>& cloud, const std::vector<std::string>& pieces) {
  IndexedVector<PieceIndex, bool> wanted(cloud.piece_names.size(), false);
  for (const PieceIndex p : cloud.piece_names.indices())
    for (const std::string& piece : pieces)
      if (const std::string& name = cloud.piece_names[p];
          name == piece || name == piece + "+" || name == piece + "-")
        wanted[p] = true;
  std::vector<Facet<dim>> facets;
  std::copy_if(cloud.facets.begin(), cloud.facets.end(), std::back_inserter(facets),
               [&](const Facet<dim>& facet) { return wanted[facet.piece]; });
  return facets;
}

template<int dim> std::vector<NodeIndex> nodes_of(const std::vector<Facet<dim>>& facets) {
  std::vector<NodeIndex> nodes;
  for (const Facet<dim>& facet : facets) nodes.insert(nodes.end(), facet.node.begin(), facet.node.end());
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

IndexedVector<NodeIndex, std::int32_t> region_of_nodes(const input::Case& input, const Cloud<2>& cloud) {
  const std::vector<input::Region>& regions = input.domain.regions;
  if (regions.empty()) return {};
  const voronoi::Triangulation mesh = voronoi::triangulate(cloud);
  const IndexedVector<NodeIndex, NodeIndex> part = parts(cloud, mesh);
  std::map<NodeIndex, std::int32_t> region_of_part;
  for (std::size_t r = 0; r < regions.size(); ++r) {
    const auto [entry, fresh] =
        region_of_part.emplace(part[node_at(cloud, mesh, regions[r].at)], as<std::int32_t>(r));
    if (!fresh)
      throw input.error("domain.regions." + regions[r].name,
                        fmt::format("lies in the same part of the domain as domain.regions.{}, expected an "
                                    "interface between them",
                                    regions[index_of(entry->second)].name));
  }
  IndexedVector<NodeIndex, std::int32_t> region(part.size(), -1);
  for (const NodeIndex i : part.indices())
    if (const auto found = region_of_part.find(part[i]); found != region_of_part.end())
      region[i] = found->second;
  return region;
}

template<int dim>
std::array<PieceIndex, 2> sides_of(const input::Periodicity& spec, const Cloud<dim>& cloud) {
  std::array<PieceIndex, 2> sides{};
  for (std::size_t k = 0; k < 2; ++k)
    sides[k] = pieces_of(std::span<const Facet<dim>>(facets_of<dim>(cloud, {spec.pieces[k]}))).front();
  return sides;
}

template<int dim> Pairs tied_pairs(const input::Case& input, const Cloud<dim>& cloud) {
  Pairs pairs;
  if constexpr (dim == 2)
    for (const input::Interface& interface : input.domain.interfaces) {
      if (interface.cohesive) continue;
      const auto faces = face_pairs(cloud, interface.name);
      const auto pieces = pieces_of<2>(facets_of<2>(cloud, {interface.name}));
      pairs.motion.insert(pairs.motion.end(), faces.begin(), faces.end());
      pairs.motion_pieces.insert(pairs.motion_pieces.end(), pieces.begin(), pieces.end());
      if (interface.conductance) continue;
      pairs.heat.insert(pairs.heat.end(), faces.begin(), faces.end());
      pairs.heat_pieces.insert(pairs.heat_pieces.end(), pieces.begin(), pieces.end());
    }
  for (const input::Periodicity& periodic : input.periodic) {
    const auto sides = matching_nodes(input, periodic, cloud);
    pairs.motion.insert(pairs.motion.end(), sides.begin(), sides.end());
    pairs.heat.insert(pairs.heat.end(), sides.begin(), sides.end());
    const auto pieces = sides_of(periodic, cloud);
    pairs.motion_pieces.insert(pairs.motion_pieces.end(), pieces.begin(), pieces.end());
    pairs.heat_pieces.insert(pairs.heat_pieces.end(), pieces.begin(), pieces.end());
  }
  return pairs;
}

contact::Repetition<3> repetition(const input::Case& input, const Cloud<3>& cloud) {
  contact::Repetition<3> repeated;
  for (const input::Periodicity& periodic : input.periodic) {
    const auto pieces = sides_of(periodic, cloud);
    repeated.sides.insert(repeated.sides.end(), pieces.begin(), pieces.end());
    const auto pairs = matching_nodes(input, periodic, cloud);
    Vec3 sum = Vec3::Zero();
    for (const auto& [a, b] : pairs) sum += cloud.position[b] - cloud.position[a];
    const Vec3 period = sum / static_cast<double>(pairs.size());
    if (!contact::add_period(repeated.period, period))
      throw input.error(
          fmt::format("periodic.{}.pieces", periodic.name),
          fmt::format("found sides {:.6g}, {:.6g}, {:.6g} m apart, expected a sum of multiples of "
                      "the periods before it, or one in a direction of its own",
                      period.x(), period.y(), period.z()));
  }
  return repeated;
}

void pair_facets(const input::Case& input, Cloud<2>& cloud) {
  if (!cloud.twins.empty()) pair_coincident_facets(cloud);
  for (const input::Periodicity& periodic : input.periodic)
    cnem::pair_facets(cloud, matching_nodes(input, periodic, cloud));
}

std::vector<CohesiveSpec> cohesive_specs(const input::Case& input, const Cloud<2>& cloud) {
  std::vector<CohesiveSpec> specs;
  for (const input::Interface& interface : input.domain.interfaces) {
    if (!interface.cohesive) continue;
    CohesiveSpec& spec = specs.emplace_back(CohesiveSpec{interface.name, *interface.cohesive});
    for (const PieceIndex p : cloud.piece_names.indices()) {
      if (cloud.piece_names[p] == interface.name + "+") spec.piece[0] = p;
      if (cloud.piece_names[p] == interface.name + "-") spec.piece[1] = p;
    }
    if (interface.open.empty()) continue;
    const double a = arc_at(interface.path, interface.open[0]), b = arc_at(interface.path, interface.open[1]);
    if (a == b)
      throw input.error(
          fmt::format("domain.interfaces.{}.cohesive.open", interface.name),
          "both points are nearest to the same place of the interface, expected a stretch of it");
    spec.open.push_back({std::min(a, b), std::max(a, b)});
  }
  return specs;
}

std::vector<ContactConductance<2>> conductances(const input::Case& input, const Cloud<2>& cloud) {
  std::vector<ContactConductance<2>> list;
  for (const input::Interface& interface : input.domain.interfaces) {
    if (!interface.conductance) continue;
    std::map<NodeIndex, NodeIndex> opposite;
    for (const auto& [a, b] : face_pairs(cloud, interface.name)) opposite[a] = b;
    ContactConductance<2> exchange{
        interface.name, *interface.conductance, facets_of<2>(cloud, {interface.name + "+"}), {}};
    for (const Facet<2>& facet : exchange.facets)
      exchange.opposite.push_back({opposite.at(facet.node[0]), opposite.at(facet.node[1])});
    list.push_back(std::move(exchange));
  }
  return list;
}

Field strength(const input::Case& input, const Cloud<2>& cloud) {
  if (input.initial.imperfections.empty()) return {};
  Field factor(index_of(cloud.nodes()), 1.0);
  for (const input::Imperfection& imperfection : input.initial.imperfections)
    for (std::size_t i = 0; i < factor.size(); ++i) {
      const double d = distance_to(imperfection.points, cloud.position[i]) / imperfection.width;
      factor[i] *= 1.0 - imperfection.reduction * std::exp(-d * d);
    }
  return factor;
}

template<int dim>
void set_initial_state(const input::Case& input, const Cloud<dim>& cloud,
                       const IndexedVector<NodeIndex, std::int32_t>& region, Fields<dim>& velocity,
                       Field& temperature) {
  const input::InitialState& initial = input.initial;
  resize_all(velocity, index_of(cloud.nodes()));
  temperature.assign(index_of(cloud.nodes()), initial.temperature);
  for (std::size_t i = 0; i < temperature.size(); ++i) {
    Vec<dim> v = initial.velocity.head<dim>();
    if constexpr (dim == 2) {
      if (!region.empty() && region[i] >= 0) {
        v = input.domain.regions[index_of(region[i])].velocity;
        temperature[i] = input.domain.regions[index_of(region[i])].temperature;
      }
      if (initial.spin) v += initial.spin->rate * left_normal(cloud.position[i] - initial.spin->centre);
      if (initial.gradient) v += initial.gradient->rate * (cloud.position[i] - initial.gradient->centre);
    }
    for (int k = 0; k < dim; ++k) velocity[index_of(k)][i] = v[k];
  }
}

template std::vector<Facet<2>> facets_of(const Cloud<2>&, const std::vector<std::string>&);
template std::vector<Facet<3>> facets_of(const Cloud<3>&, const std::vector<std::string>&);
template std::vector<NodeIndex> nodes_of(const std::vector<Facet<2>>&);
template std::vector<NodeIndex> nodes_of(const std::vector<Facet<3>>&);
template std::array<PieceIndex, 2> sides_of(const input::Periodicity&, const Cloud<2>&);
template std::array<PieceIndex, 2> sides_of(const input::Periodicity&, const Cloud<3>&);
template Pairs tied_pairs(const input::Case&, const Cloud<2>&);
template Pairs tied_pairs(const input::Case&, const Cloud<3>&);
template void set_initial_state<2>(const input::Case&, const Cloud<2>&,
                                   const IndexedVector<NodeIndex, std::int32_t>&, Fields<2>&, Field&);
template void set_initial_state<3>(const input::Case&, const Cloud<3>&,
                                   const IndexedVector<NodeIndex, std::int32_t>&, Fields<3>&, Field&);

} // namespace cnem::app
