#pragma once
// From an indicator to the wanted spacing.
#include "adapt/indicator.hpp"
#include "adapt/plane/structure.hpp"
#include "adapt/space/structure.hpp"

#include <cstdint>
#include <numbers>
#include <type_traits>

namespace cnem::adapt {

/// Area of a hexagonal cell over the square of the spacing.
inline constexpr double hexagon = 0.5 * std::numbers::sqrt3;
/// Measure of a cell over that power of the spacing: of a hexagon, or of a cube.
template<int dim> inline constexpr double cell_of_spacing = dim == 2 ? hexagon : 1.0;

template<int dim> using StructureOf = std::conditional_t<dim == 2, Structure, SpaceStructure>;

struct MarkingRules {
  double tolerance = 0.1; ///< – cells with |e|_i > tolerance ‖f‖/√N are refined
  double coarsen = 0.05;  ///< – below this part of that limit they are made coarser; 0: never
  double h_min = 0.0;     ///< m
  double h_max = 0.0;     ///< m
  double growth = 0.3;    ///< – the spacing changes by at most this per unit of distance
  std::int64_t max_nodes = 100000;
};

struct Marking {
  int refined = 0, coarsened = 0; ///< cells
  double tolerance = 0.0;         ///< – that kept to the budget of nodes
};

/// Halves or doubles the wanted spacing `size` (m, [node]) of marked cells, unless the cloud has not yet
/// followed an earlier mark. Cells that the budget cannot afford are not refined: the tolerance rises.
template<int dim>
Marking mark(const Cloud<dim>& cloud, const StructureOf<dim>& structure, const Indicator& indicator,
             const MarkingRules& rules, Field& size);

/// Lowers the spacing where it grows faster than `growth` per distance from a finer neighbour; mates have
/// the same.
template<int dim>
void limit_growth(const Cloud<dim>& cloud, const StructureOf<dim>& structure, double growth, Field& size);

/// Nodes that a cloud of the given spacing would have: Σ V_i/(½√3 h_i²), in space Σ V_i/h_i³.
double nodes_wanted(const Structure& structure, const Field& size);
double nodes_wanted(const SpaceStructure& structure, const Field& size);

} // namespace cnem::adapt
