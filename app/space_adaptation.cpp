#include "app/space_adaptation.hpp"

#include "core/index.hpp"
#include "mechanics/kinematics.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <initializer_list>

namespace cnem::app {
namespace {

/// The piece that new faces belong to.
PieceIndex fracture_piece(Cloud<3>& cloud) {
  constexpr const char* name = input::Adaptation::fracture_piece;
  const auto found = std::find(cloud.piece_names.begin(), cloud.piece_names.end(), name);
  const auto piece = as<PieceIndex>(found - cloud.piece_names.begin());
  if (found == cloud.piece_names.end()) cloud.piece_names.emplace_back(name);
  return piece;
}

using Report = adapt::PassReport;
constexpr std::pair<const char*, int Report::*> counts[] = {{"cuts", &Report::cuts},
                                                            {"opened", &Report::opened},
                                                            {"outside", &Report::outside},
                                                            {"removed", &Report::removed},
                                                            {"removed_boundary", &Report::removed_boundary},
                                                            {"inserted", &Report::inserted},
                                                            {"inserted_boundary", &Report::inserted_boundary},
                                                            {"flipped", &Report::flipped},
                                                            {"balanced", &Report::balanced},
                                                            {"undone", &Report::undone},
                                                            {"crossings", &Report::crossings}};

} // namespace

SpaceAdaptation::SpaceAdaptation(const input::Case& input, const ExplicitSolver<3>& solver) : input_(&input) {
  if (active()) size_.assign(solver.state().node.size(), input.cloud.spacing);
}

void SpaceAdaptation::start_log(const std::filesystem::path& folder) {
  if (active()) log_.start(folder, results::history_units(input_->analysis), 3);
}

void SpaceAdaptation::resume_log(const std::filesystem::path& folder) {
  if (active()) log_.resume(folder, results::history_units(input_->analysis), 3);
}

adapt::NodeProperties SpaceAdaptation::properties(const ExplicitSolver<3>& solver) const {
  const State<3>& state = solver.state();
  const std::size_t n = state.node.size();
  adapt::NodeProperties properties;
  properties.mass = state.node.mass;
  properties.size = size_;
  properties.held.assign(n, 0);
  properties.jacobian.resize(n);
  properties.density.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    properties.jacobian[i] = jacobian<3>(state.point.deformation, i) / state.point.stress_free[i];
    properties.density[i] = solver.model().materials[index_of(state.point.material[i])].density;
  }
  if (input_->adapt.separate) { // of what is broken, the most strained is in the middle of the band
    properties.broken = state.point.softening;
    for (std::size_t i = 0; i < n; ++i)
      if (properties.broken[i] >= 1.0) properties.broken[i] += state.point.plastic_strain[i];
  }
  return properties;
}

double SpaceAdaptation::renew(ExplicitSolver<3>& solver, const Follow& follow) {
  const results::Audit<3> before = results::audit(solver);
  adapt::PassReport report;
  Cloud<3> cloud = solver.present_cloud();
  adapt::SpaceRules rules;
  rules.cells = input_->method.options.cells;
  if (input_->adapt.separate) rules.separation.piece = fracture_piece(cloud);
  const Resampling<3> change = adapt::resample(cloud, properties(solver), rules, report);
  solver.prepare(change);
  carry_label(change.labels, size_);
  follow(change);
  ++passes_;
  total_ += report;
  log_.record(solver.state(), report, before, results::audit(solver));
  const auto none = [](NodeIndex i) { return !exists(i); };
  const auto came = std::count_if(change.old_of.begin(), change.old_of.end(), none),
             went = std::count_if(change.new_of.begin(), change.new_of.end(), none);
  return static_cast<double>(came + went) / static_cast<double>(change.old_of.size());
}

std::vector<std::pair<std::string, double>> SpaceAdaptation::metrics() const {
  if (!active()) return {};
  std::vector<std::pair<std::string, double>> list = log_.metrics();
  list.emplace_back("adapt.passes", static_cast<double>(passes_));
  for (const auto& [name, count] : counts) list.emplace_back(fmt::format("adapt.{}", name), total_.*count);
  list.emplace_back("adapt.volume_change", total_.volume_change);
  return list;
}

void SpaceAdaptation::archive(Archive& archive) {
  if (!active()) return;
  std::size_t nodes = size_.size();
  archive.integer("run/adapt/nodes", nodes);
  size_.resize(nodes);
  archive.field("run/adapt/size", "m", size_);
  archive.integer("run/adapt/passes", passes_);
  log_.archive(archive);
  for (const auto& [name, count] : counts)
    archive.integer(fmt::format("run/adapt/count/{}", name), total_.*count);
  archive.number("run/adapt/volume_change", "m^3", total_.volume_change);
}

} // namespace cnem::app
