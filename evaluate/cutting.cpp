#include "evaluate/cutting.hpp"

#include "core/index.hpp"
#include "evaluate/blanking.hpp"
#include "evaluate/cut_flow.hpp"
#include "evaluate/cutting_forces.hpp"
#include "evaluate/machined_surface.hpp"
#include "evaluate/ply_cut.hpp"
#include "evaluate/residual_stress.hpp"
#include "evaluate/tool_isotherms.hpp"
#include "results/fields.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace cnem::evaluate {
namespace {

const std::vector<double>& values_of(const results::HistoryTable& table, std::string_view name) {
  return table.column[index_of(table.find(name))];
}

CutImpulse impulse_of(const results::HistoryTable& rows) {
  CutImpulse impulse;
  const std::vector<double>&time = values_of(rows, "time"), &cut = values_of(rows, "cut"),
        &Fc = values_of(rows, "Fc"), &Ft = values_of(rows, "Ft");
  double sum_c = 0.0, sum_t = 0.0;
  for (std::size_t k = 0; k < rows.rows(); ++k) {
    const double duration = k == 0 ? 0.0 : time[k] - time[k - 1];
    sum_c += Fc[k] * duration;
    sum_t += Ft[k] * duration;
    if (!impulse.cut.empty() && !(cut[k] > impulse.cut.back())) continue; // at rest, or going back
    impulse.cut.push_back(cut[k]);
    impulse.time.push_back(time[k]);
    impulse.Fc.push_back(sum_c);
    impulse.Ft.push_back(sum_t);
  }
  return impulse;
}

/// Of the rows between two lengths of cut that have a number.
double mean_in(const results::HistoryTable& rows, std::string_view name, double from, double to) {
  const std::vector<double>&cut = values_of(rows, "cut"), &values = values_of(rows, name);
  double sum = 0.0, count = 0.0;
  for (std::size_t k = 0; k < values.size(); ++k)
    if (cut[k] >= from && cut[k] <= to && std::isfinite(values[k])) {
      sum += values[k];
      ++count;
    }
  return count > 0.0 ? sum / count : unknown;
}

double largest_in(const results::HistoryTable& rows, std::string_view name, double from, double to) {
  const std::vector<double>&cut = values_of(rows, "cut"), &values = values_of(rows, name);
  double most = unknown;
  for (std::size_t k = 0; k < values.size(); ++k)
    if (cut[k] >= from && cut[k] <= to && !(values[k] <= most)) most = values[k];
  return most;
}

results::HistoryTable force_table(const CutImpulse& impulse, const results::HistoryTable& rows,
                                  double filter) {
  results::HistoryTable table;
  table.names = {"cut[m]", "Fc[N/m]", "Ft[N/m]", "Fc.filtered[N/m]", "Ft.filtered[N/m]"};
  table.column = {values_of(rows, "cut"), values_of(rows, "Fc"), values_of(rows, "Ft"), {}, {}};
  if (impulse.rows() < 2) {
    for (auto& values : table.column) values.clear();
    return table;
  }
  const std::vector<CutForce> filtered = filtered_forces(impulse, filter);
  for (const double cut : table.column.front()) {
    const auto k =
        index_of(std::lower_bound(impulse.cut.begin(), impulse.cut.end(), cut) - impulse.cut.begin());
    table.column[3].push_back(filtered[std::min(k, filtered.size() - 1)].Fc);
    table.column[4].push_back(filtered[std::min(k, filtered.size() - 1)].Ft);
  }
  return table;
}

/// m of cut at which the tool leaves the workpiece; infinite where it does not.
double end_of_workpiece(const input::Case& input, const input::CuttingTool& cut, double way) {
  if (input.adapt.window) return INFINITY; // more is fed in
  double end = -INFINITY;
  for (const Vec2& x : points_of(input.domain.outer, Vec2::Zero()))
    end = std::max(end, cut.place(x, Vec2::Zero()).x());
  return way > end ? end : INFINITY;
}

void take_forces(CuttingResult& result, const input::CuttingReport& asked, const results::HistoryTable& rows,
                 double tooth, double end) {
  const CutImpulse impulse = impulse_of(rows);
  const SteadyPart part = steady_part(impulse, {.feed = asked.feed,
                                                .feeds = asked.steady_feeds,
                                                .tolerance = asked.steady_tolerance,
                                                .window = asked.filter,
                                                .tooth = tooth,
                                                .end = end});
  result.forces = force_table(impulse, rows, asked.filter);
  if (impulse.rows() > 1)
    result.speed = (impulse.cut.back() - impulse.cut.front()) / (impulse.time.back() - impulse.time.front());
  result.steady = part.steady;
  result.steady_note = part.note;
  result.steady_from = part.from;
  result.steady_to = part.to;
  if (!(part.to > part.from)) return;
  result.Fc = part.mean.Fc;
  result.Ft = part.mean.Ft;
  result.Fc_spread = part.spread.Fc;
  result.Ft_spread = part.spread.Ft;
  result.specific_energy = part.mean.Fc / asked.feed;
  result.friction_angle = result.rake + std::atan2(part.mean.Ft, part.mean.Fc);
}

/// Forces and damage of a chip that breaks off, in place of a steady part.
void take_broken_chip(CuttingResult& result, const results::HistoryTable& rows) {
  result.breaks = true;
  result.steady = false;
  result.steady_note = "a chip breaks off; forces are means while the tool is fully engaged";
  result.Fc = result.Ft = result.Fc_spread = result.Ft_spread = unknown;
  result.specific_energy = result.friction_angle = unknown;
  const auto &cut = values_of(result.forces, "cut"), &parted = values_of(rows, "ply_parted");
  const BrokenChip chip = broken_chip(cut, values_of(result.forces, "Fc.filtered"), parted);
  if (!std::isfinite(chip.peak)) return;
  result.engaged_at = result.steady_from = chip.engaged;
  result.released_at = result.steady_to = chip.released;
  result.completed_at = chip.completed;
  result.chip_completed = std::isfinite(chip.completed);
  result.Fc_peak = chip.peak;
  const auto& thrust = values_of(result.forces, "Ft.filtered");
  result.Ft_peak = *std::max_element(thrust.begin(), thrust.begin() + as<std::ptrdiff_t>(chip.last) + 1);
  const auto at_row = [&](std::string_view name, std::size_t row) { return values_of(rows, name)[row]; };
  result.fibre_depth = at_row("fibre_depth", chip.last);
  result.matrix_depth = at_row("matrix_depth", chip.last);
  result.fibre_damage = at_row("fibre_damage", chip.last);
  result.matrix_damage = at_row("matrix_damage", chip.last);
  const auto through = std::ranges::find_if(parted, [](double yes) { return yes != 0.0; });
  if (through != parted.end()) result.chip_plane = at_row("ply_plane", index_of(through - parted.begin()));
  const CutImpulse impulse = impulse_of(rows);
  if (impulse.rows() < 2) return;
  if (result.chip_completed) result.Fc_of_chip = mean_force(impulse, impulse.cut.front(), chip.completed).Fc;
  if (!(chip.released > chip.engaged)) return;
  const CutForce mean = mean_force(impulse, chip.engaged, chip.released);
  result.Fc = mean.Fc, result.Ft = mean.Ft;
  result.specific_energy = mean.Fc / result.feed;
  result.friction_angle = result.rake + std::atan2(mean.Ft, mean.Fc);
}

/// What came off cohesive interfaces until the end, and the largest forces where plies have told none.
void take_debonding(CuttingResult& result, const results::HistoryTable& rows) {
  result.debonds = true;
  if (rows.rows() == 0) return;
  result.debonded_length = values_of(rows, "debonded_length").back();
  result.debonded_depth = values_of(rows, "debonded_depth").back();
  if (result.breaks || result.forces.rows() == 0) return;
  result.Fc_peak = *std::ranges::max_element(values_of(result.forces, "Fc.filtered"));
  result.Ft_peak = *std::ranges::max_element(values_of(result.forces, "Ft.filtered"));
}

/// Rates of wear over the bins of a face, m/s; not-a-number where nothing touches.
std::vector<double> wear_of(const input::UsuiWear& law, const RakeFace& face) {
  std::vector<double> rate;
  for (std::size_t k = 0; k < face.at.size(); ++k)
    rate.push_back(law.a * face.normal[k] * std::abs(face.slip[k]) * std::exp(-law.b / face.temperature[k]));
  return rate;
}

void take_rake_face(CuttingResult& result, const input::Case& input, const RakeFace& face) {
  result.rake_face.names = {"distance[m]",    "normal_stress[Pa]", "shear_stress[Pa]",
                            "temperature[K]", "slip[m/s]",         "wear_rate[m/s]"};
  result.rake_face.column.resize(result.rake_face.names.size());
  const bool thermal = input.analysis.thermal;
  std::vector<double> wear(face.at.size(), unknown);
  if (const auto& law = input.report.cutting->wear; law && thermal) wear = wear_of(*law, face);
  std::size_t touched = 0;
  double sum = 0.0, count = 0.0;
  for (std::size_t k = 0; k < face.at.size(); ++k) {
    if (face.normal[k] != 0.0) touched = k + 1;
    if (!std::isfinite(wear[k]) || face.at[k] > face.contact_length) continue;
    sum += wear[k];
    ++count;
    result.wear_rate_max =
        std::isfinite(result.wear_rate_max) ? std::max(result.wear_rate_max, wear[k]) : wear[k];
  }
  if (count > 0.0) result.wear_rate = sum / count;
  for (std::size_t k = 0; k < touched; ++k) {
    const double row[] = {face.at[k],    face.normal[k],
                          face.shear[k], thermal ? face.temperature[k] : unknown,
                          face.slip[k],  wear[k]};
    for (std::size_t c = 0; c < std::size(row); ++c) result.rake_face.column[c].push_back(row[c]);
  }
  result.contact_length = face.contact_length;
  if (thermal) result.interface_temperature = face.mean_temperature;
  result.edge_Fc = face.edge_Fc;
  result.edge_Ft = face.edge_Ft;
}

void take_chip(CuttingResult& result, const Chip& chip, double feed) {
  result.chip_note = chip.note;
  result.chip_length = chip.length;
  result.shear_plane = chip.shear_plane;
  result.shear_plane_angle = chip.shear_plane_angle;
  result.chip.names = {"distance[m]", "thickness[m]"};
  result.chip.column = {chip.profile.at, chip.profile.thickness};
  if (!chip.note.empty()) return;
  result.chip_thickness = chip.thickness;
  result.chip_peak = chip.peak;
  result.chip_valley = chip.valley;
  result.chip_ratio = chip.thickness / feed;
  result.chip_from = chip.measured.from;
  result.chip_to = chip.measured.to;
  result.shear_angle = shear_angle(feed, chip.thickness, result.rake);
  result.teeth = static_cast<double>(chip.teeth.size());
  result.tooth_spacing = chip.tooth_spacing;
}

/// Normal stresses in the frame of the cut, [node] Pa.
NormalStresses<Field> normal_stresses(const Fields<4>& stress, const input::CuttingTool& cut) {
  const Field &xx = stress[0], &yy = stress[1], &zz = stress[2], &xy = stress[3];
  const auto along = [&](const Vec2& n, std::size_t i) {
    return n.x() * n.x() * xx[i] + n.y() * n.y() * yy[i] + 2.0 * n.x() * n.y() * xy[i];
  };
  NormalStresses<Field> normal{zz, zz, zz};
  for (std::size_t i = 0; i < zz.size(); ++i) {
    normal.along[i] = along(cut.along, i);
    normal.away[i] = along(cut.away, i);
  }
  return normal;
}

void add_note(std::string& note, const std::string& more) { note += (note.empty() ? "" : "; ") + more; }

void take_surface(CuttingResult& result, const MachinedSurface& surface, bool thermal) {
  result.surface_note = surface.note;
  std::vector<std::string>& names = result.depth.names;
  names = {"depth[m]"};
  for (const char* kind : {"stress", "residual"})
    for (const char* direction : {"along", "away", "across"}) {
      names.push_back(fmt::format("{}_{}[Pa]", kind, direction));
      names.push_back(fmt::format("{}_{}.spread[Pa]", kind, direction));
    }
  names.insert(names.end(), {"plastic_strain", "temperature[K]", "nodes"});
  result.depth.column.resize(names.size());
  if (!surface.note.empty()) return;
  result.surface_from = -surface.measured.to;
  result.surface_to = -surface.measured.from;
  result.surface_height = surface.height;
  result.roughness = surface.roughness;
  result.Rz = surface.Rz;
  result.layer = surface.layer;
  for (const DepthLayer& layer : surface.layers) {
    std::vector<double> row{layer.depth};
    for (const auto& stress : {layer.loaded, layer.residual})
      for (const LayerMean& mean : {stress.along, stress.away, stress.across})
        row.insert(row.end(), {mean.mean, mean.spread});
    row.insert(row.end(), {layer.plastic_strain, thermal ? layer.temperature : unknown, layer.nodes});
    for (std::size_t c = 0; c < row.size(); ++c) result.depth.column[c].push_back(row[c]);
  }
  if (!surface.layers.empty()) result.residual_stress_surface = surface.layers.front().residual.along.mean;
  result.residual_yield = surface.yield_ratio;
  if (surface.yield_ratio > 1.0)
    add_note(result.residual_note,
             fmt::format("residual stresses are elastic: the largest is {:.2f} times what the metal flows at",
                         surface.yield_ratio));
}

void take_tool(CuttingResult& result, const input::CuttingReport& asked, const input::CuttingTool& cut,
               const results::Snapshot<2>& shot) {
  result.isotherms.names = {"temperature[K]", "depth[m]", "face_from[m]", "face_to[m]"};
  result.isotherms.column.resize(result.isotherms.names.size());
  for (std::size_t s = 0; s < shot.state.tool_temperature.size(); ++s) {
    const ToolSection<2>& section = (*shot.tools)[s];
    if (section.tool != as<ToolIndex>(asked.tool)) continue;
    const Field& temperature = shot.state.tool_temperature[s];
    for (const Isotherm& line :
         tool_isotherms(section, temperature, cut,
                        asked.isotherms.empty() ? round_temperatures(temperature) : asked.isotherms)) {
      const double row[] = {line.temperature, line.depth, line.face_from, line.face_to};
      for (std::size_t c = 0; c < std::size(row); ++c) result.isotherms.column[c].push_back(row[c]);
    }
  }
}

} // namespace

CuttingResult evaluate_cutting(const input::Case& input, const results::Snapshot<2>& shot,
                               const CuttingCourse& course, results::HistoryTable rows,
                               const StressedBody* body) {
  const input::CuttingReport& asked = *input.report.cutting;
  const input::CuttingTool& cut = course.tool();
  const State<2>& state = shot.state;
  CuttingResult result;
  result.tool = input.tools[asked.tool].name;
  result.time = state.time;
  result.feed = asked.feed;
  result.width = asked.width;
  result.filter = asked.filter;
  result.rake = cut.rake;
  result.along_x = cut.along.x();
  result.along_y = cut.along.y();
  result.away_x = cut.away.x();
  result.away_y = cut.away.y();
  const Vec2 moved = shot.contact.displacement(asked.tool, state.time);
  result.cut = moved.dot(cut.along);

  const std::vector<Vec2> place = places(cut, moved, state.node.position);
  const CutOutline outline = cut_outline(shot.cloud.facets, place);
  const Chip chip = measure_chip(outline, asked.feed, cut.rake);
  take_chip(result, chip, asked.feed);
  // A tooth of the chip is made over as much cut as there was metal in it.
  const double tooth =
      std::isfinite(chip.tooth_spacing) ? chip.tooth_spacing * chip.thickness / asked.feed : 0.0;
  take_forces(result, asked, rows, tooth, end_of_workpiece(input, cut, result.cut));
  const bool plies = plies_fail(input);
  if (plies) take_broken_chip(result, rows);
  if (bonds_fail(input)) take_debonding(result, rows);
  const double from = result.steady_from, to = result.steady_to;
  const RakeFace face = course.rake().mean(from, to);
  take_rake_face(result, input, face);
  result.temperature_max = largest_in(rows, "temperature_max", from, to);
  result.tool_temperature_max = largest_in(rows, "tool_temperature_max", from, to);
  take_tool(result, asked, cut, shot);
  result.chip_speed = mean_in(rows, "chip_speed", from, to);
  result.shear_angle_speed = mean_in(rows, "shear_angle_speed", from, to);
  result.tooth_frequency = result.chip_speed / result.tooth_spacing;
  const double contact = std::isfinite(result.contact_length) ? result.contact_length : 0.0;
  result.curl_radius = curl_radius(chip, {std::max(contact, chip.measured.from), chip.measured.to});
  const Field& volume = shot.approximation.node_volume;
  result.shear_angle_rate =
      angle_of_rates(chip, asked.feed, place, results::values_at_nodes(shot, "plastic_rate"), volume);
  if (std::isfinite(result.shear_angle)) {
    const double angle = result.shear_angle;
    result.shear_stress =
        (result.Fc * std::cos(angle) - result.Ft * std::sin(angle)) * std::sin(angle) / asked.feed;
  }
  const bool has_ply = std::any_of(input.materials.begin(), input.materials.end(),
                                   [](const auto& material) { return material.ply.has_value(); });
  const ResidualStress left =
      has_ply ? no_residual_stress(place.size(), "the elastic way back is that of isotropic metal")
              : residual_stress(shot, body);
  result.residual_note = left.note;
  if (input.analysis.thermal && std::none_of(input.materials.begin(), input.materials.end(),
                                             [](const auto& material) { return material.expansion != 0.0; }))
    add_note(result.residual_note, "heat leaves no stress: no material has a heat.expansion");
  const NormalStresses<Field> loaded = normal_stresses(stress_at_nodes(shot), cut),
                              residual = normal_stresses(left.stress, cut);
  const Field strain = results::values_at_nodes(shot, "plastic_strain");
  const auto spans = [](const NormalStresses<Field>& s) {
    return DepthFields::Stresses{s.along, s.away, s.across};
  };
  take_surface(result,
               measure_surface(
                   machined_profile(shot.cloud.facets, place, asked.feed), place,
                   {volume, spans(loaded), spans(residual), strain, state.node.temperature, left.yield_ratio},
                   asked.feed, moved.dot(cut.along), asked.clear),
               input.analysis.thermal);
  result.course = std::move(rows);
  return result;
}

} // namespace cnem::evaluate
