#include "core/operators/resampling.hpp"
#include "core/index.hpp"

#include <algorithm>

namespace cnem {

namespace {

/// f(first, last entry) for every row makes the new field.
template<class RowValue> void carry(const NodeRows& rows, Field& value, const RowValue& row_value) {
  Field made(rows.size());
  for (std::size_t p = 0; p < made.size(); ++p) {
    const std::size_t first = index_of(rows.begin[p]), last = index_of(rows.begin[p + 1]);
    made[p] = last - first == 1 && rows.weight[first] == 1.0 ? value[index_of(rows.node[first])]
                                                             : row_value(first, last);
  }
  value = std::move(made);
}

} // namespace

void carry_sum(const NodeRows& parcels, Field& value) {
  carry(parcels, value, [&](std::size_t first, std::size_t last) {
    double sum = 0.0;
    for (std::size_t e = first; e < last; ++e) sum += parcels.weight[e] * value[index_of(parcels.node[e])];
    return sum;
  });
}

void carry_mean(const NodeRows& parcels, const Field& weight, Field& value) {
  carry(parcels, value, [&](std::size_t first, std::size_t last) {
    if (last - first == 1) return value[index_of(parcels.node[first])];
    const double one = value[index_of(parcels.node[first])]; // equal values stay what they are to the bit
    double sum = 0.0, total = 0.0;
    for (std::size_t e = first; e < last; ++e) {
      const double share = parcels.weight[e] * weight[index_of(parcels.node[e])];
      sum += share * (value[index_of(parcels.node[e])] - one);
      total += share;
    }
    return one + sum / total;
  });
}

void carry_label(const NodeRows& labels, Field& value) { carry_sum(labels, value); }

void carry_label(const NodeRows& labels, std::vector<std::int32_t>& value) {
  std::vector<std::int32_t> made(labels.size());
  for (std::size_t p = 0; p < made.size(); ++p)
    made[p] = value[index_of(labels.node[index_of(labels.begin[p])])];
  value = std::move(made);
}

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
