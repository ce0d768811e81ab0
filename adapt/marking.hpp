#pragma once
// From an indicator to the wanted spacing.
#include "adapt/indicator.hpp"

#include <cstdint>
#include <numbers>

namespace cnem::adapt {

/// Area of a hexagonal cell over the square of the spacing.
inline constexpr double hexagon = 0.5 * std::numbers::sqrt3;

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
Marking mark(const Cloud<2>& cloud, const Structure& structure, const Indicator& indicator,
             const MarkingRules& rules, Field& size);

/// Lowers the spacing where it grows faster than `growth` per distance from a finer neighbour; mates have
/// the same.
void limit_growth(const Cloud<2>& cloud, const Structure& structure, double growth, Field& size);

/// Nodes that a cloud of the given spacing would have: Σ V_i/(½√3 h_i²).
double nodes_wanted(const Structure& structure, const Field& size);

} // namespace cnem::adapt
