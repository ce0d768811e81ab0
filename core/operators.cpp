#include "core/operators.hpp"

namespace cnem {

template<int dim> void DiscreteOperators<dim>::build_transpose() {
  const std::size_t entries = node.size();
  col_begin.assign(static_cast<std::size_t>(nodes) + 1, 0);
  for (const std::int32_t j : node) ++col_begin[static_cast<std::size_t>(j) + 1];
  for (std::size_t j = 0; j < static_cast<std::size_t>(nodes); ++j) col_begin[j + 1] += col_begin[j];

  point.resize(entries);
  for (Field& f : weighted_gradient) f.resize(entries);
  weighted_value.resize(value.size());
  weighted_hoop.resize(hoop.size());

  std::vector<std::int32_t> next(col_begin.begin(), col_begin.end() - 1);
  for (std::int32_t p = 0; p < points; ++p) {
    const double v = volume[static_cast<std::size_t>(p)];
    for (auto e = static_cast<std::size_t>(row_begin[static_cast<std::size_t>(p)]);
         e < static_cast<std::size_t>(row_begin[static_cast<std::size_t>(p) + 1]); ++e) {
      const auto t = static_cast<std::size_t>(next[static_cast<std::size_t>(node[e])]++);
      point[t] = p;
      for (std::size_t k = 0; k < dim; ++k) weighted_gradient[k][t] = v * gradient[k][e];
      if (!value.empty()) weighted_value[t] = v * value[e];
      if (!hoop.empty()) weighted_hoop[t] = v * hoop[e];
    }
  }
}

template<int dim> Field DiscreteOperators<dim>::node_volume() const {
  if (nodal) return volume;
  Field share(static_cast<std::size_t>(nodes), 0.0);
  for (std::size_t j = 0; j < share.size(); ++j)
    for (auto e = static_cast<std::size_t>(col_begin[j]); e < static_cast<std::size_t>(col_begin[j + 1]); ++e)
      share[j] += weighted_value[e];
  return share;
}

template struct DiscreteOperators<2>;
template struct DiscreteOperators<3>;

} // namespace cnem
