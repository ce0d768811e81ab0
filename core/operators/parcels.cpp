#include "core/operators/parcels.hpp"

#include "core/operators/operators.hpp"

#include <algorithm>

namespace cnem {

namespace {

/// f(first, last entry) for every row makes the new field.
template<IndexKind Index, class RowValue>
void carry(const SourceRows<Index>& rows, Field& value, const RowValue& row_value) {
  Field made(rows.size());
  for (std::size_t p = 0; p < made.size(); ++p) {
    const std::size_t first = index_of(rows.begin[p]), last = index_of(rows.begin[p + 1]);
    made[p] = rows.mixed(p) ? row_value(first, last) : value[index_of(rows.from[first])];
  }
  value = std::move(made);
}

} // namespace

template<IndexKind Index> void carry_sum(const SourceRows<Index>& parcels, Field& value) {
  carry(parcels, value, [&](std::size_t first, std::size_t last) {
    double sum = 0.0;
    for (std::size_t e = first; e < last; ++e) sum += parcels.weight[e] * value[index_of(parcels.from[e])];
    return sum;
  });
}

template<IndexKind Index>
void carry_mean(const SourceRows<Index>& parcels, const Field& weight, Field& value) {
  carry(parcels, value, [&](std::size_t first, std::size_t last) {
    const double one = value[index_of(parcels.from[first])]; // equal values stay what they are to the bit
    if (last - first == 1) return one;
    double sum = 0.0, total = 0.0, least = one, most = one;
    for (std::size_t e = first; e < last; ++e) {
      const std::size_t k = index_of(parcels.from[e]);
      const double share = parcels.weight[e] * weight[k];
      if (value[k] != one) sum += share * (value[k] - one);
      total += share;
      least = std::min(least, value[k]);
      most = std::max(most, value[k]);
    }
    // rounding takes it beyond where the first has hardly a share
    return std::clamp(one + sum / total, least, most);
  });
}

template<IndexKind Index> void carry_label(const SourceRows<Index>& labels, Field& value) {
  carry_sum(labels, value);
}

template<IndexKind Index>
void carry_label(const SourceRows<Index>& labels, std::vector<std::int32_t>& value) {
  std::vector<std::int32_t> made(labels.size());
  for (std::size_t p = 0; p < made.size(); ++p)
    made[p] = value[index_of(labels.from[index_of(labels.begin[p])])];
  value = std::move(made);
}

PointRows rows_of_points(const NodeRows& nodes) {
  PointRows points{nodes.begin, {}, nodes.weight};
  points.from.reserve(nodes.from.size());
  for (const NodeIndex node : nodes.from) points.from.push_back(point_of(node));
  return points;
}

#define CNEM_INSTANTIATE(Index)                                                                              \
  template void carry_sum(const SourceRows<Index>&, Field&);                                                 \
  template void carry_mean(const SourceRows<Index>&, const Field&, Field&);                                  \
  template void carry_label(const SourceRows<Index>&, Field&);                                               \
  template void carry_label(const SourceRows<Index>&, std::vector<std::int32_t>&);
CNEM_INSTANTIATE(NodeIndex)
CNEM_INSTANTIATE(PointIndex)
#undef CNEM_INSTANTIATE

} // namespace cnem
