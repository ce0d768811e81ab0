#include "app/watches/penetration.hpp"

#include "app/places.hpp"

#include <fmt/format.h>

namespace cnem::app {

template<int dim> void PenetrationWatch::look(const ExplicitSolver<dim>& solver) {
  if (!warning_.empty()) return;
  const State<dim>& state = solver.state();
  const auto& contact = solver.conditions().contact;
  for (const contact::Overlap<dim>& overlap : contact.nodes_inside(state.node.position, state.time)) {
    if (!(overlap.depth > 0.5 * overlap.spacing)) continue;
    if (contact.tools()[overlap.tool].response.template is<contact::Kinematic>())
      continue; // lets in what creeps
    warning_ = fmt::format(
        "node {} at {} is {:.3g} m deep in tool '{}' at step {}, t = {:.6g} s, more than half "
        "the spacing there: contact cannot hold it, as where a support drives it into the tool, and "
        "forces mean nothing there",
        index_of(overlap.node), show_place<dim>(overlap.position), overlap.depth,
        contact.tools()[overlap.tool].name, state.step, state.time);
    return;
  }
}

template void PenetrationWatch::look(const ExplicitSolver<2>&);
template void PenetrationWatch::look(const ExplicitSolver<3>&);

} // namespace cnem::app
