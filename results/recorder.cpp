#include "results/recorder.hpp"

#include "core/error.hpp"
#include "core/index.hpp"
#include "results/fields.hpp"
#include "results/output_folder.hpp"
#include "results/tool_fields.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <utility>

namespace cnem::results {

namespace {

template<int dim> std::array<std::span<const double>, dim> spans(const Fields<dim>& field) {
  std::array<std::span<const double>, dim> all;
  std::copy(field.begin(), field.end(), all.begin());
  return all;
}

/// As VTK knows vectors, whose third component is zero in the plane.
template<int dim> VectorField vector_field(const char* name, const Fields<dim>& field) {
  VectorField all{name, {field.begin(), field.end()}};
  all.component.resize(3);
  return all;
}

/// Adds a field to those of cells or nodes: as one of its own, or as a component of an array.
template<int dim>
void add_field(const FieldInfo<dim>& info, const Field& values, std::vector<ScalarField>& scalars,
               std::vector<VectorField>& vectors) {
  const FileArray array = array_in_files(info);
  if (info.part.label.empty()) {
    scalars.push_back({array.name, values});
    return;
  }
  auto known = std::find_if(vectors.begin(), vectors.end(),
                            [&](const VectorField& vector) { return vector.name == array.name; });
  if (known == vectors.end())
    known = vectors.insert(vectors.end(), {array.name, {}, info.part.component_names});
  known->component.resize(known->component_names.size());
  known->component[array.component] = values;
}

std::vector<ToolOutline> tool_outlines(const input::Case& input, const Snapshot<2>& shot) {
  std::vector<ToolOutline> outlines;
  for (std::size_t t = 0; t < shot.contact.tools().size(); ++t)
    outlines.push_back({input.tools[t].name, input.tools[t].outline.polygon(),
                        shot.contact.displacement(t, shot.state.time),
                        shot.contact.velocity(t, shot.state.time)});
  return outlines;
}

std::vector<std::string> columns_of(const std::vector<Metric>& told) {
  std::vector<std::string> names;
  for (const Metric& metric : told)
    if (!metric.name.empty()) names.push_back(metric.name);
  return names;
}

template<int dim>
std::vector<ProbeWeights> probe_weights(const input::Case& input, const Approximation<dim>& approximation,
                                        const Cloud<dim>& cloud) {
  std::vector<ProbeWeights> probes;
  if (input.output.probes.empty()) return probes;
  const PointLocator<dim> locator(cloud, approximation.cells);
  for (const input::Probe& probe : input.output.probes) {
    try {
      probes.push_back({locator.weights(probe.at.head<dim>()), probe.name, probe.fields});
    } catch (const GeometryError& error) {
      throw input.error("output.probes." + probe.name + ".at", error.what());
    }
  }
  return probes;
}

double extent(const Field& x) {
  const auto [low, high] = std::minmax_element(x.begin(), x.end());
  return *high - *low;
}

bool expands(const std::vector<plasticity::Material>& materials) {
  return std::any_of(materials.begin(), materials.end(),
                     [](const plasticity::Material& material) { return material.expansion != 0.0; });
}

template<int dim> double total_mass(const ExplicitSolver<dim>& solver) {
  double mass = 0.0;
  for (const double m : solver.state().node.mass) mass += m;
  return mass;
}

} // namespace

template<int dim> double heat_residual_share(const ExplicitSolver<dim>& solver) {
  const NodeState<dim>& node = solver.state().node;
  const EnergyLedger ledger = solver.ledger();
  double moved = 0.0;
  for (std::size_t i = 0; i < node.size(); ++i)
    moved += node.heat_capacity[i] * std::abs(node.temperature[i] - node.initial_temperature[i]);
  for (const Energy& entry : ledger.entries())
    if (entry.kind == EnergyKind::heat_received) moved = std::max(moved, std::abs(entry.value));
  return moved > 0.0 ? std::abs(ledger.heat_residual()) / moved : 0.0;
}

template<int dim>
HistoryRecorder<dim>::HistoryRecorder(const input::Case& input, const ExplicitSolver<dim>& solver,
                                      const std::filesystem::path& folder, bool keep)
    : units_(history_units(input.analysis)),
      probes_(probe_weights<dim>(input, solver.approximation(), solver.conditions().cloud)), log_(keep),
      folder_(folder), initial_measure_(enclosed_measure(snapshot(solver))),
      initial_mass_(total_mass(solver)) {}

template<int dim> std::vector<Metric> HistoryRecorder<dim>::row(const ExplicitSolver<dim>& solver) const {
  const State<dim>& state = solver.state();
  const std::array<double, 2> balance = solver.mass_balance();
  std::vector<Metric> row{{"time[s]", state.time},
                          {"step", static_cast<double>(state.step)},
                          {"dt[s]", state.step_before},
                          {"nodes", static_cast<double>(state.node.size())},
                          {"", kinetic_share(), "kinetic_share"},
                          {"", balance[0], "mass_balance.low"},
                          {"", balance[1], "mass_balance.high"}};
  const auto components = [&](const std::string& name, const Vec<dim>& vector, const std::string& unit) {
    for (int k = 0; k < dim; ++k)
      row.push_back({fmt::format("{}_{}{}", name, axis_name(index_of(k)), unit), vector[k]});
  };
  const auto& contact = solver.conditions().contact;
  for (std::size_t t = 0; t < contact.tools().size(); ++t) {
    const std::string& name = contact.tools()[t].name;
    const auto& result = contact.results()[t];
    components(name + ".force", result.force, units_.force);
    row.push_back({"", result.force.norm(), "peak_force." + name + units_.force, Keep::largest});
    row.push_back({name + ".stroke[m]", contact.displacement(t, state.time).norm()});
    components(name + ".displacement", contact.displacement(t, state.time), "[m]");
    components(name + ".velocity", contact.velocity(t, state.time), "[m/s]");
    row.push_back({name + ".work" + units_.energy, result.total.tool});
    const contact::Tool<dim>& tool = contact.tools()[t];
    if (!tool.drive || !tool.drive->spring) continue;
    row.push_back({name + ".slide_stroke[m]", tool.motion.displacement(state.time).norm()});
    row.push_back({name + ".spring_force" + units_.force, contact.spring_force(t, state.time)});
  }
  if (contact.bodies_touch())
    row.push_back({"body_contact.pressing" + units_.force, contact.body_result().pressing});
  const auto& supports = solver.conditions().supports;
  for (std::size_t s = 0; s < supports.list().size(); ++s) {
    if (s > 0 && supports.list()[s].name == supports.list()[s - 1].name) continue;
    Vec<dim> force = Vec<dim>::Zero();
    for (std::size_t o = s; o < supports.list().size(); ++o)
      if (supports.list()[o].name == supports.list()[s].name) force += supports.reactions()[o];
    components("support." + supports.list()[s].name + ".force", force, units_.force);
  }
  const EnergyLedger e = solver.ledger();
  for (const Energy& entry : e.entries())
    if (entry.kind != EnergyKind::noted)
      row.push_back({fmt::format("energy.{}{}", entry.name, units_.energy), entry.value});
  row.push_back({"energy.residual" + units_.energy, e.residual()});
  row.push_back({"kinetic_share", e.kinetic_share()});
  for (Metric& metric : solver.metrics()) row.push_back(std::move(metric));
  for (const std::string name : {"plastic_strain", "temperature"})
    row.push_back({with_unit("max." + name, field_info<dim>(name).unit),
                   largest_value(snapshot(solver), name),
                   with_unit("max_" + name, field_info<dim>(name).unit), Keep::largest});
  if (!state.point.damage.empty()) {
    row.push_back({"max.damage", *std::max_element(state.point.damage.begin(), state.point.damage.end()),
                   "max_damage", Keep::largest});
    row.push_back({units_.broken + units_.measure, broken_measure(snapshot(solver)),
                   units_.broken + units_.measure, Keep::largest});
  }
  for (const ProbeWeights& probe : probes_)
    for (const std::string& name : probe.fields)
      row.push_back({with_unit(fmt::format("probe.{}.{}", probe.name, name), field_info<dim>(name).unit),
                     weighted_value(snapshot(solver), name, probe.node, probe.weight)});
  const double mass = total_mass(solver), enclosed = enclosed_measure(snapshot(solver));
  for (int k = 0; k < dim; ++k) {
    const auto axis = index_of(k);
    row.push_back({"", extent(state.node.position[axis]), fmt::format("extent.{}[m]", axis_name(axis))});
    row.push_back({"", extent(state.node.initial_position[axis]),
                   fmt::format("initial_extent.{}[m]", axis_name(axis))});
  }
  row.push_back({"mass" + units_.mass, mass});
  row.push_back({"", (mass + state.departed.mass) / initial_mass_ - 1.0, "mass_drift"});
  row.push_back({units_.enclosed + units_.measure, enclosed});
  row.push_back(
      {"", (enclosed + state.departed.volume) / initial_measure_ - 1.0, units_.enclosed + "_drift"});
  return row;
}

template<int dim> void HistoryRecorder<dim>::keep(const Metric& metric) {
  if (metric.kept_as.empty()) return;
  for (auto& [known, kept] : metrics_)
    if (known == metric.kept_as) {
      kept = metric.keep == Keep::largest ? std::max(kept, metric.value) : metric.value;
      return;
    }
  metrics_.emplace_back(metric.kept_as, metric.value);
}

template<int dim> void HistoryRecorder<dim>::record(const ExplicitSolver<dim>& solver) {
  const EnergyLedger e = solver.ledger();
  last_residual_ = e.residual();
  worst_residual_ = std::max(worst_residual_, std::abs(last_residual_));
  scale_ = std::max(scale_, std::abs(e.external()) + e.initial());
  if (expands(solver.model().materials)) heat_ = std::max(heat_, std::abs(e["heat_content"]));

  const double now = solver.state().time;
  kinetic_ += e["inertial"] * (now - last_time_);
  deformation_ += e.deformation() * (now - last_time_);
  last_time_ = now;

  const std::vector<Metric> told = row(solver);
  for (const Metric& metric : told) keep(metric);
  if (!log_.begun()) log_.start(file_in(folder_, files::history), columns_of(told));
  std::vector<double> values;
  values.reserve(told.size());
  for (const Metric& metric : told)
    if (!metric.name.empty()) values.push_back(metric.value);
  log_.write(values);
  ++rows_;
}

template<int dim>
void HistoryRecorder<dim>::resample(const Resampling<dim>& change, const ExplicitSolver<dim>& solver) {
  if (probes_.empty()) return;
  const PointLocator<dim> locator(solver.conditions().cloud, solver.approximation().cells);
  for (ProbeWeights& probe : probes_) follow<dim>(change, locator, probe);
}

template<int dim> void HistoryRecorder<dim>::archive(Archive& archive) {
  for (ProbeWeights& probe : probes_) {
    archive.integers(fmt::format("run/history/probe/{}/node", probe.name), probe.node);
    archive.list(fmt::format("run/history/probe/{}/weight", probe.name), "1", probe.weight);
  }
  archive.integer("run/history/rows", rows_);
  archive.number("run/history/initial_area", "m^2", initial_measure_);
  archive.number("run/history/initial_mass", "kg/m", initial_mass_);
  archive.number("run/history/worst_residual", "J/m", worst_residual_);
  archive.number("run/history/last_residual", "J/m", last_residual_);
  archive.number("run/history/scale", "J/m", scale_);
  archive.number("run/history/heat", "J/m", heat_);
  archive.number("run/history/last_time", "s", last_time_);
  archive.number("run/history/kinetic", "J s/m", kinetic_);
  archive.number("run/history/deformation", "J s/m", deformation_);
  std::vector<std::string> names;
  for (const auto& [name, value] : metrics_) names.push_back(name);
  archive.texts("run/history/metrics", names);
  metrics_.resize(names.size());
  for (std::size_t k = 0; k < names.size(); ++k) {
    metrics_[k].first = names[k];
    archive.number(fmt::format("run/history/metric/{}", k), "SI", metrics_[k].second);
  }
}

template<int dim> void HistoryRecorder<dim>::resume(const ExplicitSolver<dim>& solver) {
  log_.resume(file_in(folder_, files::history), columns_of(row(solver)), rows_);
}

template<int dim> EnergyScale HistoryRecorder<dim>::energy_scale() const {
  constexpr double rest = 1e-7; // m/s
  const double resting = 0.5 * initial_mass_ * rest * rest;
  // What heat does by expansion is in no entry of the ledger: it is small beside the heat.
  if (heat_ > std::max(scale_, resting)) return {heat_, "the heat taken up, more than the work done"};
  if (scale_ > resting) return {scale_, "the work done"};
  return {resting, "the energy of a body at rest, where nothing has done work"};
}

template<int dim> double HistoryRecorder<dim>::energy_residual() const {
  return worst_residual_ / energy_scale().energy;
}

template<int dim> std::string HistoryRecorder<dim>::kinetic_warning(const input::Case& input) const {
  constexpr double small = 0.05;
  if (!input.time.quasi_static || kinetic_share() <= small) return "";
  const bool scaled = input.time.mass_scaling.has_value();
  return fmt::format(
      "{}the kinetic energy is {:.2g} of the deformation energy on average, which should be below {:g} where "
      "inertia is not meant to act (time.quasi_static): forces hold inertia; {}move more slowly",
      scaled ? "with time.mass_scaling " : "", kinetic_share(), small, scaled ? "scale less, or " : "");
}

template<int dim> void FieldRecorder::record(FileQueue& files, const Snapshot<dim>& shot) {
  if (writer_.has(shot.state.time)) return;
  struct Kept {
    FieldFrame<dim> frame;
    CellGeometry<dim> cells;
    Fields<dim> position, initial, springback;
    std::vector<Field> values;
  };
  const auto kept = std::make_shared<Kept>();
  kept->cells = shot.approximation.cells;
  kept->position = shot.state.node.position;
  kept->values.reserve(2 * field_catalogue<dim>().size());
  FieldFrame<dim>& frame = kept->frame;
  frame.time = shot.state.time;
  frame.cells = &kept->cells;
  frame.position = spans<dim>(kept->position);
  if (shot.displacement_scale != 1.0) {
    kept->initial = shot.state.node.initial_position;
    frame.initial = spans<dim>(kept->initial);
  }
  frame.origin = input_->origin;
  for (const FieldInfo<dim>& info : field_catalogue<dim>()) {
    if (info.adaptive && !shot.adaptation) continue;
    if (info.switched && info.kept({shot.state, shot.adaptation})->empty()) continue;
    const Field& at_points = kept->values.emplace_back(values_at_points(shot, info.name));
    if (!kept->cells.between_points) add_field(info, at_points, frame.cell_scalars, frame.cell_vectors);
    const Field& at_nodes = shot.approximation.mechanics.nodal
                                ? at_points
                                : kept->values.emplace_back(values_at_nodes(shot, info.name));
    add_field(info, at_nodes, frame.node_scalars, frame.node_vectors);
  }
  if (shot.springback) {
    kept->springback = *shot.springback;
    frame.node_vectors.push_back(vector_field<dim>("springback [m]", kept->springback));
  }
  if constexpr (dim == 2) frame.tools = tool_outlines(*input_, shot);
  if constexpr (dim == 3) {
    if (input_->output.surface)
      for (const Facet<3>& facet : shot.cloud.facets) frame.surface.push_back(facet.node);
    if (input_->output.polyhedra)
      frame.polyhedra =
          polyhedra(input_->method.options.cells == scni::CellKind::voronoi ? PolyhedraOf::voronoi_cells
                                                                            : PolyhedraOf::median_cells,
                    shot.cloud, tetrahedra_of(shot.approximation.cells), kept->position);
  }
  writer_.write(files, std::shared_ptr<const FieldFrame<dim>>(kept, &frame));
  if constexpr (dim == 2)
    if (const auto tools = tool_frame(shot, input_->origin)) {
      if (!tools_) tools_.emplace(folder_, tool_series);
      tools_->write(files, tools);
    }
}

FieldRecorder::FieldRecorder(const std::filesystem::path& folder, const input::Case& input, double time)
    : writer_(FieldWriter::resume(folder, time)), folder_(folder), input_(&input) {
  if (std::filesystem::exists(folder / tool_series.list))
    tools_ = FieldWriter::resume(folder, time, tool_series);
}

template double heat_residual_share(const ExplicitSolver<2>&);
template double heat_residual_share(const ExplicitSolver<3>&);
template class HistoryRecorder<2>;
template class HistoryRecorder<3>;
template void FieldRecorder::record(FileQueue&, const Snapshot<2>&);
template void FieldRecorder::record(FileQueue&, const Snapshot<3>&);

} // namespace cnem::results
