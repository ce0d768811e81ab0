// A cut while it goes on.
#include "core/fields/vector_at.hpp"
#include "core/index.hpp"
#include "evaluate/cut_flow.hpp"
#include "evaluate/cutting.hpp"
#include "evaluate/debonding.hpp"
#include "evaluate/ply_cut.hpp"
#include "results/output_folder.hpp"

#include <algorithm>
#include <cmath>

namespace cnem::evaluate {
namespace {

/// plies: of a case in which plies fail; bonds: with cohesive interfaces.
std::vector<std::string> columns(bool plies, bool bonds) {
  std::vector<std::string> names{"time[s]",
                                 "cut[m]",
                                 "Fc[N/m]",
                                 "Ft[N/m]",
                                 "contact_length[m]",
                                 "interface_temperature[K]",
                                 "temperature_max[K]",
                                 "tool_temperature_max[K]",
                                 "chip_length[m]",
                                 "chip_thickness[m]",
                                 "shear_plane[m]",
                                 "shear_plane_angle[rad]",
                                 "chip_speed[m/s]",
                                 "shear_angle_speed[rad]"};
  if (plies)
    for (const char* name : {"ply_parted", "ply_plane[rad]", "fibre_depth[m]", "matrix_depth[m]",
                             "fibre_damage[m^2]", "matrix_damage[m^2]"})
      names.emplace_back(name);
  if (bonds)
    for (const char* name : {"debonded_length[m]", "debonded_depth[m]"}) names.emplace_back(name);
  return names;
}

/// Of the first feed of the measured stretch, m.
double fresh_thickness(const Chip& chip, double feed) {
  ThicknessProfile first;
  for (std::size_t k = 0; k < chip.profile.at.size(); ++k)
    if (chip.profile.at[k] <= chip.measured.from + feed) {
      first.at.push_back(chip.profile.at[k]);
      first.thickness.push_back(chip.profile.thickness[k]);
    }
  return measure_teeth(first).mean;
}

} // namespace

bool plies_fail(const input::Case& input) {
  return std::any_of(input.materials.begin(), input.materials.end(),
                     [](const auto& material) { return material.failure.has_value(); });
}

bool bonds_fail(const input::Case& input) {
  return std::any_of(input.domain.interfaces.begin(), input.domain.interfaces.end(),
                     [](const auto& interface) { return interface.cohesive.has_value(); });
}

CuttingCourse::CuttingCourse(const input::Case& input)
    : input_(&input), cut_(input::cutting_tool(input, input.report.cutting->tool)),
      rake_(cut_, as<ToolIndex>(input.report.cutting->tool), input.report.cutting->feed),
      plies_(plies_fail(input)), bonds_(bonds_fail(input)) {}

void CuttingCourse::start(const std::filesystem::path& folder) {
  log_.start(results::file_in(folder, results::files::cutting_course), columns(plies_, bonds_));
}

void CuttingCourse::resume(const std::filesystem::path& folder) {
  log_.resume(results::file_in(folder, results::files::cutting_course), columns(plies_, bonds_), rows_);
}

void CuttingCourse::record(const ExplicitSolver<2>& solver) {
  const input::CuttingReport& asked = *input_->report.cutting;
  const State<2>& state = solver.state();
  const auto& contact = solver.conditions().contact;
  const Vec2 moved = contact.displacement(asked.tool, state.time);
  const Vec2 impulse = cut_.turned(contact.results()[as<ToolIndex>(asked.tool)].impulse);
  const double duration = state.time - last_time_;
  const Vec2 force = duration > 0.0 ? Vec2((impulse - last_impulse_) / duration) : Vec2(0, 0);
  last_time_ = state.time;
  last_impulse_ = impulse;

  const bool thermal = input_->analysis.thermal;
  const RakeFace face = rake_.take_recent();
  const std::vector<Vec2> place = places(cut_, moved, state.node.position);
  const CutOutline outline = cut_outline(solver.conditions().cloud.facets, place);
  const Chip chip = measure_chip(outline, asked.feed, cut_.rake);
  const Vec2 speed = mean_velocity(fresh_chip(chip, asked.feed), cut_, place, state.node);
  const Vec2 own = cut_.turned(contact.velocity(asked.tool, state.time));
  const double hottest = *std::max_element(state.node.temperature.begin(), state.node.temperature.end());
  double hottest_of_tool = unknown;
  for (std::size_t s = 0; s < state.tool_temperature.size(); ++s)
    if (const Field& of_tool = state.tool_temperature[s];
        solver.model().tool_sections[s].tool == as<ToolIndex>(asked.tool))
      hottest_of_tool = *std::max_element(of_tool.begin(), of_tool.end());
  std::vector<double> row{state.time,
                          moved.dot(cut_.along),
                          force.x(),
                          0.0 - force.y(),
                          face.contact_length,
                          thermal ? face.mean_temperature : unknown,
                          thermal ? hottest : unknown,
                          hottest_of_tool,
                          chip.length,
                          fresh_thickness(chip, asked.feed),
                          chip.shear_plane,
                          chip.shear_plane_angle,
                          (speed - own).dot(cut_.face()),
                          std::atan2(speed.y(), speed.x())};
  if (plies_) {
    const PlyCut plies =
        look_at_plies(state.point, solver.approximation(), place, asked.feed, moved.dot(cut_.along));
    row.insert(row.end(), {plies.parted ? 1.0 : 0.0, plies.plane, plies.fibre_depth, plies.matrix_depth,
                           plies.fibre_area, plies.matrix_area});
  }
  if (bonds_) {
    const Debonding bonds = look_at_bonds(solver.conditions().cohesive, place);
    row.insert(row.end(), {bonds.length, bonds.depth});
  }
  log_.write(row);
  ++rows_;
}

void CuttingCourse::archive(Archive& archive) {
  rake_.archive(archive);
  archive.integer("run/cutting/rows", rows_);
  archive.number("run/cutting/last_time", "s", last_time_);
  archive.vector<2>("run/cutting/last_impulse", "N s/m", last_impulse_);
}

} // namespace cnem::evaluate
