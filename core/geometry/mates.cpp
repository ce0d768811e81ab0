#include "core/geometry/mates.hpp"

#include <algorithm>
#include <cassert>
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
std::vector<std::array<NodeIndex, 2>> mated_nodes(const Cloud<dim>& cloud,
                                                  std::span<const PieceIndex> pieces) {
  std::vector<std::array<NodeIndex, 2>> pairs;
  if constexpr (dim == 2)
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

template std::vector<std::array<NodeIndex, 2>> mated_nodes(const Cloud<2>&, std::span<const PieceIndex>);
template std::vector<std::array<NodeIndex, 2>> mated_nodes(const Cloud<3>&, std::span<const PieceIndex>);
template std::vector<std::array<NodeIndex, 2>> mated_nodes(const Cloud<2>&);
template std::vector<std::array<NodeIndex, 2>> mated_nodes(const Cloud<3>&);

} // namespace cnem
