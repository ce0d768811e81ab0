#include "mechanics/opening_width.hpp"

#include "core/index.hpp"

#include <algorithm>
#include <cassert>
#include <utility>
#include <vector>

namespace cnem {

double opening_width(const DiscreteOperators<2>& operators, const Field& x, std::size_t p,
                     const Vec2& gradient, const Vec2& place) {
  std::vector<std::pair<double, double>> node; // place along n, share of the gradient
  for (auto e = index_of(operators.row_begin[p]); e < index_of(operators.row_begin[p + 1]); ++e) {
    const std::size_t j = index_of(operators.node[e]);
    node.emplace_back(place.x() * x[2 * j] + place.y() * x[2 * j + 1],
                      gradient.x() * operators.gradient[0][e] + gradient.y() * operators.gradient[1][e]);
  }
  std::sort(node.begin(), node.end());
  double sum = 0.0, seen = 0.0; // from the last node backwards
  for (std::size_t k = node.size(); k-- > 1;) {
    seen += node[k].second;
    sum += seen * seen * (node[k].first - node[k - 1].first);
  }
  assert(sum > 0.0);
  return 1.0 / sum;
}

} // namespace cnem
