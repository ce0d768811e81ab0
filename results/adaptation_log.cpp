#include "results/adaptation_log.hpp"

#include "core/fields/vector_at.hpp"
#include "mechanics/node_heat.hpp"
#include "results/output_folder.hpp"

#include <algorithm>
#include <cmath>

namespace cnem::results {

namespace {

constexpr const char* axes[] = {"x", "y", "z"};

std::vector<std::string> columns(const HistoryUnits& units, int dimensions) {
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
  if (dimensions == 3) names.insert(names.end(), {"flipped", "recut", "crossings", "side_crossings"});
  std::vector<std::string> sums{"nodes", units.enclosed + units.measure, "mass" + units.mass};
  for (int k = 0; k < dimensions; ++k) sums.push_back(fmt::format("momentum_{}{}", axes[k], units.momentum));
  for (int k = 0; k < (dimensions == 2 ? 1 : 3); ++k)
    sums.push_back(fmt::format("angular_momentum{}{}", dimensions == 2 ? "" : fmt::format("_{}", axes[k]),
                               units.angular_momentum));
  for (const char* energy : {"heat", "energy", "energy_lost"}) sums.push_back(energy + units.energy);
  for (const std::string& name : sums)
    for (const char* when : {"before", "after"}) names.push_back(fmt::format("{}.{}", when, name));
  return names;
}

template<int dim> Turn<dim> moment(const Vec<dim>& arm, const Vec<dim>& momentum) {
  if constexpr (dim == 2)
    return Turn<2>(cross(arm, momentum));
  else
    return arm.cross(momentum);
}

double relative(double change, double scale) { return scale > 0.0 ? std::abs(change) / scale : 0.0; }

} // namespace

template<int dim> Audit<dim> audit(const ExplicitSolver<dim>& solver) {
  const State<dim>& state = solver.state();
  const NodeState<dim>& node = state.node;
  const Field& inertia = solver.state().node.inertia();
  Audit<dim> sums;
  sums.nodes = static_cast<double>(node.size());
  sums.enclosed = enclosed_measure(solver.present_cloud(), solver.approximation().mechanics.space());
  for (std::size_t i = 0; i < node.size(); ++i) {
    const Vec<dim> x = vector_at<dim>(node.position, i), v = vector_at<dim>(node.velocity, i);
    sums.mass += node.mass[i];
    sums.momentum += inertia[i] * v;
    sums.angular_momentum += inertia[i] * moment<dim>(x, v);
    sums.momentum_scale += inertia[i] * v.norm();
    sums.angular_scale += inertia[i] * x.norm() * v.norm();
    sums.heat +=
        node.heat_capacity[i] * curves_of<dim>(solver.model(), node, i).enthalpy(node.temperature[i]);
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

void AdaptationLog::start(const std::filesystem::path& folder, const HistoryUnits& units, int dimensions) {
  log_.start(file_in(folder, files::adaptation), columns(units, dimensions));
}

void AdaptationLog::resume(const std::filesystem::path& folder, const HistoryUnits& units, int dimensions) {
  log_.resume(file_in(folder, files::adaptation), columns(units, dimensions), rows_);
}

template<int dim>
void AdaptationLog::record(const State<dim>& state, const adapt::PassReport& report, const Audit<dim>& before,
                           const Audit<dim>& after) {
  std::vector<double> row{state.time, static_cast<double>(state.step)};
  for (const int count : {report.cracks, report.advances, report.cuts, report.opened, report.folded,
                          report.outside, report.removed, report.removed_boundary, report.promoted,
                          report.inserted, report.inserted_boundary, report.balanced, report.undone})
    row.push_back(count);
  if constexpr (dim == 3)
    row.insert(row.end(), {1.0 * report.flipped, 1.0 * report.recut, 1.0 * report.crossings,
                           1.0 * report.side_crossings});
  const auto add = [&](double was, double is) { row.insert(row.end(), {was, is}); };
  add(before.nodes, after.nodes);
  add(before.enclosed, after.enclosed);
  add(before.mass, after.mass);
  for (Eigen::Index k = 0; k < dim; ++k) add(before.momentum[k], after.momentum[k]);
  for (Eigen::Index k = 0; k < before.angular_momentum.size(); ++k)
    add(before.angular_momentum[k], after.angular_momentum[k]);
  add(before.heat, after.heat);
  add(before.energy, after.energy);
  add(before.lost, after.lost);
  log_.write(row);
  ++rows_;
  mass_ = std::max(mass_, relative(after.mass - before.mass, before.mass));
  momentum_ = std::max(momentum_, relative((after.momentum - before.momentum).norm(), before.momentum_scale));
  angular_ = std::max(
      angular_, relative((after.angular_momentum - before.angular_momentum).norm(), before.angular_scale));
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

template Audit<2> audit(const ExplicitSolver<2>&);
template Audit<3> audit(const ExplicitSolver<3>&);
template void AdaptationLog::record(const State<2>&, const adapt::PassReport&, const Audit<2>&,
                                    const Audit<2>&);
template void AdaptationLog::record(const State<3>&, const adapt::PassReport&, const Audit<3>&,
                                    const Audit<3>&);

} // namespace cnem::results
