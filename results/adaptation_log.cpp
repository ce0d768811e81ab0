#include "results/adaptation_log.hpp"

#include "mechanics/node_heat.hpp"
#include "results/output_folder.hpp"

#include <algorithm>
#include <cmath>

namespace cnem::results {

namespace {

std::vector<std::string> columns(const HistoryUnits& units) {
  std::vector<std::string> names{"time[s]",
                                 "step",
                                 "cracks",
                                 "advances",
                                 "cuts",
                                 "opened",
                                 "folded",
                                 "outside",
                                 "removed",
                                 "removed_boundary",
                                 "promoted",
                                 "inserted",
                                 "inserted_boundary",
                                 "balanced",
                                 "undone"};
  for (const std::string& name : {std::string("nodes"), units.enclosed + units.measure, "mass" + units.mass,
                                  "momentum_x" + units.momentum, "momentum_y" + units.momentum,
                                  "angular_momentum" + units.angular_momentum, "heat" + units.energy,
                                  "energy" + units.energy, "energy_lost" + units.energy})
    for (const char* when : {"before", "after"}) names.push_back(fmt::format("{}.{}", when, name));
  return names;
}

double relative(double change, double scale) { return scale > 0.0 ? std::abs(change) / scale : 0.0; }

} // namespace

Audit audit(const ExplicitSolver<2>& solver) {
  const State<2>& state = solver.state();
  const NodeState<2>& node = state.node;
  const Field& inertia = solver.state().node.inertia();
  Audit sums;
  sums.nodes = static_cast<double>(node.size());
  sums.enclosed = enclosed_measure(solver.present_cloud(), solver.approximation().mechanics.space());
  for (std::size_t i = 0; i < node.size(); ++i) {
    const Vec2 x(node.position[0][i], node.position[1][i]), v(node.velocity[0][i], node.velocity[1][i]);
    sums.mass += node.mass[i];
    sums.momentum += inertia[i] * v;
    sums.angular_momentum += inertia[i] * cross(x, v);
    sums.momentum_scale += inertia[i] * v.norm();
    sums.angular_scale += inertia[i] * x.norm() * v.norm();
    sums.heat += node.heat_capacity[i] * curves_of<2>(solver.model(), node, i).enthalpy(node.temperature[i]);
  }
  sums.momentum -= solver.momentum_of_scaling();
  sums.enclosed += state.departed.volume;
  sums.mass += state.departed.mass;
  sums.momentum += state.departed.momentum;
  sums.heat += state.departed.enthalpy;
  const EnergyLedger energy = solver.ledger();
  sums.energy = energy.total();
  sums.lost = energy["resampling"] + energy["rereference"] + energy["penalty_release"];
  return sums;
}

void AdaptationLog::start(const std::filesystem::path& folder, const HistoryUnits& units) {
  log_.start(file_in(folder, files::adaptation), columns(units));
}

void AdaptationLog::resume(const std::filesystem::path& folder, const HistoryUnits& units) {
  log_.resume(file_in(folder, files::adaptation), columns(units), rows_);
}

void AdaptationLog::record(const State<2>& state, const adapt::PassReport& report, const Audit& before,
                           const Audit& after) {
  std::vector<double> row{state.time, static_cast<double>(state.step)};
  for (const int count : {report.cracks, report.advances, report.cuts, report.opened, report.folded,
                          report.outside, report.removed, report.removed_boundary, report.promoted,
                          report.inserted, report.inserted_boundary, report.balanced, report.undone})
    row.push_back(count);
  for (const auto& [was, is] : {std::pair{before.nodes, after.nodes},
                                {before.enclosed, after.enclosed},
                                {before.mass, after.mass},
                                {before.momentum.x(), after.momentum.x()},
                                {before.momentum.y(), after.momentum.y()},
                                {before.angular_momentum, after.angular_momentum},
                                {before.heat, after.heat},
                                {before.energy, after.energy},
                                {before.lost, after.lost}}) {
    row.push_back(was);
    row.push_back(is);
  }
  log_.write(row);
  ++rows_;
  mass_ = std::max(mass_, relative(after.mass - before.mass, before.mass));
  momentum_ = std::max(momentum_, relative((after.momentum - before.momentum).norm(), before.momentum_scale));
  angular_ =
      std::max(angular_, relative(after.angular_momentum - before.angular_momentum, before.angular_scale));
  heat_ = std::max(heat_, relative(after.heat - before.heat, before.heat));
  energy_ = std::max(energy_, relative(after.energy - before.energy, std::abs(before.energy)));
}

std::vector<std::pair<std::string, double>> AdaptationLog::metrics() const {
  return {{"adapt.mass_error", mass_},
          {"adapt.momentum_error", momentum_},
          {"adapt.heat_error", heat_},
          {"adapt.energy_error", energy_},
          {"adapt.angular_momentum_change", angular_}};
}

void AdaptationLog::archive(Archive& archive) {
  archive.integer("run/adapt/log/rows", rows_);
  archive.number("run/adapt/log/mass", "1", mass_);
  archive.number("run/adapt/log/momentum", "1", momentum_);
  archive.number("run/adapt/log/heat", "1", heat_);
  archive.number("run/adapt/log/energy", "1", energy_);
  archive.number("run/adapt/log/angular", "1", angular_);
}

} // namespace cnem::results
