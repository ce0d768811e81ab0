#include "app/adaptation.hpp"

#include "core/error.hpp"
#include "mechanics/kinematics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cnem::app {

namespace {

std::size_t u(std::int32_t i) { return static_cast<std::size_t>(i); }

constexpr const char* fracture_piece = "fracture";

/// Nodes at which the boundary turns by more than 30 degrees.
std::vector<std::int32_t> corners(const Cloud<2>& cloud) {
  constexpr double least_cosine = 0.866;
  std::vector<std::int32_t> corner(cloud.position.size(), 0), next(corner.size(), -1);
  for (const Facet<2>& facet : cloud.facets) next[u(facet.node[0])] = facet.node[1];
  for (const Facet<2>& facet : cloud.facets) {
    const auto [a, b] = facet.node;
    const std::int32_t c = next[u(b)];
    const Vec2 in = (cloud.position[u(b)] - cloud.position[u(a)]).normalized(),
               out = (cloud.position[u(c)] - cloud.position[u(b)]).normalized();
    if (in.dot(out) < least_cosine) corner[u(b)] = 1;
  }
  return corner;
}

/// Mean distance to the neighbours each node is linked with.
Field spacing_of(const ExplicitSolver<2>& solver) {
  const StabilisationLinks<2>& links = solver.approximation().links;
  const std::vector<Vec2>& x = solver.model().cloud.position;
  Field size(x.size());
  for (std::size_t i = 0; i < size.size(); ++i) {
    double sum = 0.0;
    for (std::int32_t l = links.begin[i]; l < links.begin[i + 1]; ++l)
      sum += (x[u(links.neighbour[u(l)])] - x[i]).norm();
    size[i] = sum / static_cast<double>(links.begin[i + 1] - links.begin[i]);
  }
  return size;
}

/// Corners of a tool, and points along its arcs no further apart than `spacing`.
std::vector<Vec2> features(const Curve& outline, double spacing) {
  std::vector<Vec2> points;
  for (std::size_t k = 0; k < outline.pieces.size(); ++k) {
    const CurvePiece &piece = outline.pieces[k], &next = outline.pieces[(k + 1) % outline.pieces.size()];
    constexpr double smooth = 0.999;
    if (piece.tangent(1.0).dot(next.tangent(0.0)) < smooth) points.push_back(piece.to);
    if (!piece.is_arc()) continue;
    const int count = std::max(1, static_cast<int>(std::ceil(piece.length() / spacing)));
    for (int c = 0; c <= count; ++c) points.push_back(piece.point(static_cast<double>(c) / count));
  }
  return points;
}

} // namespace

Adaptation::Adaptation(const io::Case& input, const ExplicitSolver<2>& solver) : input_(&input) {
  if (!active()) return;
  if (input.adapt.tool_spacing)
    for (const io::Tool& tool : input.tools)
      tips_.push_back(features(tool.outline, *input.adapt.tool_spacing));
  wanted_ = size_ = spacing_of(solver);
  birth_.assign(size_.size(), 0.0);
  corner_ = corners(solver.model().cloud);
  coarsest_ = input.cloud.spacing > 0.0 ? input.cloud.spacing : *std::max_element(size_.begin(), size_.end());
}

adapt::NodeProperties Adaptation::properties(const ExplicitSolver<2>& solver, Field wanted) const {
  const State<2>& state = solver.state();
  const std::size_t n = state.node.size();
  adapt::NodeProperties properties;
  properties.mass = state.node.mass;
  properties.size = std::move(wanted);
  properties.held.assign(corner_.begin(), corner_.end());
  properties.log_jacobian.resize(n);
  properties.density.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    properties.log_jacobian[i] =
        std::log(jacobian<2>(state.point.deformation, i) / state.point.stress_free[i]);
    properties.density[i] = solver.model().materials[u(state.point.material[i])].density;
  }
  return properties;
}

double Adaptation::tool_limit(const ExplicitSolver<2>& solver, const Vec2& x) const {
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t t = 0; t < tips_.size(); ++t) {
    const Vec2& shift = solver.model().contact.results()[t].displacement;
    for (const Vec2& tip : tips_[t]) nearest = std::min(nearest, (tip + shift - x).norm());
  }
  return *input_->adapt.tool_spacing + input_->adapt.growth * nearest;
}

/// Estimates and marks. Where nodes have passed each other there is nothing to estimate on: resampling mends
/// that first.
Field Adaptation::wanted_spacing(const ExplicitSolver<2>& solver, const Cloud<2>& cloud) {
  const io::Adaptation& rules = input_->adapt;
  const bool indicator = rules.indicator != io::Adaptation::Indicator::none;
  if (!indicator && tips_.empty()) return size_;
  adapt::Structure structure;
  try {
    structure = adapt::build_structure(cloud);
  } catch (const GeometryError&) { return size_; }
  if (indicator) {
    const PointState<2>& point = solver.state().point;
    const Field& field = rules.indicator == io::Adaptation::Indicator::plastic_strain ? point.plastic_strain
                         : rules.indicator == io::Adaptation::Indicator::plastic_rate ? point.plastic_rate
                                                                                      : point.temperature;
    const adapt::Indicator estimate = adapt::indicator(cloud, structure, field);
    const adapt::Marking marking = adapt::mark(cloud, structure, estimate,
                                               {.tolerance = rules.tolerance,
                                                .coarsen = rules.coarsen,
                                                .h_min = rules.h_min,
                                                .h_max = rules.h_max,
                                                .max_nodes = rules.max_nodes},
                                               size_);
    refined_ += marking.refined;
    coarsened_ += marking.coarsened;
    error_ = estimate.error;
    error_total_ = estimate.total;
    error_norm_ = estimate.norm;
  }
  Field wanted = size_;
  if (!tips_.empty())
    for (std::size_t i = 0; i < wanted.size(); ++i)
      wanted[i] = std::min(wanted[i], tool_limit(solver, cloud.position[i]));
  adapt::limit_growth(cloud, structure, rules.growth, wanted);
  return wanted;
}

void Adaptation::change_to(const Resampling<2>& change, ExplicitSolver<2>& solver, const Follow& follow) {
  solver.prepare(change);
  if (!error_.empty()) carry_label(change.labels, error_);
  for (Field* label : {&size_, &wanted_, &birth_}) carry_label(change.labels, *label);
  for (std::size_t p = 0; p < change.old_of.size(); ++p)
    if (change.old_of[p] < 0) birth_[p] = solver.state().time;
  std::vector<std::int32_t> corner(change.old_of.size(), 0);
  for (std::size_t p = 0; p < corner.size(); ++p)
    if (change.old_of[p] >= 0) corner[p] = corner_[u(change.old_of[p])];
  corner_ = std::move(corner);
  follow(change);
}

/// Points that carry nothing any more (softening 1) are where the cloud may part.
void Adaptation::open_broken(ExplicitSolver<2>& solver, const Follow& follow) {
  const Field& softening = solver.state().point.softening;
  if (!input_->adapt.separate ||
      std::none_of(softening.begin(), softening.end(), [](double w) { return w >= 1.0; }))
    return;
  Cloud<2> cloud = solver.present_cloud();
  const auto faces = std::find(cloud.piece_names.begin(), cloud.piece_names.end(), fracture_piece);
  adapt::SplitRules rules;
  rules.piece = static_cast<std::int32_t>(faces - cloud.piece_names.begin());
  if (faces == cloud.piece_names.end()) cloud.piece_names.emplace_back(fracture_piece);
  adapt::SplitReport report;
  try {
    const Resampling<2> change = adapt::split(cloud, properties(solver, wanted_), softening, rules, report);
    if (report.opened > 0) change_to(change, solver, follow);
  } catch (const GeometryError&) { return; } // resampling mends the cloud first
  opened_ += report.opened;
  separated_ += report.separated;
  total_.area_change += report.area_change;
}

void Adaptation::renew(ExplicitSolver<2>& solver, const Follow& follow) {
  open_broken(solver, follow);
  adapt::PassReport report;
  const Cloud<2> cloud = solver.present_cloud();
  const Field size_before = size_, wanted_before = wanted_;
  try {
    wanted_ = wanted_spacing(solver, cloud);
    change_to(adapt::resample(cloud, properties(solver, wanted_), {},
                              static_cast<adapt::Placement>(input_->adapt.placement), report),
              solver, follow);
  } catch (const GeometryError&) {
    size_ = size_before;
    wanted_ = wanted_before;
    throw;
  }
  ++passes_;
  total_ += report;
}

void Adaptation::fit_to_tools(ExplicitSolver<2>& solver, const Follow& follow) {
  if (tips_.empty()) return;
  constexpr int most = 20;
  for (int pass = 0; pass < most; ++pass) {
    const int inserted = total_.inserted + total_.inserted_boundary;
    renew(solver, follow);
    if (total_.inserted + total_.inserted_boundary == inserted) break;
  }
}

AdaptationFields Adaptation::fields(double time) const {
  AdaptationFields fields;
  fields.level.resize(size_.size());
  fields.age.resize(size_.size());
  for (std::size_t i = 0; i < size_.size(); ++i) {
    fields.level[i] = std::log2(coarsest_ / wanted_[i]);
    fields.age[i] = time - birth_[i];
  }
  fields.indicator = error_.empty() ? Field(size_.size(), 0.0) : error_;
  return fields;
}

std::vector<std::pair<std::string, double>> Adaptation::metrics() const {
  if (!active()) return {};
  return {{"adapt.passes", static_cast<double>(passes_)},
          {"adapt.folded", total_.folded},
          {"adapt.outside", total_.outside},
          {"adapt.removed", total_.removed},
          {"adapt.removed_boundary", total_.removed_boundary},
          {"adapt.promoted", total_.promoted},
          {"adapt.inserted", total_.inserted},
          {"adapt.inserted_boundary", total_.inserted_boundary},
          {"adapt.balanced", total_.balanced},
          {"adapt.undone", total_.undone},
          {"adapt.area_change", total_.area_change},
          {"adapt.opened", opened_},
          {"adapt.separated", separated_},
          {"adapt.refined", static_cast<double>(refined_)},
          {"adapt.coarsened", static_cast<double>(coarsened_)},
          {"adapt.error", error_norm_ > 0.0 ? error_total_ / error_norm_ : 0.0}};
}

void Adaptation::archive(Archive& archive) {
  if (!active()) return;
  archive.integers("run/adapt/corner", corner_);
  if (archive.loading()) {
    size_.resize(corner_.size());
    wanted_.resize(corner_.size());
    birth_.resize(corner_.size());
  }
  if (input_->adapt.indicator != io::Adaptation::Indicator::none) {
    archive.integer("run/adapt/refined", refined_);
    archive.integer("run/adapt/coarsened", coarsened_);
    archive.number("run/adapt/error_total", "m", error_total_);
    archive.number("run/adapt/error_norm", "m", error_norm_);
    error_.resize(corner_.size());
    archive.field("run/adapt/error", "m", error_);
  }
  archive.field("run/adapt/size", "m", size_);
  archive.field("run/adapt/wanted", "m", wanted_);
  archive.field("run/adapt/birth", "s", birth_);
  archive.integer("run/adapt/passes", passes_);
  archive.integer("run/adapt/opened", opened_);
  archive.integer("run/adapt/separated", separated_);
  for (auto& [name, count] : {std::pair{"folded", &total_.folded},
                              {"outside", &total_.outside},
                              {"removed", &total_.removed},
                              {"removed_boundary", &total_.removed_boundary},
                              {"promoted", &total_.promoted},
                              {"inserted", &total_.inserted},
                              {"inserted_boundary", &total_.inserted_boundary},
                              {"balanced", &total_.balanced},
                              {"undone", &total_.undone}})
    archive.integer(fmt::format("run/adapt/count/{}", name), *count);
  archive.number("run/adapt/area_change", "m^2", total_.area_change);
}

} // namespace cnem::app
