#include "results/recorder.hpp"

#include "core/error.hpp"
#include "core/index.hpp"
#include "results/fields.hpp"
#include "results/output_folder.hpp"
#include "voronoi/natural_neighbours.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <utility>

namespace cnem::results {

namespace {

std::array<std::span<const double>, 2> spans(const Fields<2>& field) { return {field[0], field[1]}; }

std::string with_unit(const std::string& name, const std::string& unit) {
  return unit.empty() ? name : fmt::format("{}[{}]", name, unit);
}

std::vector<std::string> columns_of(const std::vector<Metric>& told) {
  std::vector<std::string> names;
  for (const Metric& metric : told)
    if (!metric.name.empty()) names.push_back(metric.name);
  return names;
}

/// Natural-neighbour weights of the probes in the initial cloud.
std::vector<ProbeWeights> probe_weights(const input::Case& input, const Cloud<2>& cloud) {
  std::vector<ProbeWeights> probes;
  if (input.output.probes.empty()) return probes;
  const voronoi::Triangulation mesh = voronoi::triangulate(cloud);
  const voronoi::Circumcircles circles = voronoi::circumcircles(cloud, mesh);
  voronoi::NaturalNeighbours functions(cloud, mesh, circles);
  for (const input::Probe& probe : input.output.probes) {
    try {
      functions.evaluate(voronoi::Functions::sibson, probe.at);
    } catch (const GeometryError& error) {
      throw input.error("output.probes." + probe.name + ".at", error.what());
    }
    probes.push_back({probe.name,
                      probe.fields,
                      {functions.nodes().begin(), functions.nodes().end()},
                      {functions.values().begin(), functions.values().end()}});
  }
  return probes;
}

bool expands(const std::vector<plasticity::Material>& materials) {
  return std::any_of(materials.begin(), materials.end(),
                     [](const plasticity::Material& material) { return material.expansion != 0.0; });
}

double total_mass(const ExplicitSolver<2>& solver) {
  double mass = 0.0;
  for (const double m : solver.state().node.mass) mass += m;
  return mass;
}

} // namespace

HistoryUnits history_units(const input::Case& input) {
  return input.analysis.space() == Space::revolution ? HistoryUnits{"[N]", "[J]", "[kg]"} : HistoryUnits{};
}

HistoryRecorder::HistoryRecorder(const input::Case& input, const ExplicitSolver<2>& solver,
                                 const std::filesystem::path& folder)
    : units_(history_units(input)), probes_(probe_weights(input, solver.conditions().cloud)), folder_(folder),
      initial_area_(boundary_area(snapshot(solver))), initial_mass_(total_mass(solver)) {}

std::vector<Metric> HistoryRecorder::row(const ExplicitSolver<2>& solver) const {
  const State<2>& state = solver.state();
  const std::array<double, 2> balance = solver.mass_balance();
  std::vector<Metric> row{{"time[s]", state.time},
                          {"step", static_cast<double>(state.step)},
                          {"dt[s]", state.step_before},
                          {"nodes", static_cast<double>(state.node.size())},
                          {"", kinetic_share(), "kinetic_share"},
                          {"", balance[0], "mass_balance.low"},
                          {"", balance[1], "mass_balance.high"}};
  const auto& contact = solver.conditions().contact;
  for (std::size_t t = 0; t < contact.tools().size(); ++t) {
    const std::string& name = contact.tools()[t].name;
    const auto& result = contact.results()[t];
    row.push_back({name + ".force_x" + units_.force, result.force.x()});
    row.push_back({name + ".force_y" + units_.force, result.force.y()});
    row.push_back({"", result.force.norm(), "peak_force." + name, Keep::largest});
    row.push_back({name + ".stroke[m]", contact.displacement(t, state.time).norm()});
    const Vec2 at = contact.displacement(t, state.time), speed = contact.velocity(t, state.time);
    row.push_back({name + ".displacement_x[m]", at.x()});
    row.push_back({name + ".displacement_y[m]", at.y()});
    row.push_back({name + ".velocity_x[m/s]", speed.x()});
    row.push_back({name + ".velocity_y[m/s]", speed.y()});
    row.push_back({name + ".work" + units_.energy, result.total.tool});
  }
  if (contact.bodies_touch())
    row.push_back({"body_contact.pressing" + units_.force, contact.body_result().pressing});
  const auto& supports = solver.conditions().supports;
  for (std::size_t s = 0; s < supports.list().size(); ++s) {
    if (s > 0 && supports.list()[s].name == supports.list()[s - 1].name) continue;
    Vec2 force = Vec2::Zero();
    for (std::size_t o = s; o < supports.list().size(); ++o)
      if (supports.list()[o].name == supports.list()[s].name) force += supports.reactions()[o];
    row.push_back({"support." + supports.list()[s].name + ".force_x" + units_.force, force.x()});
    row.push_back({"support." + supports.list()[s].name + ".force_y" + units_.force, force.y()});
  }
  const EnergyLedger e = solver.ledger();
  for (const Energy& entry : e.entries())
    if (entry.kind != EnergyKind::noted)
      row.push_back({fmt::format("energy.{}{}", entry.name, units_.energy), entry.value});
  row.push_back({"energy.residual" + units_.energy, e.residual()});
  row.push_back({"kinetic_share", e.kinetic_share()});
  for (Metric& metric : solver.metrics()) row.push_back(std::move(metric));
  for (const std::string name : {"plastic_strain", "temperature"})
    row.push_back({with_unit("max." + name, field_info(name).unit), largest_value(snapshot(solver), name),
                   "max_" + name, Keep::largest});
  if (!state.point.damage.empty()) {
    row.push_back({"max.damage", *std::max_element(state.point.damage.begin(), state.point.damage.end()),
                   "max_damage", Keep::largest});
    row.push_back({"broken_area[m^2]", broken_area(snapshot(solver)), "broken_area", Keep::largest});
  }
  for (const ProbeWeights& probe : probes_)
    for (const std::string& name : probe.fields)
      row.push_back({with_unit(fmt::format("probe.{}.{}", probe.name, name), field_info(name).unit),
                     weighted_value(snapshot(solver), name, probe.node, probe.weight)});
  const double mass = total_mass(solver), area = boundary_area(snapshot(solver));
  row.push_back({"mass" + units_.mass, mass});
  row.push_back({"", mass / initial_mass_ - 1.0, "mass_drift"});
  row.push_back({"area[m^2]", area});
  row.push_back({"", area / initial_area_ - 1.0, "area_drift"});
  return row;
}

void HistoryRecorder::keep(const Metric& metric) {
  if (metric.kept_as.empty()) return;
  for (auto& [known, kept] : metrics_)
    if (known == metric.kept_as) {
      kept = metric.keep == Keep::largest ? std::max(kept, metric.value) : metric.value;
      return;
    }
  metrics_.emplace_back(metric.kept_as, metric.value);
}

void HistoryRecorder::record(const ExplicitSolver<2>& solver) {
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
  if (writer_.empty()) writer_.emplace_back(folder_ / files::history, columns_of(told));
  std::vector<double> values;
  values.reserve(told.size());
  for (const Metric& metric : told)
    if (!metric.name.empty()) values.push_back(metric.value);
  writer_.front().write(values);
  ++rows_;
}

void HistoryRecorder::resample(const Resampling<2>& change, const ExplicitSolver<2>& solver) {
  if (probes_.empty()) return;
  const Cloud<2>& cloud = solver.conditions().cloud;
  const voronoi::Triangulation mesh = voronoi::triangulate(cloud);
  const voronoi::Circumcircles circles = voronoi::circumcircles(cloud, mesh);
  voronoi::NaturalNeighbours functions(cloud, mesh, circles);
  for (ProbeWeights& probe : probes_) {
    Vec2 at = Vec2::Zero();
    for (std::size_t k = 0; k < probe.node.size(); ++k)
      at += probe.weight[k] * change.old_position[index_of(probe.node[k])];
    try {
      functions.evaluate(voronoi::Functions::sibson, at);
      probe.node.assign(functions.nodes().begin(), functions.nodes().end());
      probe.weight.assign(functions.values().begin(), functions.values().end());
    } catch (const GeometryError&) { // cut off with a corner of the boundary: the nearest node goes on
      std::size_t nearest = 0;
      for (std::size_t i = 1; i < cloud.position.size(); ++i)
        if ((cloud.position[i] - at).squaredNorm() < (cloud.position[nearest] - at).squaredNorm())
          nearest = i;
      probe.node = {static_cast<std::int32_t>(nearest)};
      probe.weight = {1.0};
    }
  }
}

void HistoryRecorder::archive(Archive& archive) {
  for (ProbeWeights& probe : probes_) {
    archive.integers(fmt::format("run/history/probe/{}/node", probe.name), probe.node);
    archive.list(fmt::format("run/history/probe/{}/weight", probe.name), "1", probe.weight);
  }
  archive.integer("run/history/rows", rows_);
  archive.number("run/history/initial_area", "m^2", initial_area_);
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

void HistoryRecorder::resume(const ExplicitSolver<2>& solver) {
  writer_.clear();
  writer_.push_back(HistoryWriter::resume(folder_ / files::history, columns_of(row(solver)), rows_));
}

EnergyScale HistoryRecorder::energy_scale() const {
  constexpr double rest = 1e-7; // m/s
  const double resting = 0.5 * initial_mass_ * rest * rest;
  if (scale_ > resting) return {scale_, "the work done"};
  if (heat_ > resting) return {heat_, "the heat taken up, where nothing has done work"};
  return {resting, "the energy of a body at rest, where nothing has done work"};
}

double HistoryRecorder::energy_residual() const { return worst_residual_ / energy_scale().energy; }

std::string HistoryRecorder::kinetic_warning(const input::Case& input) const {
  constexpr double small = 0.05;
  if (!input.time.mass_scaling || kinetic_share() <= small) return "";
  return fmt::format(
      "with time.mass_scaling the kinetic energy is {:.2g} of the deformation energy on average, which "
      "should be below {:g}: forces hold inertia; scale less, or move more slowly",
      kinetic_share(), small);
}

void write_lines(const input::Case& input, const Snapshot& shot, const std::filesystem::path& folder) {
  if (input.output.lines.empty()) return;
  Cloud<2> initial = shot.cloud;
  for (std::size_t i = 0; i < initial.position.size(); ++i)
    initial.position[i] = {shot.state.node.initial_position[0][i], shot.state.node.initial_position[1][i]};
  const voronoi::Triangulation mesh = voronoi::triangulate(initial);
  const voronoi::Circumcircles circles = voronoi::circumcircles(initial, mesh);
  voronoi::NaturalNeighbours functions(initial, mesh, circles);
  std::filesystem::create_directories(folder / files::lines_folder);
  for (const input::SampleLine& line : input.output.lines) {
    std::string text = "distance[m],x[m],y[m]";
    std::vector<Field> fields;
    for (const std::string& name : line.fields) {
      text += fmt::format(",{}", with_unit(name, field_info(name).unit));
      fields.push_back(values_at_nodes(shot, name));
    }
    text += "\n";
    for (int k = 0; k < line.samples; ++k) {
      const Vec2 x = line.from + (line.to - line.from) * (static_cast<double>(k) / (line.samples - 1));
      try {
        functions.evaluate(voronoi::Functions::sibson, x);
      } catch (const GeometryError& error) { throw input.error("output.lines." + line.name, error.what()); }
      text +=
          fmt::format("{},{},{}", (x - line.from).norm(), input.origin.x() + x.x(), input.origin.y() + x.y());
      for (const Field& field : fields) {
        double sum = 0.0;
        for (std::size_t j = 0; j < functions.nodes().size(); ++j)
          sum += functions.values()[j] * field[index_of(functions.nodes()[j])];
        text += fmt::format(",{}", sum);
      }
      text += "\n";
    }
    write_atomically(folder / files::lines_folder / (line.name + ".csv"), text);
  }
}

void FieldRecorder::record(FileQueue& files, const Snapshot& shot) {
  struct Kept {
    FieldFrame frame;
    CellGeometry<2> cells;
    Fields<2> position, velocity, springback;
    std::vector<Field> values;
  };
  const auto kept = std::make_shared<Kept>();
  kept->cells = shot.approximation.cells;
  kept->position = shot.state.node.position;
  kept->velocity = shot.state.node.velocity;
  kept->values.reserve(2 * field_catalogue().size());
  FieldFrame& frame = kept->frame;
  frame.time = shot.state.time;
  frame.cells = &kept->cells;
  frame.position = spans(kept->position);
  frame.origin = origin_;
  for (const FieldInfo& info : field_catalogue()) {
    if (info.of_damage && shot.state.point.damage.empty()) continue;
    if (info.adaptive && !shot.adaptation) continue;
    const std::string name =
        info.unit.empty() ? info.shown.label : fmt::format("{} [{}]", info.shown.label, info.unit);
    const Field& at_points = kept->values.emplace_back(values_at_points(shot, info.name));
    frame.cell_scalars.push_back({name, at_points});
    if (shot.approximation.mechanics.nodal)
      frame.node_scalars.push_back({name, at_points});
    else
      frame.node_scalars.push_back({name, kept->values.emplace_back(values_at_nodes(shot, info.name))});
  }
  frame.node_vectors.push_back({"velocity [m/s]", {kept->velocity[0], kept->velocity[1], {}}});
  if (shot.springback) {
    kept->springback = *shot.springback;
    frame.node_vectors.push_back({"springback [m]", {kept->springback[0], kept->springback[1], {}}});
  }
  writer_.write(files, {kept, &frame});
}

} // namespace cnem::results
