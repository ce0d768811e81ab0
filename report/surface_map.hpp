#pragma once
// Pictures of a quantity over a rectangle of places.
#include "results/shown_units.hpp"

#include <string>
#include <vector>

namespace cnem::report {

struct SurfaceMap {
  std::vector<double> along, height; ///< m, corners of cells, increasing
  std::vector<double> value;         ///< [cell along the height × cell along] m
};

/// What is left on a machined surface, as a PNG file. title: upper left. Throws IoError.
std::string machined_map(const SurfaceMap& map, const std::string& title, double time,
                         const results::ShownUnits& units);

} // namespace cnem::report
