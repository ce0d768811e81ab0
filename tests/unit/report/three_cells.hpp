#pragma once
// Three cells round a notch.
#include "core/index.hpp"
#include "core/operators/discretisation.hpp"

namespace cnem::report {

inline CellGeometry<2> three_cells() {
  CellGeometry<2> cells;
  cells.vertex = {{0, 0}, {20, 0}, {20, 20}, {0, 20}, {40, 0}, {40, 20}, {0, 40}, {20, 30}, {40, 40}};
  cells.begin = {0, 4, 8, 13};
  cells.index = {0, 1, 2, 3, 1, 4, 5, 2, 3, 5, 8, 7, 6};
  cells.vertex_begin = {0};
  for (std::int32_t v = 0; v < 9; ++v) { // vertices move with nodes at them
    cells.vertex_begin.push_back(v + 1);
    cells.vertex_node.push_back(as<NodeIndex>(v));
    cells.vertex_weight.push_back(1.0);
  }
  return cells;
}

} // namespace cnem::report
