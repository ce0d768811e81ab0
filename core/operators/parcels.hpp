#pragma once
// What is new, nodes or stress points, made of what was there, and how values go over with the matter.
#include "core/fields/aligned.hpp"
#include "core/index.hpp"

#include <cstdint>
#include <vector>

namespace cnem {

/// Sparse rows of weights: row n of what is new over what was there.
template<IndexKind Index> struct SourceRows {
  std::vector<std::int32_t> begin; ///< [new + 1]
  std::vector<Index> from;         ///< of what was there
  Field weight;                    ///< –

  std::size_t size() const { return begin.size() - 1; }
  /// Whether p is other matter than one whole of what was there.
  bool mixed(std::size_t p) const {
    return begin[p + 1] - begin[p] != 1 || weight[index_of(begin[p])] != 1.0;
  }
};
using NodeRows = SourceRows<NodeIndex>;
using PointRows = SourceRows<PointIndex>;

/// Sums over parcels: value'_p = Σ f_pk value_k. For mass, momentum, heat capacity.
template<IndexKind Index> void carry_sum(const SourceRows<Index>& parcels, Field& value);
/// Means over parcels weighted with an extensive quantity (mass before the change): value'_p = Σ f_pk m_k
/// value_k / Σ f_pk m_k, and to the last bit among the values that it is made of: what is never negative
/// stays so. Rows of one entry keep their bits, and so do equal values, infinite ones too.
template<IndexKind Index>
void carry_mean(const SourceRows<Index>& parcels, const Field& weight, Field& value);
/// Interpolates labels: value'_p = Σ w_pk value_k.
template<IndexKind Index> void carry_label(const SourceRows<Index>& labels, Field& value);
/// A label that cannot be averaged: that of the first entry in the row.
template<IndexKind Index> void carry_label(const SourceRows<Index>& labels, std::vector<std::int32_t>& value);

/// The rows of the stress points of nodes, where row p is node p.
PointRows rows_of_points(const NodeRows& nodes);

} // namespace cnem
