#include "app/space_adaptation.hpp"

#include "adapt/space/indicator.hpp"
#include "app/adaptation_parts.hpp"
#include "app/problem/bodies.hpp"
#include "app/tool_tips.hpp"
#include "clouds/space/domain.hpp"
#include "core/error.hpp"
#include "core/index.hpp"
#include "core/machine/parallel.hpp"
#include "voronoi/space/tetrahedra.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <initializer_list>

namespace cnem::app {
namespace {

/// Bodies are parts of their own: nothing goes from one to another.
void keep_bodies_apart(const IndexedVector<NodeIndex, std::int32_t>& body,
                       adapt::NodeProperties& properties) {
  if (body.empty()) return;
  const std::int32_t bodies = 1 + *std::max_element(body.begin(), body.end());
  properties.part.resize(body.size(), 0);
  for (const NodeIndex i : body.indices()) properties.part[i] = properties.part[i] * bodies + body[i];
}

using Report = adapt::PassReport;
constexpr std::pair<const char*, int Report::*> counts[] = {
    {"cuts", &Report::cuts},           {"opened", &Report::opened},
    {"folded", &Report::folded},       {"outside", &Report::outside},
    {"removed", &Report::removed},     {"removed_boundary", &Report::removed_boundary},
    {"inserted", &Report::inserted},   {"inserted_boundary", &Report::inserted_boundary},
    {"flipped", &Report::flipped},     {"recut", &Report::recut},
    {"balanced", &Report::balanced},   {"undone", &Report::undone},
    {"crossings", &Report::crossings}, {"side_crossings", &Report::side_crossings}};

/// Those of the reference, which nodes that have moved by less than its strain have left sound: new ones
/// would need a boundary that is recovered.
std::vector<std::array<NodeIndex, 4>> tetrahedra(const Approximation<3>& approximation) {
  const std::vector<std::int32_t>& index = approximation.cells.index;
  std::vector<std::array<NodeIndex, 4>> list(index.size() / 4);
  for (std::size_t k = 0; k < index.size(); ++k) list[k / 4][k % 4] = as<NodeIndex>(index[k]);
  return list;
}

/// The pieces of the periods of a case.
std::vector<adapt::Period> periods_of(const input::Case& input, const Cloud<3>& cloud) {
  std::vector<adapt::Period> periods;
  for (const input::Periodicity& periodic : input.periodic) periods.push_back(sides_of(periodic, cloud));
  return periods;
}

/// Marks the nodes that supports hold for their own sake, and not for the boundary that they are on.
void hold_points(const Cloud<3>& cloud, const Supports<3>& supports, IndexedVector<NodeIndex, char>& held) {
  for (const Support<3>& support : supports.list()) {
    IndexedVector<NodeIndex, char> on_piece(held.size(), 0);
    for (const Facet<3>& facet : cloud.facets)
      if (std::find(support.pieces.begin(), support.pieces.end(), facet.piece) != support.pieces.end())
        for (const NodeIndex i : facet.node) on_piece[i] = 1;
    for (const NodeIndex i : support.nodes)
      if (!on_piece[i]) held[i] = 1;
  }
}

} // namespace

SpaceAdaptation::SpaceAdaptation(const input::Case& input, const ExplicitSolver<3>& solver) : input_(&input) {
  if (!active()) return;
  const clouds::SpaceSpacing spacing{input.cloud.spacing, input.cloud.space_refinements};
  for (const Vec3& x : solver.conditions().cloud.position) size_.push_back(spacing.at(x));
  if (input.adapt.indicator) wanted_ = size_;
}

void SpaceAdaptation::start_log(const std::filesystem::path& folder) {
  if (active()) log_.start(folder, results::history_units(input_->analysis), 3);
}

void SpaceAdaptation::resume_log(const std::filesystem::path& folder) {
  if (active()) log_.resume(folder, results::history_units(input_->analysis), 3);
}

Field SpaceAdaptation::refined_spacing(const ExplicitSolver<3>& solver, const Cloud<3>& cloud) {
  const input::Adaptation& rules = input_->adapt;
  const scni::CellKind cells = input_->method.options.cells;
  adapt::SpaceStructure structure;
  adapt::Indicator indicator;
  try {
    structure =
        adapt::structure_of(cloud, voronoi::connected(cloud, tetrahedra(solver.approximation())), cells);
    indicator = adapt::indicator(cloud, structure, cells, rules.indicator->values(solver.state().point));
  } catch (const GeometryError&) { // where nodes have passed each other there is nothing to estimate on
    estimate_.skip();
    return wanted_;
  }
  estimate_.mark<3>(rules, cloud, structure, std::move(indicator), size_);
  Field wanted = size_;
  limit_at_tools(solver, cloud, wanted);
  adapt::limit_growth<3>(cloud, structure, rules.growth, wanted);
  return wanted;
}

void SpaceAdaptation::limit_at_tools(const ExplicitSolver<3>& solver, const Cloud<3>& cloud,
                                     Field& wanted) const {
  const input::Adaptation& rules = input_->adapt;
  if (!rules.tool_spacing) return;
  for_each_block(wanted.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      if (const double reach = (wanted[i] - *rules.tool_spacing) / rules.growth; reach > 0.0)
        wanted[i] = *rules.tool_spacing +
                    rules.growth * distance_from_ridges(solver.conditions().contact,
                                                        cloud.position[as<NodeIndex>(i)], reach);
  });
}

double SpaceAdaptation::renew(ExplicitSolver<3>& solver, const Follow& follow) {
  const results::Audit<3> before = results::audit(solver);
  adapt::PassReport report;
  Cloud<3> cloud = solver.present_cloud();
  adapt::SpaceRules rules;
  rules.cells = input_->method.options.cells;
  rules.periods = periods_of(*input_, cloud);
  if (input_->adapt.separate) rules.separation.piece = fracture_piece(cloud);
  const Field size_before = size_;
  const Estimate estimate_before = estimate_;
  try {
    Field wanted = input_->adapt.indicator ? refined_spacing(solver, cloud) : size_;
    limit_at_tools(solver, cloud, wanted);
    adapt::NodeProperties properties = node_properties(*input_, solver, wanted);
    hold_points(cloud, solver.conditions().supports, properties.held);
    keep_bodies_apart(cloud.body, properties);
    const Resampling<3> change = adapt::resample(cloud, std::move(properties), rules, report);
    solver.prepare(change);
    if (input_->adapt.indicator) {
      wanted_ = wanted;
      for (Field* label : {&wanted_, &estimate_.error()})
        if (!label->empty()) carry_label(change.labels, *label);
    }
    carry_label(change.labels, size_);
    follow(change);
    ++passes_;
    total_ += report;
    log_.record(solver.state(), report, before, results::audit(solver));
    return share_changed(change);
  } catch (const GeometryError&) { // the surface that crosses itself is why most fail
    total_.crossings += report.crossings;
    total_.side_crossings += report.side_crossings;
    size_ = size_before;
    estimate_ = estimate_before;
    throw;
  }
}

void SpaceAdaptation::fit_to_tools(ExplicitSolver<3>& solver, const Follow& follow) {
  if (!input_->adapt.tool_spacing) return;
  try {
    renew_until_fitted(total_, [&] { renew(solver, follow); });
  } catch (const GeometryError&) {} // passes of the run go on with it
}

std::vector<std::pair<std::string, double>> SpaceAdaptation::metrics() const {
  if (!active()) return {};
  std::vector<std::pair<std::string, double>> list = log_.metrics();
  list.emplace_back("adapt.passes", static_cast<double>(passes_));
  for (const auto& [name, count] : counts) list.emplace_back(fmt::format("adapt.{}", name), total_.*count);
  list.emplace_back("adapt.volume_change", total_.volume_change);
  if (input_->adapt.indicator) estimate_.add_metrics(list);
  return list;
}

void SpaceAdaptation::archive(Archive& archive) {
  if (!active()) return;
  std::size_t nodes = size_.size();
  archive.integer("run/adapt/nodes", nodes);
  size_.resize(nodes);
  archive.field("run/adapt/size", "m", size_);
  if (input_->adapt.indicator) {
    wanted_.resize(nodes);
    archive.field("run/adapt/wanted", "m", wanted_);
    estimate_.archive(archive, nodes);
  }
  archive.integer("run/adapt/passes", passes_);
  log_.archive(archive);
  for (const auto& [name, count] : counts)
    archive.integer(fmt::format("run/adapt/count/{}", name), total_.*count);
  archive.number("run/adapt/volume_change", "m^3", total_.volume_change);
}

} // namespace cnem::app
