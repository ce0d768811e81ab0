// What a checkpoint keeps of the solver. Operators are not kept: they follow from the reference positions.
#include "core/error.hpp"
#include "core/fields/archive.hpp"
#include "mechanics/explicit_solver.hpp"
#include "thermal/conduction.hpp"

#include <algorithm>

namespace cnem {

/// The nodes themselves, once resampling has made them other than those of the case.
template<int dim> void ExplicitSolver<dim>::archive_cloud(Archive& archive) {
  archive.integer("solver/resamplings", resamplings_);
  archive.integers("solver/cloud/body", conditions_.cloud.body);
  if (resamplings_ == 0) return;
  NodeState<dim>& node = state_.node;
  std::vector<std::int32_t> facets;
  for (const Facet<dim>& facet : conditions_.cloud.facets) {
    for (const NodeIndex i : facet.node) facets.push_back(as<std::int32_t>(i));
    facets.push_back(as<std::int32_t>(facet.piece));
  }
  std::size_t n = node.size();
  archive.integer("solver/nodes", n);
  archive.integers("solver/cloud/facets", facets);
  archive.integers("solver/cloud/mates", conditions_.cloud.mates);
  std::vector<NodeIndex> twins;
  for (const auto& pair : conditions_.cloud.twins) twins.insert(twins.end(), pair.begin(), pair.end());
  archive.integers("solver/cloud/twins", twins);
  if (archive.loading()) {
    conditions_.cloud.position.resize(n);
    conditions_.cloud.simplices.clear();
    conditions_.cloud.across.clear();
    conditions_.cloud.twins.clear();
    for (std::size_t at = 0; at + 1 < twins.size(); at += 2)
      conditions_.cloud.twins.push_back({twins[at], twins[at + 1]});
    conditions_.cloud.facets.clear();
    for (std::size_t at = 0; at + dim < facets.size(); at += dim + 1) {
      Facet<dim> facet;
      for (std::size_t a = 0; a < dim; ++a) facet.node[a] = as<NodeIndex>(facets[at + a]);
      facet.piece = as<PieceIndex>(facets[at + dim]);
      conditions_.cloud.facets.push_back(facet);
    }
    for (FieldTable* table : node_tables()) table->rest(n);
    // of other methods nodes exchange mass, and are as many as before, which makes as many points
    const std::size_t points = approximation_->mechanics.nodal ? n : state_.point.size();
    for (FieldTable* table : point_tables()) table->rest(points);
  }
  conditions_.ties.archive_nodes(archive, "solver/ties", n);
  conditions_.heat_ties.archive_nodes(archive, "solver/heat_ties", n);
  conditions_.supports.archive_nodes(archive, n);
  conditions_.heat_boundaries.archive_nodes(archive);
}

template<int dim> void ExplicitSolver<dim>::archive_energies(Archive& archive) {
  archive.number("solver/energy/initial", "J/m", initial_energy_);
  archive.number("solver/energy/plastic_offset", "J/m", plastic_offset_);
  each([&](Term<dim>& term) {
    for (Energy* energy : term.energies())
      archive.number(std::string("solver/ledger/") + energy->name, "J/m", energy->value);
    term.archive(archive);
  });
}

template<int dim> void ExplicitSolver<dim>::archive(Archive& archive) {
  NodeState<dim>& node = state_.node;
  archive_cloud(archive);
  if constexpr (dim == 2) conditions_.cohesive.archive(archive);
  archive.number("solver/time", "s", state_.time);
  archive.number("solver/step_before", "s", state_.step_before);
  archive.integer("solver/step", state_.step);
  const Fields<dim> initial = node.initial_position;
  for (FieldTable* table : node_tables()) table->archive(archive);
  if (resamplings_ == 0 && node.initial_position != initial)
    throw IoError("its nodes are not those that this version makes of the case");
  if (archive.loading()) {
    if (resamplings_ > 0) {
      for (std::size_t i = 0; i < node.size(); ++i)
        for (std::size_t k = 0; k < dim; ++k)
          conditions_.cloud.position[i][static_cast<Eigen::Index>(k)] = node.reference[k][i];
      conditions_.loads.resample(conditions_.cloud, node.initial_position);
      conditions_.heat_boundaries.resample(conditions_.cloud);
    }
  }
  for (FieldTable* table : point_tables()) table->archive(archive);
  for (std::size_t s = 0; s < state_.tool_temperature.size(); ++s)
    archive.field(fmt::format("solver/tool_heat/{}/temperature", s), "K", state_.tool_temperature[s]);
  if (model_.open) {
    Departed<dim>& gone = state_.departed;
    archive.number("solver/departed/mass", "kg/m", gone.mass);
    archive.number("solver/departed/volume", "m^2", gone.volume);
    archive.vector<dim>("solver/departed/momentum", "N s/m", gone.momentum);
    archive.number("solver/departed/enthalpy", "J/m", gone.enthalpy);
  }
  archive_energies(archive);
  if (node.scaling.on())
    for (Eigen::Index k = 0; k < dim; ++k)
      archive.number(fmt::format("solver/scaling_momentum/{}", k), "N s/m", scaling_momentum_[k]);
  archive.integer("solver/references", references_);
  archive.number("solver/finest_before", "s", finest_before_);
  bound_.archive(archive);
  if (local_.on()) {
    local_.archive(archive);
    archive.integer("solver/local/on_new_reference", on_new_reference_);
    std::vector<double> next(next_levels_.begin(), next_levels_.end());
    archive.list("solver/local/next_level", "1", next);
    next_levels_.clear();
    for (const double level : next) next_levels_.push_back(static_cast<std::int8_t>(level));
  }
  conditions_.supports.archive(archive);
  if (archive.loading()) // pairs of touching bodies are listed on it
    conditions_.contact.set_boundary(conditions_.cloud.facets, node.size(),
                                     conditions_.supports.constraints(), conditions_.ties.group());
  if constexpr (dim == 2)
    if (archive.loading()) conditions_.contact.set_bonds(conditions_.cohesive.bonds(conditions_.cloud));
  conditions_.contact.archive(archive);
  if (!archive.loading()) return;

  for (std::size_t i = 0; i < node.size(); ++i)
    for (std::size_t k = 0; k < dim; ++k)
      conditions_.cloud.position[i][static_cast<Eigen::Index>(k)] = node.reference[k][i];
  *approximation_ = model_.method->rebuild(conditions_.cloud);
  place_reference();
  set_levels(local_.level());
  scale_masses();
  each([&](Term<dim>& term) { term.attach(body()); });
}

template void ExplicitSolver<2>::archive_cloud(Archive&);
template void ExplicitSolver<3>::archive_cloud(Archive&);
template void ExplicitSolver<2>::archive_energies(Archive&);
template void ExplicitSolver<3>::archive_energies(Archive&);
template void ExplicitSolver<2>::archive(Archive&);
template void ExplicitSolver<3>::archive(Archive&);

} // namespace cnem
