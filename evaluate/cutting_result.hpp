#pragma once
// What an orthogonal cut came to, for machinists: cutting.json in the folder of results, and tables beside
// it.
#include "evaluate/chip.hpp"
#include "results/history_writer.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace cnem::evaluate {

/// As docs/cutting.md defines it. Not-a-number: it means nothing here, and a note says why.
struct CuttingResult {
  std::string tool;
  double time = 0.0, cut = 0.0;                                    ///< s; m, way of the tool
  double feed = 0.0, width = 0.0;                                  ///< m
  double speed = unknown;                                          ///< m/s, of the tool, mean of the run
  double rake = 0.0;                                               ///< rad
  double along_x = 0.0, along_y = 0.0, away_x = 0.0, away_y = 0.0; ///< unit vectors

  bool steady = false;
  std::string steady_note;                   ///< why it is not
  double steady_from = 0.0, steady_to = 0.0; ///< m of cut, that forces are taken from
  double filter = 0.0;                       ///< m of cut

  // N per m of width; spreads are standard deviations of the filtered forces.
  double Fc = unknown, Fc_spread = unknown, Ft = unknown, Ft_spread = unknown;
  double edge_Fc = unknown, edge_Ft = unknown; ///< of these on edge, chamfer and flank
  double specific_energy = unknown;            ///< J/m³
  double friction_angle = unknown;             ///< rad, of the whole force from the normal of the rake face
  double shear_stress = unknown;               ///< Pa, on a plane at the shear angle

  // Of a chip that breaks off a ply (docs/cutting.md); Fc and Ft are means while the tool is fully engaged.
  bool breaks = false, chip_completed = false;
  double engaged_at = unknown, released_at = unknown, completed_at = unknown; ///< m of cut
  double Fc_peak = unknown, Ft_peak = unknown;            ///< N/m, largest filtered forces, until completion
  double Fc_of_chip = unknown;                            ///< N/m, mean from first touch to completion
  double chip_plane = unknown;                            ///< rad, from the way of the tool
  double fibre_depth = unknown, matrix_depth = unknown;   ///< m below the cut, at completion
  double fibre_damage = unknown, matrix_damage = unknown; ///< m², at completion

  bool debonds = false; ///< there are cohesive interfaces: these, and the largest forces, have a meaning
  double debonded_length = unknown, debonded_depth = unknown; ///< m at the end; m below the cut

  std::string chip_note;
  double chip_thickness = unknown, chip_peak = unknown, chip_valley = unknown; ///< m
  double chip_ratio = unknown;                                                 ///< –, thickness over feed
  double chip_length = unknown, chip_from = unknown, chip_to = unknown;   ///< m; between them it is measured
  double chip_speed = unknown;                                            ///< m/s, along the rake face
  double curl_radius = unknown;                                           ///< m
  double teeth = 0.0, tooth_spacing = unknown, tooth_frequency = unknown; ///< –, m, 1/s

  double shear_angle = unknown;       ///< rad, from thickness
  double shear_angle_speed = unknown; ///< rad, from the direction in which speed jumps
  double shear_angle_rate = unknown;  ///< rad, of the line of the largest rates of strain
  double shear_plane = unknown, shear_plane_angle = unknown; ///< m, rad

  double contact_length = unknown;                                   ///< m
  double interface_temperature = unknown, temperature_max = unknown; ///< K
  double tool_temperature_max = unknown;                             ///< K, of a tool that conducts
  double wear_rate = unknown, wear_rate_max = unknown;               ///< m/s

  std::string surface_note;
  double surface_from = unknown, surface_to = unknown;                                 ///< m, behind the tip
  double surface_height = unknown, roughness = unknown, Rz = unknown, layer = unknown; ///< m
  std::string residual_note;
  double residual_stress_surface = unknown; ///< Pa, along the cut, of the uppermost layer
  double residual_yield = unknown;          ///< –, largest equivalent residual stress over the flow stress

  // cutting/NAME.csv
  results::HistoryTable forces;    ///< over the cut
  results::HistoryTable course;    ///< chip and contact over the cut: cutting.csv, written as the run goes on
  results::HistoryTable rake_face; ///< along it
  results::HistoryTable chip;      ///< thickness along it
  results::HistoryTable depth;     ///< below the machined surface
  results::HistoryTable isotherms; ///< of the tool

  double in_newton(double per_width) const { return per_width * width; }
};

/// Named numbers for status.json: "cutting.Fc[N]", … Those that mean nothing are not-a-number.
std::vector<std::pair<std::string, double>> metrics_of(const CuttingResult& result);

/// Written atomically to `folder`/cutting.json and the tables but `course`. Throws IoError.
void write_cutting(const std::filesystem::path& folder, const CuttingResult& result);
/// Without the tables. Empty when there is no such file. Throws IoError when it cannot be read.
std::optional<CuttingResult> read_cutting_numbers(const std::filesystem::path& folder);
/// With all tables. Empty when there is no such file. Throws IoError when one cannot be read.
std::optional<CuttingResult> read_cutting(const std::filesystem::path& folder);

} // namespace cnem::evaluate
