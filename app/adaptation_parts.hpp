#pragma once
// What passes in the plane and in space have in common.
#include "adapt/matter.hpp"
#include "adapt/pass_report.hpp"
#include "core/index.hpp"
#include "input/case.hpp"
#include "mechanics/broken.hpp"
#include "mechanics/explicit_solver.hpp"
#include "mechanics/kinematics.hpp"

#include <algorithm>
#include <utility>

namespace cnem::app {

/// The piece that faces of separation belong to; it is added where the cloud has none yet.
template<int dim> PieceIndex fracture_piece(Cloud<dim>& cloud) {
  constexpr const char* name = input::Adaptation::fracture_piece;
  const auto found = std::find(cloud.piece_names.begin(), cloud.piece_names.end(), name);
  const auto piece = as<PieceIndex>(found - cloud.piece_names.begin());
  if (found == cloud.piece_names.end()) cloud.piece_names.emplace_back(name);
  return piece;
}

/// What a pass has to know of nodes that are stress points, with these wanted spacings (m); none is held.
template<int dim>
adapt::NodeProperties node_properties(const input::Case& input, const ExplicitSolver<dim>& solver,
                                      Field size) {
  const State<dim>& state = solver.state();
  const std::size_t n = state.node.size();
  adapt::NodeProperties properties;
  properties.mass = state.node.mass;
  properties.size = std::move(size);
  properties.held.assign(n, 0);
  properties.jacobian.resize(n);
  properties.density.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    properties.jacobian[i] = jacobian<dim>(state.point.deformation, i) / state.point.stress_free[i];
    properties.density[i] = solver.model().materials[index_of(state.point.material[i])].density;
  }
  if (input.materials.size() > 1)
    properties.part.assign(state.node.material.begin(), state.node.material.end());
  if (input.adapt.separate) { // of what is broken, the most strained is in the middle of the band
    properties.broken = lost_share(state.point);
    for (std::size_t i = 0; i < n; ++i)
      if (properties.broken[i] >= 1.0) properties.broken[i] += state.point.plastic_strain[i];
  }
  return properties;
}

/// The share of the nodes that came or went.
template<int dim> double share_changed(const Resampling<dim>& change) {
  const auto none = [](NodeIndex i) { return !exists(i); };
  const auto came = std::count_if(change.old_of.begin(), change.old_of.end(), none),
             went = std::count_if(change.new_of.begin(), change.new_of.end(), none);
  return static_cast<double>(came + went) / static_cast<double>(change.old_of.size());
}

/// Calls `renew`, which adds to `total`, until it inserts no node, 20 times at most.
template<class Renew> void renew_until_fitted(const adapt::PassReport& total, Renew&& renew) {
  constexpr int most = 20;
  for (int pass = 0; pass < most; ++pass) {
    const int inserted = total.inserted + total.inserted_boundary;
    renew();
    if (total.inserted + total.inserted_boundary == inserted) break;
  }
}

} // namespace cnem::app
