#include "core/operators/resampling.hpp"
#include "core/index.hpp"

#include <algorithm>

namespace cnem {

template<int dim>
std::vector<Facet<dim>> facets_of_pieces(const Cloud<dim>& cloud, std::span<const PieceIndex> pieces) {
  std::vector<Facet<dim>> facets;
  for (const Facet<dim>& facet : cloud.facets)
    if (std::find(pieces.begin(), pieces.end(), facet.piece) != pieces.end()) facets.push_back(facet);
  return facets;
}

template<int dim>
std::vector<NodeIndex> renumbered(const Resampling<dim>& change, std::span<const NodeIndex> nodes,
                                  std::span<const PieceIndex> pieces) {
  std::vector<NodeIndex> list;
  for (const NodeIndex i : nodes)
    if (exists(change.new_of[i])) list.push_back(change.new_of[i]);
  for (const Facet<dim>& facet : facets_of_pieces(change.cloud, pieces))
    list.insert(list.end(), facet.node.begin(), facet.node.end());
  std::sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end()), list.end());
  return list;
}

template<int dim> std::vector<PieceIndex> pieces_of(std::span<const Facet<dim>> facets) {
  std::vector<PieceIndex> pieces;
  for (const Facet<dim>& facet : facets) pieces.push_back(facet.piece);
  std::sort(pieces.begin(), pieces.end());
  pieces.erase(std::unique(pieces.begin(), pieces.end()), pieces.end());
  return pieces;
}

template<int dim> void renew_facets(const Cloud<dim>& cloud, std::vector<Facet<dim>>& facets) {
  const std::vector<PieceIndex> pieces = pieces_of(std::span<const Facet<dim>>(facets));
  facets = facets_of_pieces(cloud, std::span<const PieceIndex>(pieces));
}

template std::vector<Facet<2>> facets_of_pieces(const Cloud<2>&, std::span<const PieceIndex>);
template std::vector<NodeIndex> renumbered(const Resampling<2>&, std::span<const NodeIndex>,
                                           std::span<const PieceIndex>);
template std::vector<PieceIndex> pieces_of(std::span<const Facet<2>>);
template std::vector<Facet<3>> facets_of_pieces(const Cloud<3>&, std::span<const PieceIndex>);
template std::vector<NodeIndex> renumbered(const Resampling<3>&, std::span<const NodeIndex>,
                                           std::span<const PieceIndex>);
template std::vector<PieceIndex> pieces_of(std::span<const Facet<3>>);
template void renew_facets(const Cloud<2>&, std::vector<Facet<2>>&);
template void renew_facets(const Cloud<3>&, std::vector<Facet<3>>&);

} // namespace cnem
