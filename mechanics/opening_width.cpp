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
  /// f(what is seen of openings between a node and the one before it, how far these are apart).
  const auto each = [&](auto&& f) {
    double seen = 0.0;
    for (std::size_t k = node.size(); k-- > 1;) {
      seen += node[k].second;
      f(seen, node[k].first - node[k - 1].first);
    }
  };
  if (!operators.nodal) {
    double squares = 0.0;
    each([&](double seen, double apart) { squares += seen * seen * apart; });
    assert(squares > 0.0);
    return 1.0 / squares;
  }
  const double same = 1e-9 * (node.back().first - node.front().first); // places that differ by rounding
  double most = 0.0, strip = 0.0;
  each([&](double seen, double apart) {
    if (apart > same) most = std::max(most, seen);
  });
  constexpr double least = 0.25;
  each([&](double seen, double apart) {
    if (seen >= least * most) strip += apart;
  });
  assert(strip > 0.0);
  return strip;
}

} // namespace cnem
