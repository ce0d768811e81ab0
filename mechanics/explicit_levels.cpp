// Which points and nodes are due in the sub-steps of a macro step (docs/theory.md, "Local time steps").
#include "core/error.hpp"
#include "core/index.hpp"
#include "mechanics/explicit_solver.hpp"

#include <algorithm>

namespace cnem {

template<int dim> int ExplicitSolver<dim>::sub_steps() const {
  if (next_levels_.empty()) return local_.sub_steps();
  return 1 << *std::max_element(next_levels_.begin(), next_levels_.end());
}

/// Stresses of a range, and forces of its nodes where it is one of nodes too, as impulses over its own step,
/// in units of the finest one.
template<int dim> void ExplicitSolver<dim>::scale_to_impulses(const LevelRange& range) {
  const double steps = 1 << range.level;
  constexpr std::size_t stride = column_stress<dim>;
  for (std::size_t c = stride * range.begin; c < stride * range.end; ++c) stress_.columns[c] *= steps;
  if constexpr (dim == 2)
    for (std::size_t p = range.begin; p < range.end; ++p) stress_.out_of_plane[p] *= steps;
  if (!approximation_->mechanics.nodal) return;
  for (Field& component : state_.node.force)
    for (std::size_t i = range.begin; i < range.end; ++i) component[i] *= steps;
}

template<int dim> void ExplicitSolver<dim>::set_levels(typename LocalSteps<dim>::Levels level) {
  if (local_.on()) {
    std::vector<bool> finest(state_.node.size(), false);
    if (conditions_.contact.active() || !conditions_.loads.empty())
      for (const Facet<dim>& facet : conditions_.cloud.facets)
        for (const NodeIndex i : facet.node) finest[index_of(i)] = true;
    for (const auto& held : conditions_.supports.prescribed()) finest[index_of(held.node)] = true;
    for (const NodeIndex i : conditions_.ties.nodes()) finest[index_of(i)] = true;
    local_.set_levels(std::move(level), approximation_->mechanics, approximation_->links, finest);
  } else {
    local_.set_one_level(approximation_->mechanics);
  }
  each([&](Term<dim>& term) { term.set_levels(body()); });
}

/// The levels in use on new operators, with the impulses they make there; what the new neighbourhoods ask for
/// comes with the next step.
template<int dim> void ExplicitSolver<dim>::rebuild_levels() {
  set_levels(local_.level());
  next_levels_.clear();
  if (local_.on()) {
    next_levels_ = local_.level();
    LocalSteps<dim>::grade(approximation_->mechanics, approximation_->links, next_levels_);
    if (next_levels_ == local_.level()) next_levels_.clear();
  }
  on_new_reference_ = true;
  local_.look_again();
  assemble_forces(local_.highest());
}

/// Stresses of all points as they were before impulses were made of them.
template<int dim> void ExplicitSolver<dim>::restore_columns() {
  const PointState<dim>& point = state_.point;
  const auto& f = point.deformation;
  copy_stress_columns<dim>(point.piola, stress_);
  if (!on_new_reference_) {
    for (std::size_t p = 0; p < point.size(); ++p) {
      const double q = point.viscous_pressure[p];
      const auto cofactor = cofactors<dim>(f, p);
      for (std::size_t k = 0; k < dim; ++k)
        for (std::size_t i = 0; i < dim; ++i)
          stress_.columns[(p * dim + k) * beside<dim> + i] -= q * cofactor[i * dim + k];
      if constexpr (dim == 2) stress_.out_of_plane[p] -= q * cofactor[4];
    }
  }
  each([&](Term<dim>& term) { term.restore(body()); });
}

/// Between two macro steps each point gives half its impulse with the step it made and half with the one it
/// is about to make: `finest` (s) is the finest of those.
template<int dim> void ExplicitSolver<dim>::change_levels(double finest) {
  NodeState<dim>& node = state_.node;
  std::vector<double> booked; // by the forces that were made
  each([&](Term<dim>& term) {
    for (const Energy* energy : term.energies()) booked.push_back(energy->value);
  });
  const Fields<dim> made = node.force;
  const std::size_t blocks = local_.node_blocks();
  std::vector<double> weight(blocks);
  for (std::size_t b = 0; b < blocks; ++b) weight[b] = local_.weight(b * LocalSteps<dim>::block);
  restore_columns();
  set_levels(std::move(next_levels_));
  next_levels_.clear();
  assemble_forces(local_.highest());
  auto value = booked.begin();
  each([&](Term<dim>& term) {
    for (Energy* energy : term.energies()) energy->value = *value++;
  });
  if (finest_before_ == 0.0) return;
  const double was = finest_before_ / (finest_before_ + finest), is = finest / (finest_before_ + finest);
  for (std::size_t k = 0; k < dim; ++k)
    for (std::size_t i = 0; i < node.size(); ++i) node.force[k][i] = was * made[k][i] + is * node.force[k][i];
  for (std::size_t b = 0; b < blocks; ++b)
    weight[b] = was * weight[b] + is * local_.weight(b * LocalSteps<dim>::block);
  start_weight_ = std::move(weight);
}

template int ExplicitSolver<2>::sub_steps() const;
template int ExplicitSolver<3>::sub_steps() const;
template void ExplicitSolver<2>::scale_to_impulses(const LevelRange&);
template void ExplicitSolver<3>::scale_to_impulses(const LevelRange&);
template void ExplicitSolver<2>::set_levels(LocalSteps<2>::Levels);
template void ExplicitSolver<3>::set_levels(LocalSteps<3>::Levels);
template void ExplicitSolver<2>::rebuild_levels();
template void ExplicitSolver<3>::rebuild_levels();
template void ExplicitSolver<2>::restore_columns();
template void ExplicitSolver<3>::restore_columns();
template void ExplicitSolver<2>::change_levels(double);
template void ExplicitSolver<3>::change_levels(double);

} // namespace cnem
