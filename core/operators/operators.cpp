#include "core/operators/operators.hpp"
#include "core/index.hpp"

#include <algorithm>
#include <cassert>

namespace cnem {

template<int dim> void DiscreteOperators<dim>::begin_columns() {
  col_begin.assign(index_of(nodes) + 1, 0);
  for (const NodeIndex j : node) ++col_begin[index_of(j) + 1];
  for (std::size_t j = 0; j < index_of(nodes); ++j) col_begin[j + 1] += col_begin[j];
}

template<int dim> void DiscreteOperators<dim>::build_transpose() {
  const std::size_t entries = node.size();
  assert(row_begin.size() == index_of(points) + 1 && index_of(row_begin.back()) == entries);
  assert(volume.size() == index_of(points) && (value.empty() || value.size() == entries));
  assert(std::all_of(node.begin(), node.end(),
                     [&](NodeIndex j) { return exists(j) && j < as<NodeIndex>(nodes); }));
  begin_columns();
  point.resize(entries);
  for (Field& f : weighted_gradient) f.resize(entries);
  weighted_value.resize(value.size());
  weighted_hoop.resize(hoop.size());

  std::vector<std::int32_t> next(col_begin.begin(), col_begin.end() - 1);
  for (std::size_t p = 0; p < index_of(points); ++p) {
    const double v = volume[p];
    for (auto e = index_of(row_begin[p]); e < index_of(row_begin[p + 1]); ++e) {
      const auto t = index_of(next[index_of(node[e])]++);
      point[t] = as<PointIndex>(p);
      for (std::size_t k = 0; k < dim; ++k) weighted_gradient[k][t] = v * gradient[k][e];
      if (!value.empty()) weighted_value[t] = v * value[e];
      if (!hoop.empty()) weighted_hoop[t] = v * hoop[e];
    }
  }
}

template<int dim> Field DiscreteOperators<dim>::node_volume() const {
  if (nodal) return volume;
  Field share(index_of(nodes), 0.0);
  for (std::size_t j = 0; j < share.size(); ++j)
    for (auto e = index_of(col_begin[j]); e < index_of(col_begin[j + 1]); ++e) share[j] += weighted_value[e];
  return share;
}

template struct DiscreteOperators<2>;
template struct DiscreteOperators<3>;

} // namespace cnem
