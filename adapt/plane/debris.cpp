#include "adapt/plane/debris.hpp"

#include <cmath>

namespace cnem::adapt {

void spread_debris(NodeProperties& node) {
  constexpr double opened = 2.0;
  for (std::size_t i = 0; i < node.broken.size(); ++i)
    if (node.broken[i] >= 1.0 && node.jacobian[i] > opened)
      node.size[i] *= std::sqrt(node.jacobian[i] / opened);
}

} // namespace cnem::adapt
