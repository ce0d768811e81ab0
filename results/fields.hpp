#pragma once
// Values of the fields of the catalogue (mechanics/field_catalogue.hpp), at points and at nodes.
#include "mechanics/field_catalogue.hpp"
#include "results/snapshot.hpp"
#include "results/vtk_reader.hpp"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace cnem::results {

/// Where files for ParaView have a field: "pressure [Pa]", or the array that it is a component of.
template<int dim> FileArray array_in_files(const FieldInfo<dim>& info);

/// Values at stress points [point]; fields of nodes are interpolated with N.
template<int dim> Field values_at_points(const Snapshot<dim>& shot, const std::string& name);

/// Values at nodes [node]; fields of stress points are averaged by shared volume (identity for C-NEM).
template<int dim> Field values_at_nodes(const Snapshot<dim>& shot, const std::string& name);

/// Largest value of a field where it lives, without laying out the field.
template<int dim> double largest_value(const Snapshot<dim>& shot, const std::string& name);

/// Σ weight · value of a field over some nodes, as of values_at_nodes(), without laying out the field where
/// it lives at these nodes.
template<int dim>
double weighted_value(const Snapshot<dim>& shot, const std::string& name, std::span<const NodeIndex> node,
                      std::span<const double> weight);

/// As heads of columns have it: "name[unit]", or the name alone.
std::string with_unit(const std::string& name, const std::string& unit);

/// Area or volume enclosed by the boundary as it stands, m^dim; of revolution m³.
template<int dim> double enclosed_measure(const Snapshot<dim>& shot);

/// Stress-free area or volume of the cells that are broken (ω = 1), m^dim; of revolution m³.
template<int dim> double broken_measure(const Snapshot<dim>& shot);

} // namespace cnem::results
