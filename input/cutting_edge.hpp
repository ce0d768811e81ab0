#pragma once
// What of a tool lies behind its rake face.
#include "input/case.hpp"

namespace cnem::input {

struct CuttingEdge {
  double clearance = 0.0; ///< rad, of the first straight side beyond the edge that does not face the motion
  double radius = 0.0;    ///< m, the largest between that and the rake face; 0: sharp
};

/// At t = 0. Throws InputError as cutting_tool does (input/cutting_tool.hpp).
CuttingEdge cutting_edge(const Case& input, std::size_t tool);

} // namespace cnem::input
