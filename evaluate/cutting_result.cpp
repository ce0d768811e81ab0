#include "evaluate/cutting_result.hpp"

#include "core/index.hpp"
#include "evaluate/json_carrier.hpp"
#include "results/output_folder.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <numbers>

namespace cnem::evaluate {
namespace {

namespace fs = std::filesystem;

template<class Result, class Carry> void carry_conditions(Result& result, Carry& carry) {
  carry("tool", result.tool);
  carry("time[s]", result.time);
  carry("cut[m]", result.cut);
  carry("feed[m]", result.feed);
  carry("width[m]", result.width);
  carry("speed[m/s]", result.speed);
  carry("rake[rad]", result.rake);
  carry("along_x", result.along_x);
  carry("along_y", result.along_y);
  carry("away_x", result.away_x);
  carry("away_y", result.away_y);
}

template<class Result, class Carry> void carry_forces(Result& result, Carry& carry) {
  carry("steady", result.steady);
  carry("steady_note", result.steady_note);
  carry("steady_from[m]", result.steady_from);
  carry("steady_to[m]", result.steady_to);
  carry("filter[m]", result.filter);
  carry("Fc[N/m]", result.Fc);
  carry("Fc_spread[N/m]", result.Fc_spread);
  carry("Ft[N/m]", result.Ft);
  carry("Ft_spread[N/m]", result.Ft_spread);
  carry("edge_Fc[N/m]", result.edge_Fc);
  carry("edge_Ft[N/m]", result.edge_Ft);
  carry("specific_energy[J/m^3]", result.specific_energy);
  carry("friction_angle[rad]", result.friction_angle);
  carry("shear_stress[Pa]", result.shear_stress);
}

template<class Result, class Carry> void carry_plies(Result& result, Carry& carry) {
  carry.newer("breaks", result.breaks);
  carry.newer("chip_completed", result.chip_completed);
  carry.newer("engaged_at[m]", result.engaged_at);
  carry.newer("released_at[m]", result.released_at);
  carry.newer("completed_at[m]", result.completed_at);
  carry.newer("Fc_peak[N/m]", result.Fc_peak);
  carry.newer("Ft_peak[N/m]", result.Ft_peak);
  carry.newer("Fc_of_chip[N/m]", result.Fc_of_chip);
  carry.newer("chip_plane[rad]", result.chip_plane);
  carry.newer("fibre_depth[m]", result.fibre_depth);
  carry.newer("matrix_depth[m]", result.matrix_depth);
  carry.newer("fibre_damage[m^2]", result.fibre_damage);
  carry.newer("matrix_damage[m^2]", result.matrix_damage);
}

template<class Result, class Carry> void carry_bonds(Result& result, Carry& carry) {
  carry.newer("debonds", result.debonds);
  carry.newer("debonded_length[m]", result.debonded_length);
  carry.newer("debonded_depth[m]", result.debonded_depth);
}

template<class Result, class Carry> void carry_chip(Result& result, Carry& carry) {
  carry("chip_note", result.chip_note);
  carry("chip_thickness[m]", result.chip_thickness);
  carry("chip_peak[m]", result.chip_peak);
  carry("chip_valley[m]", result.chip_valley);
  carry("chip_ratio", result.chip_ratio);
  carry("chip_length[m]", result.chip_length);
  carry("chip_from[m]", result.chip_from);
  carry("chip_to[m]", result.chip_to);
  carry("chip_speed[m/s]", result.chip_speed);
  carry("curl_radius[m]", result.curl_radius);
  carry("teeth", result.teeth);
  carry("tooth_spacing[m]", result.tooth_spacing);
  carry("tooth_frequency[1/s]", result.tooth_frequency);
  carry("shear_angle[rad]", result.shear_angle);
  carry("shear_angle_speed[rad]", result.shear_angle_speed);
  carry("shear_angle_rate[rad]", result.shear_angle_rate);
  carry("shear_plane[m]", result.shear_plane);
  carry("shear_plane_angle[rad]", result.shear_plane_angle);
}

template<class Result, class Carry> void carry_faces(Result& result, Carry& carry) {
  carry("contact_length[m]", result.contact_length);
  carry("interface_temperature[K]", result.interface_temperature);
  carry("temperature_max[K]", result.temperature_max);
  carry("tool_temperature_max[K]", result.tool_temperature_max);
  carry("wear_rate[m/s]", result.wear_rate);
  carry("wear_rate_max[m/s]", result.wear_rate_max);
  carry("surface_note", result.surface_note);
  carry("surface_from[m]", result.surface_from);
  carry("surface_to[m]", result.surface_to);
  carry("surface_height[m]", result.surface_height);
  carry("roughness[m]", result.roughness);
  carry.newer("Rz[m]", result.Rz);
  carry("layer[m]", result.layer);
  carry("residual_note", result.residual_note);
  carry("residual_stress_surface[Pa]", result.residual_stress_surface);
  carry("residual_yield", result.residual_yield);
}

template<class Result, class Carry> void carry_cut(Result& result, Carry& carry) {
  carry_conditions(result, carry);
  carry_forces(result, carry);
  carry_plies(result, carry);
  carry_bonds(result, carry);
  carry_chip(result, carry);
  carry_faces(result, carry);
}

/// Tables that are written at the end, by the names of their files.
template<class Result, class Use> void each_table(Result& result, Use&& use) {
  use("forces", result.forces);
  use("rake_face", result.rake_face);
  use("chip", result.chip);
  use("depth", result.depth);
  use("tool_isotherms", result.isotherms);
}

fs::path table_path(const fs::path& folder, const char* name) {
  return folder / results::files::cutting_folder / fmt::format("{}.csv", name);
}

std::string csv_text(const results::HistoryTable& table) {
  std::string text = fmt::format("{}\n", fmt::join(table.names, ","));
  for (std::size_t row = 0; row < table.rows(); ++row) {
    for (std::size_t k = 0; k < table.column.size(); ++k)
      text += fmt::format("{}{}", k == 0 ? "" : ",", table.column[k][row]);
    text += "\n";
  }
  return text;
}

} // namespace

std::vector<std::pair<std::string, double>> metrics_of(const CuttingResult& result) {
  constexpr double degree = std::numbers::pi / 180.0;
  std::vector<std::pair<std::string, double>> list{
      {"cutting.Fc[N]", result.in_newton(result.Fc)},
      {"cutting.Fc_spread[N]", result.in_newton(result.Fc_spread)},
      {"cutting.Ft[N]", result.in_newton(result.Ft)},
      {"cutting.Ft_spread[N]", result.in_newton(result.Ft_spread)},
      {"cutting.Fc_per_width[N/m]", result.Fc},
      {"cutting.Ft_per_width[N/m]", result.Ft},
      {"cutting.edge_Fc[N]", result.in_newton(result.edge_Fc)},
      {"cutting.edge_Ft[N]", result.in_newton(result.edge_Ft)},
      {"cutting.specific_energy[J/m^3]", result.specific_energy},
      {"cutting.friction_angle[deg]", result.friction_angle / degree},
      {"cutting.shear_stress[Pa]", result.shear_stress},
      {"cutting.chip_thickness[m]", result.chip_thickness},
      {"cutting.chip_peak[m]", result.chip_peak},
      {"cutting.chip_valley[m]", result.chip_valley},
      {"cutting.chip_ratio", result.chip_ratio},
      {"cutting.chip_length[m]", result.chip_length},
      {"cutting.chip_speed[m/s]", result.chip_speed},
      {"cutting.curl_radius[m]", result.curl_radius},
      {"cutting.shear_angle[deg]", result.shear_angle / degree},
      {"cutting.shear_angle_speed[deg]", result.shear_angle_speed / degree},
      {"cutting.shear_angle_rate[deg]", result.shear_angle_rate / degree},
      {"cutting.shear_plane[m]", result.shear_plane},
      {"cutting.contact_length[m]", result.contact_length},
      {"cutting.tooth_spacing[m]", result.tooth_spacing},
      {"cutting.tooth_frequency[1/s]", result.tooth_frequency},
      {"cutting.interface_temperature[K]", result.interface_temperature},
      {"cutting.temperature_max[K]", result.temperature_max},
      {"cutting.tool_temperature_max[K]", result.tool_temperature_max},
      {"cutting.wear_rate[m/s]", result.wear_rate},
      {"cutting.wear_rate_max[m/s]", result.wear_rate_max},
      {"cutting.roughness[m]", result.roughness},
      {"cutting.Rz[m]", result.Rz},
      {"cutting.residual_stress_surface[Pa]", result.residual_stress_surface},
      {"cutting.residual_yield", result.residual_yield},
      {"cutting.steady_from[m]", result.steady_from},
      {"cutting.steady_to[m]", result.steady_to},
      {"cutting.steady", result.steady ? 1.0 : 0.0}};
  if (result.breaks || result.debonds)
    list.insert(list.end(), {{"cutting.Fc_peak[N]", result.in_newton(result.Fc_peak)},
                             {"cutting.Ft_peak[N]", result.in_newton(result.Ft_peak)}});
  if (result.debonds)
    list.insert(list.end(), {{"cutting.chip_length[m]", result.chip_length},
                             {"cutting.curl_radius[m]", result.curl_radius},
                             {"cutting.debonded_length[m]", result.debonded_length},
                             {"cutting.debonded_depth[m]", result.debonded_depth}});
  if (result.breaks)
    list.insert(list.end(), {{"cutting.Fc_of_chip[N]", result.in_newton(result.Fc_of_chip)},
                             {"cutting.engaged_at[m]", result.engaged_at},
                             {"cutting.released_at[m]", result.released_at},
                             {"cutting.completed_at[m]", result.completed_at},
                             {"cutting.chip_plane[deg]", result.chip_plane / degree},
                             {"cutting.fibre_depth[m]", result.fibre_depth},
                             {"cutting.matrix_depth[m]", result.matrix_depth},
                             {"cutting.fibre_damage[m^2]", result.fibre_damage},
                             {"cutting.matrix_damage[m^2]", result.matrix_damage},
                             {"cutting.chip_completed", result.chip_completed ? 1.0 : 0.0}});
  return list;
}

void write_cutting(const fs::path& folder, const CuttingResult& result) {
  fs::create_directories(folder / results::files::cutting_folder);
  each_table(result, [&](const char* name, const results::HistoryTable& table) {
    results::write_atomically(table_path(folder, name), csv_text(table));
  });
  JsonWriter writer;
  carry_cut(result, writer);
  results::write_atomically(folder / results::files::cutting, writer.json.dump(1) + "\n");
}

std::optional<CuttingResult> read_cutting_numbers(const fs::path& folder) {
  return read_evaluation(folder / results::files::cutting, [](const Json& json) {
    CuttingResult written;
    JsonReader reader(json);
    carry_cut(written, reader);
    return written;
  });
}

std::optional<CuttingResult> read_cutting(const fs::path& folder) {
  std::optional<CuttingResult> result = read_cutting_numbers(folder);
  if (!result) return result;
  each_table(*result, [&](const char* name, results::HistoryTable& table) {
    table = results::read_history(table_path(folder, name));
  });
  result->course = results::read_history(folder / results::files::cutting_course);
  return result;
}

} // namespace cnem::evaluate
