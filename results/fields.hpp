#pragma once
// The fields a user can ask for by name: in pictures, probes and files.
#include "results/snapshot.hpp"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace cnem::results {

/// How a field is coloured in pictures (report/colour_map.hpp).
enum class ColourMap {
  strain,    ///< sequential: dark violet, blue, green, yellow
  heat,      ///< sequential: black, purple, orange, pale yellow
  diverging, ///< blue, near white, red: for fields with a sign, zero in the middle
};

/// A field by its case-file name, with the unit it is shown in.
struct FieldInfo {
  std::string name;          ///< "plastic_strain", as in case files and history columns
  std::string label;         ///< "equivalent plastic strain"
  std::string unit;          ///< SI unit, "" when dimensionless
  std::string shown_unit;    ///< unit in pictures
  double shown_factor = 1.0; ///< SI value of one shown unit
  ColourMap map = ColourMap::strain;
  bool at_nodes = false;  ///< lives at nodes (else at stress points)
  bool adaptive = false;  ///< only where the cloud is adapted
  bool of_damage = false; ///< zero unless a material has a damage law: then left out of files
};

/// All fields, in the order files list them.
const std::vector<FieldInfo>& field_catalogue();

/// Throws InputError for an unknown name.
const FieldInfo& field_info(const std::string& name);

/// Values at stress points [point]; fields of nodes are interpolated with N.
Field values_at_points(const Snapshot& shot, const std::string& name);

/// Values at nodes [node]; fields of stress points are averaged by shared volume (identity for C-NEM).
Field values_at_nodes(const Snapshot& shot, const std::string& name);

/// Largest value of a field where it lives, without laying out the field.
double largest_value(const Snapshot& shot, const std::string& name);

/// Σ weight · value of a field over some nodes, as of values_at_nodes(), without laying out the field where
/// it lives at these nodes.
double weighted_value(const Snapshot& shot, const std::string& name, std::span<const std::int32_t> node,
                      std::span<const double> weight);

/// Area enclosed by the boundary as it stands, m².
double boundary_area(const Snapshot& shot);

/// Stress-free area of the cells that are broken (ω = 1), m², in the meridian plane of revolution.
double broken_area(const Snapshot& shot);

} // namespace cnem::results
