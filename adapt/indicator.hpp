#pragma once
// Where the cloud is too coarse for a field: the indicator of Zienkiewicz and Zhu on Voronoi cells (paper
// 004, (80)-(82)).
#include "adapt/structure.hpp"

namespace cnem::adapt {

struct Indicator {
  Field error;        ///< [cell] |e|_i = (∫_Ωi (f* − f_i)² dV)^½, unit of f times m
  double total = 0.0; ///< |e| = (Σ |e|_i²)^½
  double norm = 0.0;  ///< ‖f‖ = (Σ f_i² V_i)^½
};

/// f*: Sibson interpolation of the nodal values, f_i: the constant that nodal integration has in the cell.
/// Integrated over the triangles between each node and the sides of its cell with three Gauss points each:
/// exactly zero for a constant, exact for a linear field.
Indicator indicator(const Cloud<2>& cloud, const Structure& structure, const Field& value);

} // namespace cnem::adapt
