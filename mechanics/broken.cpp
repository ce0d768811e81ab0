#include "mechanics/broken.hpp"

#include "plasticity/failure.hpp"

#include <algorithm>

namespace cnem {

template<int dim> Field lost_share(const PointState<dim>& point) {
  constexpr double rounding = 1e-9; // of means
  Field lost = point.softening;
  if (!point.failing.on()) return lost;
  lost.resize(point.size(), 0.0);
  for (std::size_t p = 0; p < lost.size(); ++p) {
    const double share = std::max(point.matrix_tension_damage[p], point.matrix_compression_damage[p]) /
                         plasticity::Failure::broken;
    lost[p] = std::max(lost[p], share >= 1.0 - rounding ? 1.0 : share);
  }
  return lost;
}

template Field lost_share(const PointState<2>&);
template Field lost_share(const PointState<3>&);

} // namespace cnem
