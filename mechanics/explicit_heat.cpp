// The thermal half of a step of the explicit solver.
#include "core/parallel.hpp"
#include "mechanics/explicit_solver.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cnem {

template<int dim> void ExplicitSolver<dim>::measure_conduction_step() {
  const NodeState<dim>& node = state_.node;
  const double decay = conduction_.fastest_decay(position_, node.heat_capacity) +
                       model_.heat_boundaries.fastest_decay(state_.time, node.position, node.heat_capacity);
  conduction_step_ = decay > 0.0 ? 2.0 / decay : std::numeric_limits<double>::infinity();
}

/// Plastic and friction heat. Plastic heat is local, per unit mass (nodal), or shared out with the shape
/// functions.
template<int dim> void ExplicitSolver<dim>::heat_plastically() {
  NodeState<dim>& node = state_.node;
  const PointState<dim>& point = state_.point;
  const DiscreteOperators<dim>& op = approximation_.mechanics;
  const std::size_t n = node.size();
  running_.heat_generated += sum_blocks(n, [&](std::size_t begin, std::size_t end) {
    double sum = 0.0;
    for (std::size_t i = begin; i < end; ++i) {
      double heat = contact_heat_[i];
      if (op.nodal) {
        const plasticity::Material& material = material_of(i);
        heat += material.taylor_quinney * point.dissipation[i] * node.mass[i] / material.density;
      } else {
        for (auto e = static_cast<std::size_t>(op.col_begin[i]);
             e < static_cast<std::size_t>(op.col_begin[i + 1]); ++e) {
          const auto p = static_cast<std::size_t>(op.point[e]);
          heat += material_of(p).taylor_quinney * point.dissipation[p] * point.stress_free[p] *
                  op.weighted_value[e];
        }
      }
      node.temperature[i] += heat / node.heat_capacity[i];
      sum += heat;
    }
    return sum;
  });
}

/// Explicit conduction (58), in as many sub-steps as are stable.
template<int dim> void ExplicitSolver<dim>::conduct(double dt) {
  NodeState<dim>& node = state_.node;
  const std::size_t n = node.size();
  if (!model_.heat_ties.empty()) model_.heat_ties.share(node.heat_capacity, node.temperature);
  if (conduction_step_ == 0.0) measure_conduction_step();
  const double decay = 2.0 / conduction_step_ + heat_contacts_.fastest_decay(node.heat_capacity);
  const int substeps = std::max(1, static_cast<int>(std::ceil(dt * decay / 1.8)));
  const double h = dt / substeps;
  for (int s = 0; s < substeps; ++s) {
    std::fill(heat_flow_.begin(), heat_flow_.end(), 0.0);
    model_.heat_boundaries.add_flow(state_.time, node.position, node.temperature, heat_contacts_, heat_flow_);
    double received = h * sum_blocks(n, [&](std::size_t begin, std::size_t end) {
                        double sum = 0.0;
                        for (std::size_t i = begin; i < end; ++i) sum += heat_flow_[i];
                        return sum;
                      });
    conduction_.add_flow(position_, node.temperature, heat_flow_);
    for_each_block(n, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i)
        node.temperature[i] += h * heat_flow_[i] / node.heat_capacity[i];
    });
    if (!model_.heat_ties.empty()) model_.heat_ties.share(node.heat_capacity, node.temperature);
    received += model_.heat_boundaries.hold(state_.time, node.heat_capacity, node.temperature);
    running_.heat_exchanged += received;
  }
}

template void ExplicitSolver<2>::heat_plastically();
template void ExplicitSolver<2>::conduct(double);
template void ExplicitSolver<2>::measure_conduction_step();

} // namespace cnem
