#include "app/adaptation.hpp"

#include "adapt/plane/indicator.hpp"
#include "app/adaptation_parts.hpp"
#include "app/tool_tips.hpp"
#include "core/error.hpp"
#include "core/index.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <initializer_list>
#include <limits>
#include <optional>
#include <utility>

namespace cnem::app {

namespace {

/// Throws an error that is being handled again, with the interface whose faces were left in each other.
[[noreturn]] void refuse(const GeometryError& error, const std::string& left) {
  if (left.empty()) throw;
  throw GeometryError(
      fmt::format("{}; the faces of the interface '{}' could not be set apart", error.what(), left));
}

/// Nodes at which the boundary turns by more than 30 degrees.
IndexedVector<NodeIndex, std::int32_t> corners(const Cloud<2>& cloud) {
  constexpr double least_cosine = 0.866;
  IndexedVector<NodeIndex, std::int32_t> corner(cloud.position.size(), 0);
  IndexedVector<NodeIndex, NodeIndex> next(corner.size(), NodeIndex::none);
  for (const Facet<2>& facet : cloud.facets) next[facet.node[0]] = facet.node[1];
  for (const Facet<2>& facet : cloud.facets) {
    const auto [a, b] = facet.node;
    const NodeIndex c = next[b];
    const Vec2 in = (cloud.position[b] - cloud.position[a]).normalized(),
               out = (cloud.position[c] - cloud.position[b]).normalized();
    if (in.dot(out) < least_cosine) corner[b] = 1;
  }
  return corner;
}

/// Faces of a crack that have gone apart do not belong together any more, nor those where cuts may end.
/// broken: at nodes; empty where nothing is cut.
void part_faces(Cloud<2>& cloud, const Ties<2>& ties, const Field& broken) {
  constexpr double apart = 1e-3; // of a facet, as faces that separation makes
  const auto tied = [&](NodeIndex a, NodeIndex b) {
    return !ties.empty() && ties.group()[a] >= 0 && ties.group()[a] == ties.group()[b];
  };
  for (const CloudFacetIndex f : cloud.mates.indices()) {
    if (!exists(cloud.mates[f])) continue;
    const auto [a, b] = cloud.facets[f].node;
    const auto [c, d] = cloud.facets[cloud.mates[f]].node;
    const auto at = [&](NodeIndex i) -> const Vec2& { return cloud.position[i]; };
    if (tied(a, d) && tied(b, c)) continue;
    const std::array ends{a, b, c, d};
    if (std::max((at(a) - at(d)).norm(), (at(b) - at(c)).norm()) > apart * (at(b) - at(a)).norm() ||
        (!broken.empty() &&
         std::any_of(ends.begin(), ends.end(), [&](NodeIndex i) { return broken[index_of(i)] >= 1.0; })))
      cloud.mates[std::exchange(cloud.mates[f], CloudFacetIndex::none)] = CloudFacetIndex::none;
  }
}

/// Of nodes that share the points around them.
adapt::NodeProperties shares_of(const ExplicitSolver<2>& solver) {
  const NodeState<2>& node = solver.state().node;
  adapt::NodeProperties properties;
  properties.mass = properties.matter = node.mass;
  for (std::size_t i = 0; i < node.size(); ++i) properties.matter[i] *= solver.volume_ratio(i);
  for (Field* same : {&properties.jacobian, &properties.density, &properties.size})
    same->assign(node.size(), 1.0);
  properties.held.assign(node.size(), 0);
  return properties;
}

} // namespace

Adaptation::Adaptation(const input::Case& input, const ExplicitSolver<2>& solver) : input_(&input) {
  if (!active()) return;
  if (input.adapt.tool_spacing)
    for (const input::Tool& tool : input.tools)
      tips_.push_back(tool_tips(tool.outline, *input.adapt.tool_spacing));
  const Cloud<2>& cloud = solver.conditions().cloud;
  wanted_ = size_ = adapt::spacing_of(cloud, adapt::build_structure(cloud, input.analysis.space()));
  birth_.assign(size_.size(), 0.0);
  corner_ = corners(cloud);
  if (follows_flow()) flow_ = adapt::Flow(size_.size());
  if (input.adapt.rest_factor > 0.0) first_ = size_;
  if (input.adapt.window) window_.emplace(input);
  coarsest_ = input.cloud.spacing > 0.0 ? input.cloud.spacing : *std::max_element(size_.begin(), size_.end());
}

void Adaptation::start_log(const std::filesystem::path& folder) {
  if (active()) log_.start(folder, results::history_units(input_->analysis), 2);
}

void Adaptation::resume_log(const std::filesystem::path& folder) {
  if (active()) log_.resume(folder, results::history_units(input_->analysis), 2);
}

adapt::NodeProperties Adaptation::properties(const ExplicitSolver<2>& solver, Field wanted) const {
  adapt::NodeProperties properties = node_properties(*input_, solver, std::move(wanted));
  properties.held.assign(corner_.begin(), corner_.end());
  return properties;
}

double Adaptation::tool_limit(const ExplicitSolver<2>& solver, const Vec2& x) const {
  double nearest = std::numeric_limits<double>::infinity(); // squared
  for (std::size_t t = 0; t < tips_.size(); ++t)
    nearest = std::min(nearest,
                       squared_distance(tips_[t], solver.conditions().contact.results()[t].displacement, x));
  return *input_->adapt.tool_spacing + input_->adapt.growth * std::sqrt(nearest);
}

void Adaptation::estimate_and_mark(const ExplicitSolver<2>& solver, const Cloud<2>& cloud,
                                   const adapt::Structure& structure) {
  estimate_.mark<2>(input_->adapt, cloud, structure,
                    adapt::indicator(cloud, structure, input_->adapt.indicator->values(solver.state().point)),
                    size_);
}

Field Adaptation::wanted_spacing(const ExplicitSolver<2>& solver, const Cloud<2>& cloud,
                                 const adapt::Structure& structure) const {
  const input::Adaptation& rules = input_->adapt;
  Field wanted = size_;
  if (rules.rest_factor > 0.0) {
    constexpr double least = 0.01; // what was strained less has not flowed
    const PointState<2>& point = solver.state().point;
    // bands that broke keep their cells: mixed with what is whole beside them they would be smeared
    const Field lost = lost_share(point);
    const auto whole = [&](std::size_t i) { return lost.empty() || lost[i] == 0.0; };
    for (std::size_t i = 0; i < wanted.size(); ++i)
      if (flow_.rests(i) && point.plastic_strain[i] > least && whole(i))
        wanted[i] = std::max(wanted[i], rules.rest_factor * first_[i]);
  }
  if (rules.surface_spacing) {
    IndexedVector<NodeIndex, char> free(wanted.size(), 0);
    for (const CloudFacetIndex f : cloud.facets.indices())
      if (cloud.mates.empty() || !exists(cloud.mates[f]))
        for (const NodeIndex i : cloud.facets[f].node) free[i] = 1;
    for (const auto& held : solver.conditions().supports.prescribed()) free[held.node] = 0;
    for (const NodeIndex i : free.indices())
      if (free[i] && !flow_.rests(index_of(i)))
        wanted[index_of(i)] = std::min(wanted[index_of(i)], *rules.surface_spacing);
  }
  if (!tips_.empty())
    for (std::size_t i = 0; i < wanted.size(); ++i)
      wanted[i] = std::min(wanted[i], tool_limit(solver, cloud.position[i]));
  adapt::limit_growth<2>(cloud, structure, rules.growth, wanted);
  return wanted;
}

void Adaptation::move_window(ExplicitSolver<2>& solver, const Follow& follow) {
  using End = MovingWindow::End;
  for (const End end : {End::ahead, End::behind, End::chip}) {
    const std::optional<Resampling<2>> change =
        window_->next(end, solver, solver.present_cloud(), properties(solver, wanted_));
    if (!change) continue;
    solver.prepare(*change);
    follow_nodes(*change, solver.state().time);
    follow(*change);
  }
}

double Adaptation::renew(ExplicitSolver<2>& solver, const Follow& follow) {
  const std::string left = solver.part_faces();
  const results::Audit<2> before = results::audit(solver);
  if (window_) move_window(solver, follow);
  adapt::PassReport report;
  double changed = 0.0;
  Cloud<2> cloud = solver.present_cloud();
  part_faces(cloud, solver.conditions().ties,
             input_->adapt.separate ? lost_share(solver.state().point) : Field());
  const Field size_before = size_;
  const adapt::Flow flow_before = flow_;
  try {
    std::optional<adapt::Structure> structure = adapt::structure_if_valid(cloud, input_->analysis.space());
    Field wanted = wanted_; // where nodes have passed each other there is nothing to estimate on
    if (structure) {
      if (input_->adapt.indicator) estimate_and_mark(solver, cloud, *structure);
      if (follows_flow()) flow_.look(solver.state().point, *structure, solver.state().time);
      wanted = wanted_spacing(solver, cloud, *structure);
    }
    adapt::ResampleRules rules;
    rules.space = input_->analysis.space();
    rules.placement = input_->adapt.placement;
    if (input_->adapt.separate) rules.split.piece = fracture_piece(cloud);
    rules.split.cracks = input_->adapt.cracks;
    rules.split.thinnest_film = input_->adapt.thinnest_film;
    const Resampling<2> change =
        adapt::resample(cloud, std::move(structure), properties(solver, wanted), rules, report);
    solver.prepare(change);
    wanted_ = std::move(wanted);
    follow_nodes(change, solver.state().time);
    follow(change);
    changed = share_changed(change);
  } catch (const GeometryError& error) {
    size_ = size_before;
    flow_ = flow_before;
    refuse(error, left);
  }
  ++passes_;
  total_ += report;
  log_.record(solver.state(), report, before, results::audit(solver));
  return changed;
}

void Adaptation::balance(ExplicitSolver<2>& solver) {
  const std::string left = solver.part_faces();
  try {
    balance_parted(solver);
  } catch (const GeometryError& error) { refuse(error, left); }
}

void Adaptation::balance_parted(ExplicitSolver<2>& solver) {
  const Promises& promises = solver.model().method->promises();
  if (!solver.model().mechanical || !promises.keep(Promise::tiling_cells)) return solver.prepare();
  const bool at_nodes = promises.keep(Promise::identity_values);
  const adapt::Thresholds thresholds;
  if (!at_nodes) { // what their shares of new points hold is known once there are these
    solver.prepare();
    const auto [low, high] = solver.mass_balance();
    if (low >= thresholds.light && high <= thresholds.heavy) return;
  }
  const Cloud<2> cloud = solver.present_cloud();
  const adapt::Structure structure = adapt::build_structure(cloud, input_->analysis.space());
  adapt::PassReport report;
  if (const auto change = adapt::balanced(
          cloud, structure, at_nodes ? properties(solver, {}) : shares_of(solver), thresholds, report))
    solver.prepare(*change);
  else if (at_nodes)
    solver.prepare();
  total_ += report;
}

void Adaptation::follow_nodes(const Resampling<2>& change, double time) {
  for (Field* label : {&estimate_.error(), &size_, &first_, &wanted_, &birth_})
    if (!label->empty()) carry_label(change.labels, *label);
  if (follows_flow()) flow_.resample(change);
  // a body that was cut has new corners
  auto corner =
      change.open() ? corners(change.cloud) : IndexedVector<NodeIndex, std::int32_t>(change.old_of.size(), 0);
  for (std::size_t p = 0; p < corner.size(); ++p)
    if (exists(change.old_of[p]))
      corner[p] = corner_[change.old_of[p]];
    else
      birth_[p] = time;
  corner_ = std::move(corner);
}

void Adaptation::fit_to_tools(ExplicitSolver<2>& solver, const Follow& follow) {
  if (tips_.empty()) return;
  renew_until_fitted(total_, [&] { renew(solver, follow); });
}

AdaptationFields Adaptation::fields(double time) const {
  AdaptationFields fields;
  fields.level.resize(size_.size());
  fields.age.resize(size_.size());
  for (std::size_t i = 0; i < size_.size(); ++i) {
    fields.level[i] = std::log2(coarsest_ / wanted_[i]);
    fields.age[i] = time - birth_[i];
  }
  fields.indicator = estimate_.error_at(size_.size());
  return fields;
}

std::vector<std::pair<std::string, double>> Adaptation::metrics() const {
  if (!active()) return {{"mass_exchanges", total_.balanced}};
  std::vector<std::pair<std::string, double>> list = log_.metrics();
  for (const auto& [name, value] : std::initializer_list<std::pair<std::string, double>>{
           {"adapt.passes", static_cast<double>(passes_)},
           {"adapt.cracks", total_.cracks},
           {"adapt.advances", total_.advances},
           {"adapt.cuts", total_.cuts},
           {"adapt.opened", total_.opened},
           {"adapt.films", total_.films},
           {"adapt.crumbs", total_.crumbs},
           {"adapt.folded", total_.folded},
           {"adapt.outside", total_.outside},
           {"adapt.removed", total_.removed},
           {"adapt.removed_boundary", total_.removed_boundary},
           {"adapt.promoted", total_.promoted},
           {"adapt.inserted", total_.inserted},
           {"adapt.inserted_boundary", total_.inserted_boundary},
           {"adapt.balanced", total_.balanced},
           {"adapt.undone", total_.undone},
           {fmt::format("adapt.{}_change", results::history_units(input_->analysis).enclosed),
            total_.volume_change}})
    list.emplace_back(name, value);
  estimate_.add_metrics(list);
  if (window_)
    for (auto& metric : window_->metrics()) list.push_back(std::move(metric));
  return list;
}

void Adaptation::archive(Archive& archive) {
  if (!active()) return archive.integer("run/adapt/count/balanced", total_.balanced);
  archive.integers("run/adapt/corner", corner_);
  if (archive.loading()) {
    size_.resize(corner_.size());
    wanted_.resize(corner_.size());
    birth_.resize(corner_.size());
  }
  if (input_->adapt.indicator) estimate_.archive(archive, corner_.size());
  if (follows_flow()) flow_.archive(archive, corner_.size());
  if (input_->adapt.rest_factor > 0.0) {
    if (archive.loading()) first_.resize(corner_.size());
    archive.field("run/adapt/first", "m", first_);
  }
  archive.field("run/adapt/size", "m", size_);
  archive.field("run/adapt/wanted", "m", wanted_);
  archive.field("run/adapt/birth", "s", birth_);
  archive.integer("run/adapt/passes", passes_);
  if (window_) window_->archive(archive);
  log_.archive(archive);
  for (auto& [name, count] : {std::pair{"cracks", &total_.cracks},
                              {"advances", &total_.advances},
                              {"cuts", &total_.cuts},
                              {"opened", &total_.opened},
                              {"films", &total_.films},
                              {"crumbs", &total_.crumbs},
                              {"folded", &total_.folded},
                              {"outside", &total_.outside},
                              {"removed", &total_.removed},
                              {"removed_boundary", &total_.removed_boundary},
                              {"promoted", &total_.promoted},
                              {"inserted", &total_.inserted},
                              {"inserted_boundary", &total_.inserted_boundary},
                              {"balanced", &total_.balanced},
                              {"undone", &total_.undone}})
    archive.integer(fmt::format("run/adapt/count/{}", name), *count);
  archive.number("run/adapt/volume_change", "m^2", total_.volume_change);
}

} // namespace cnem::app
