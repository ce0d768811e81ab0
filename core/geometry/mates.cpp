#include "core/geometry/mates.hpp"

#include "core/error.hpp"
#include "core/geometry/place_text.hpp"
#include "core/index.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <map>

namespace cnem {

namespace {

void be_mates(Cloud<2>& cloud, CloudFacetIndex f, CloudFacetIndex g) {
  if (cloud.mates.empty()) cloud.mates.assign(cloud.facets.size(), CloudFacetIndex::none);
  cloud.mates[f] = g;
  cloud.mates[g] = f;
}

void add_ends(const Cloud<2>& cloud, CloudFacetIndex f, std::vector<std::array<NodeIndex, 2>>& pairs) {
  const auto [a, b] = cloud.facets[f].node;
  const auto [c, d] = cloud.facets[cloud.mates[f]].node;
  pairs.push_back({a, d});
  pairs.push_back({b, c});
}

} // namespace

void pair_coincident_facets(Cloud<2>& cloud) {
  const auto place = [&](NodeIndex i) { return std::array{cloud.position[i].x(), cloud.position[i].y()}; };
  std::map<std::array<std::array<double, 2>, 2>, CloudFacetIndex> facet_at;
  for (const CloudFacetIndex f : cloud.facets.indices()) {
    const auto [a, b] = cloud.facets[f].node;
    facet_at.emplace(std::array{place(a), place(b)}, f);
    if (const auto found = facet_at.find({place(b), place(a)}); found != facet_at.end())
      be_mates(cloud, f, found->second);
  }
}

void pair_facets(Cloud<2>& cloud, std::span<const std::array<NodeIndex, 2>> nodes) {
  std::map<NodeIndex, NodeIndex> other;
  for (const auto& [a, b] : nodes) other[a] = b;
  std::map<std::array<NodeIndex, 2>, CloudFacetIndex> facet_of;
  for (const CloudFacetIndex f : cloud.facets.indices()) facet_of[cloud.facets[f].node] = f;
  for (const CloudFacetIndex f : cloud.facets.indices()) {
    const auto a = other.find(cloud.facets[f].node[0]), b = other.find(cloud.facets[f].node[1]);
    if (a == other.end() || b == other.end()) continue;
    if (const auto found = facet_of.find({b->second, a->second}); found != facet_of.end())
      be_mates(cloud, f, found->second);
  }
}

template<int dim>
std::vector<std::array<NodeIndex, 2>> shifted_nodes(const Cloud<dim>& cloud,
                                                    const std::array<PieceIndex, 2>& pieces) {
  std::array<std::vector<NodeIndex>, 2> nodes;
  double spacing = std::numeric_limits<double>::infinity();
  for (const Facet<dim>& facet : cloud.facets)
    for (std::size_t side = 0; side < 2; ++side) {
      if (facet.piece != pieces[side]) continue;
      nodes[side].insert(nodes[side].end(), facet.node.begin(), facet.node.end());
      for (std::size_t k = 0; side == 0 && k < dim; ++k)
        spacing = std::min(
            spacing, (cloud.position[facet.node[(k + 1) % dim]] - cloud.position[facet.node[k]]).norm());
    }
  std::array<Vec<dim>, 2> mean;
  for (std::size_t side = 0; side < 2; ++side) {
    auto& list = nodes[side];
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
    mean[side] = Vec<dim>::Zero();
    for (const NodeIndex i : list) mean[side] += cloud.position[i] / static_cast<double>(list.size());
  }
  if (nodes[0].empty() || nodes[0].size() != nodes[1].size())
    throw GeometryError(fmt::format("found {} nodes on '{}' and {} on '{}'", nodes[0].size(),
                                    cloud.piece_names[pieces[0]], nodes[1].size(),
                                    cloud.piece_names[pieces[1]]));
  // along a direction that few pairs of nodes of a lattice lie across
  constexpr std::array slope{1.0, 0.7320508075688772, 0.6180339887498949};
  const auto along = [&](const Vec<dim>& x) {
    double sum = 0.0;
    for (int k = 0; k < dim; ++k) sum += slope[index_of(k)] * x[k];
    return sum;
  };
  std::vector<std::pair<double, NodeIndex>> second;
  for (const NodeIndex i : nodes[1]) second.emplace_back(along(cloud.position[i]), i);
  std::sort(second.begin(), second.end());
  std::vector<char> taken(second.size(), 0);
  const double near = 1e-3 * spacing, reach = 2.0 * near; // over the length of the slope, 1.4
  std::vector<std::array<NodeIndex, 2>> pairs;
  for (const NodeIndex i : nodes[0]) {
    const Vec<dim> wanted = cloud.position[i] + (mean[1] - mean[0]);
    std::size_t best = second.size();
    double least = near;
    const auto first =
        std::lower_bound(second.begin(), second.end(), std::pair(along(wanted) - reach, NodeIndex{}));
    for (auto k = index_of(first - second.begin());
         k < second.size() && second[k].first <= along(wanted) + reach; ++k) {
      const double gap = (cloud.position[second[k].second] - wanted).norm();
      if (gap <= least && !taken[k] && second[k].second != i) best = k, least = gap;
    }
    if (best == second.size())
      throw GeometryError(fmt::format("found no partner of the node at {} m", place_text(cloud.position[i])));
    taken[best] = 1;
    pairs.push_back({i, second[best].second});
  }
  return pairs;
}

template<int dim>
std::vector<std::array<NodeIndex, 2>> mated_nodes(const Cloud<dim>& cloud,
                                                  std::span<const PieceIndex> pieces) {
  std::vector<std::array<NodeIndex, 2>> pairs;
  if constexpr (dim == 3)
    for (std::size_t p = 0; p + 1 < pieces.size(); p += 2) {
      const auto sides = shifted_nodes<dim>(cloud, {pieces[p], pieces[p + 1]});
      pairs.insert(pairs.end(), sides.begin(), sides.end());
    }
  else
    for (const CloudFacetIndex f : cloud.mates.indices())
      if (exists(cloud.mates[f]) &&
          std::find(pieces.begin(), pieces.end(), cloud.facets[f].piece) != pieces.end())
        add_ends(cloud, f, pairs);
  return pairs;
}

template<int dim> std::vector<std::array<NodeIndex, 2>> mated_nodes(const Cloud<dim>& cloud) {
  std::vector<std::array<NodeIndex, 2>> pairs;
  if constexpr (dim == 2)
    for (const CloudFacetIndex f : cloud.mates.indices())
      if (exists(cloud.mates[f])) add_ends(cloud, f, pairs);
  return pairs;
}

template std::vector<std::array<NodeIndex, 2>> shifted_nodes(const Cloud<2>&,
                                                             const std::array<PieceIndex, 2>&);
template std::vector<std::array<NodeIndex, 2>> shifted_nodes(const Cloud<3>&,
                                                             const std::array<PieceIndex, 2>&);
template std::vector<std::array<NodeIndex, 2>> mated_nodes(const Cloud<2>&, std::span<const PieceIndex>);
template std::vector<std::array<NodeIndex, 2>> mated_nodes(const Cloud<3>&, std::span<const PieceIndex>);
template std::vector<std::array<NodeIndex, 2>> mated_nodes(const Cloud<2>&);
template std::vector<std::array<NodeIndex, 2>> mated_nodes(const Cloud<3>&);

} // namespace cnem
