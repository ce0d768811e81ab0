// Which points and nodes are due in the sub-steps of a macro step (docs/theory.md, "Local time steps").
#include "core/error.hpp"
#include "mechanics/explicit_solver.hpp"

#include <algorithm>

namespace cnem {

namespace {

/// Components of det F · F⁻ᵀ at a point, as in PointState.
template<int dim>
std::array<double, tensor_size<dim>> cofactors(const Fields<tensor_size<dim>>& f, std::size_t p) {
  std::array<double, tensor_size<dim>> c{};
  if constexpr (dim == 2) {
    c = {f[3][p] * f[4][p], -f[2][p] * f[4][p], -f[1][p] * f[4][p], f[0][p] * f[4][p],
         f[0][p] * f[3][p] - f[1][p] * f[2][p]};
  } else {
    const auto at = [&](std::size_t i, std::size_t k) { return f[i % 3 * 3 + k % 3][p]; };
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t k = 0; k < 3; ++k)
        c[i * 3 + k] = at(i + 1, k + 1) * at(i + 2, k + 2) - at(i + 1, k + 2) * at(i + 2, k + 1);
  }
  return c;
}

} // namespace

template<int dim> int ExplicitSolver<dim>::sub_steps() const {
  if (next_levels_.empty()) return local_.sub_steps();
  return 1 << *std::max_element(next_levels_.begin(), next_levels_.end());
}

template<int dim> double ExplicitSolver<dim>::updates() const { return local_.updates(); }

template<int dim> double ExplicitSolver<dim>::load_weight(std::size_t node) const {
  return start_load_weight_.empty() ? local_.weight(node) : start_load_weight_[node / LocalSteps<dim>::block];
}

template<int dim> void ExplicitSolver<dim>::set_levels(typename LocalSteps<dim>::Levels level) {
  if (!local_.on()) return local_.set_one_level(state_.point.size(), state_.node.size());
  std::vector<bool> finest(state_.node.size(), false);
  if (model_.contact.active() || !model_.loads.empty())
    for (const Facet<dim>& facet : model_.cloud.facets)
      for (const std::int32_t i : facet.node) finest[static_cast<std::size_t>(i)] = true;
  for (const auto& held : model_.supports.prescribed()) finest[static_cast<std::size_t>(held.node)] = true;
  for (const std::int32_t i : model_.ties.nodes()) finest[static_cast<std::size_t>(i)] = true;
  local_.set_levels(std::move(level), approximation_.mechanics, approximation_.links, finest);
  window_.clear();
  if (!model_.contact.flow_stress_needed()) return;
  for (int a = 0; a <= local_.highest(); ++a) {
    std::vector<double>& window = window_.emplace_back();
    for (const std::int32_t i : model_.contact.boundary_nodes())
      window.push_back(local_.window(approximation_.mechanics, static_cast<std::size_t>(i), a));
  }
}

/// The levels in use on new operators, with the impulses they make there; what the new neighbourhoods ask for
/// comes with the next step.
template<int dim> void ExplicitSolver<dim>::rebuild_levels() {
  if (local_.on())
    require(model_.method->promises(), Promise::one_point_per_node, model_.method->name(),
            "local time steps");
  if (local_.on() && damage_.active()) throw InputError("local time steps do not take damage laws");
  set_levels(local_.level());
  next_levels_.clear();
  if (local_.on()) {
    next_levels_ = local_.level();
    LocalSteps<dim>::grade(approximation_.mechanics, approximation_.links, next_levels_);
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
      const double q = viscous_pressure_[p];
      const auto cofactor = cofactors<dim>(f, p);
      for (std::size_t k = 0; k < dim; ++k)
        for (std::size_t i = 0; i < dim; ++i)
          stress_.columns[(p * dim + k) * dim + i] -= q * cofactor[i * dim + k];
      if constexpr (dim == 2) stress_.out_of_plane[p] -= q * cofactor[4];
    }
  }
  if (edge_defect_.active(approximation_.links))
    edge_defect_.store_records(point.deformation, 0, point.size());
}

/// Between two macro steps each point gives half its impulse with the step it made and half with the one it
/// is about to make: `finest` (s) is the finest of those.
template<int dim> void ExplicitSolver<dim>::change_levels(double finest) {
  NodeState<dim>& node = state_.node;
  const double stored = running_.stabilisation, released = running_.penalty_release;
  const Fields<dim> made = node.force;
  const std::size_t blocks = next_levels_.size();
  std::vector<double> weight(blocks);
  for (std::size_t b = 0; b < blocks; ++b) weight[b] = local_.weight(b * LocalSteps<dim>::block);
  restore_columns();
  set_levels(std::move(next_levels_));
  next_levels_.clear();
  assemble_forces(local_.highest());
  running_.stabilisation = stored;
  running_.penalty_release = released;
  if (finest_before_ == 0.0) return;
  const double was = finest_before_ / (finest_before_ + finest), is = finest / (finest_before_ + finest);
  for (std::size_t k = 0; k < dim; ++k)
    for (std::size_t i = 0; i < node.size(); ++i) node.force[k][i] = was * made[k][i] + is * node.force[k][i];
  for (std::size_t b = 0; b < blocks; ++b)
    weight[b] = was * weight[b] + is * local_.weight(b * LocalSteps<dim>::block);
  start_load_weight_ = std::move(weight);
}

/// Reactions of supports over a macro step: means over its sub-steps.
template<int dim>
ExplicitSolver<dim>::Reactions::Reactions(ExplicitSolver& solver, double duration, int count)
    : solver_(solver), duration_(duration), count_(count), mean_(solver.model_.supports.reactions()) {
  if (several()) solver_.model_.contact.begin_sub_steps();
  for (auto& reaction : mean_) reaction.setZero();
}

template<int dim> bool ExplicitSolver<dim>::Reactions::several() const {
  return count_ > 1 && solver_.model_.contact.active();
}

template<int dim> void ExplicitSolver<dim>::Reactions::add(double dt_mean) {
  for (std::size_t i = 0; i < mean_.size(); ++i)
    mean_[i] += dt_mean / duration_ * solver_.model_.supports.reactions()[i];
}

template<int dim> void ExplicitSolver<dim>::Reactions::report() {
  if (several()) solver_.model_.contact.end_sub_steps(duration_);
  if (count_ > 1) solver_.model_.supports.report(std::move(mean_));
}

template class ExplicitSolver<2>::Reactions;
template int ExplicitSolver<2>::sub_steps() const;
template double ExplicitSolver<2>::updates() const;
template double ExplicitSolver<2>::load_weight(std::size_t) const;
template void ExplicitSolver<2>::set_levels(LocalSteps<2>::Levels);
template void ExplicitSolver<2>::rebuild_levels();
template void ExplicitSolver<2>::restore_columns();
template void ExplicitSolver<2>::change_levels(double);

} // namespace cnem
