#pragma once
// Values of the fields of the catalogue (mechanics/field_catalogue.hpp), at points and at nodes.
#include "mechanics/field_catalogue.hpp"
#include "results/snapshot.hpp"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace cnem::results {

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
