#include "evaluate/debonding.hpp"

#include "core/index.hpp"

#include <algorithm>

namespace cnem::evaluate {

Debonding look_at_bonds(const CohesiveFaces& faces, std::span<const Vec2> place) {
  Debonding result;
  for (const CohesiveInterface& interface : faces.interfaces()) {
    result.length += CohesiveFaces::broken_length(interface);
    for (std::size_t e = 0; e < interface.element.size(); ++e)
      for (std::size_t end = 0; end < 2; ++end) {
        if (interface.state[e][end].damage < 1.0) continue;
        const CohesiveElement& element = interface.element[e];
        for (std::size_t s = 0; s < 2; ++s) {
          const auto values = element.values(s, end);
          const auto& node = element.side[s].node;
          const double y =
              values[0] * place[index_of(node[0])].y() + values[1] * place[index_of(node[1])].y();
          result.depth = std::max(result.depth, -y);
        }
      }
  }
  return result;
}

} // namespace cnem::evaluate
