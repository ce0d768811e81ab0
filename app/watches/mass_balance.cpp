#include "app/watches/mass_balance.hpp"

#include "app/places.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace cnem::app {

template<int dim> void MassBalanceWatch::look(const ExplicitSolver<dim>& solver) {
  constexpr double most = 2.0; // times
  if (!warning_.empty()) return;
  const State<dim>& state = solver.state();
  std::size_t worst = 0;
  double ratio = 1.0;
  for (std::size_t i = 0; i < state.node.size(); ++i)
    if (const double r = solver.volume_ratio(i); std::max(r, 1.0 / r) > std::max(ratio, 1.0 / ratio))
      worst = i, ratio = r;
  if (ratio <= most && ratio >= 1.0 / most) return;
  warning_ = fmt::format("the matter in the cell of node {} at {} is {:.3g} times the mass of the node, at "
                         "step {}, t = {:.6g} s: what "
                         "depends on mass, temperature and inertia, is off there",
                         worst, show_place<dim>(state.node.position, worst), ratio, state.step, state.time);
}

template void MassBalanceWatch::look(const ExplicitSolver<2>&);
template void MassBalanceWatch::look(const ExplicitSolver<3>&);

} // namespace cnem::app
