// How far a solver may go: the stable step, the strain since the reference, and where it means nothing any
// more.
#include "core/error.hpp"
#include "core/parallel.hpp"
#include "mechanics/explicit_solver.hpp"

#include <cmath>
#include <fmt/format.h>

namespace cnem {

template<int dim> typename ExplicitSolver<dim>::Step ExplicitSolver<dim>::stable_step() {
  const PointState<dim>& point = state_.point;
  conduction_step_ = 0.0; // measured anew with the configuration
  const StableStep step = stable_mechanical_step(
      bound_, approximation_.mechanics, point.deformation, wave_modulus_, state_.node.mass,
      edge_defect_.active(approximation_.links) ? model_.stabilisation : 0.0, viscosity_ratio_);
  if (!(step.dt > 0.0)) diverged(step.point, "stable step");
  return {model_.safety * step.dt, step.point};
}

template<int dim> double ExplicitSolver<dim>::strain_since_reference() const {
  const auto& f = state_.point.deformation;
  return max_blocks(state_.point.size(),
                    [&](std::size_t begin, std::size_t end) {
                      BlockMaximum best{0.0, begin};
                      for (std::size_t p = begin; p < end; ++p) {
                        double sum = 0.0;
                        for (std::size_t i = 0; i < dim; ++i)
                          for (std::size_t k = 0; k < dim; ++k) {
                            const double d = f[i * dim + k][p] - (i == k ? 1.0 : 0.0);
                            sum += d * d;
                          }
                        if constexpr (dim == 2) sum += (f[4][p] - 1.0) * (f[4][p] - 1.0);
                        if (sum > best.value) best = {sum, p};
                      }
                      best.value = std::sqrt(best.value);
                      return best;
                    })
      .value;
}

template<int dim> void ExplicitSolver<dim>::diverged(std::size_t point, const std::string& field) const {
  const DiscreteOperators<dim>& op = approximation_.mechanics;
  const std::size_t node =
      op.nodal ? point : static_cast<std::size_t>(op.node[static_cast<std::size_t>(op.row_begin[point])]);
  throw DivergenceError(
      fmt::format("the {} of {} {} means nothing any more at step {}, t = {:.6g} s: node {} stood at "
                  "({:.6g}, {:.6g}) m",
                  field, op.nodal ? "node" : "stress point", point, state_.step, state_.time, node,
                  state_.node.position[0][node], state_.node.position[1][node]),
      static_cast<int>(node), field);
}

template ExplicitSolver<2>::Step ExplicitSolver<2>::stable_step();
template double ExplicitSolver<2>::strain_since_reference() const;
template void ExplicitSolver<2>::diverged(std::size_t, const std::string&) const;

} // namespace cnem
