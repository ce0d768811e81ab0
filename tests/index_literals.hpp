#pragma once
// Indices in tests: 3_node is NodeIndex{3}.
#include "core/index.hpp"

namespace cnem::testing::literals {

constexpr NodeIndex operator""_node(unsigned long long number) { return as<NodeIndex>(number); }
constexpr BoundaryNodeIndex operator""_boundary(unsigned long long number) {
  return as<BoundaryNodeIndex>(number);
}
constexpr SimplexIndex operator""_simplex(unsigned long long number) { return as<SimplexIndex>(number); }
constexpr PieceIndex operator""_piece(unsigned long long number) { return as<PieceIndex>(number); }
constexpr ToolIndex operator""_tool(unsigned long long number) { return as<ToolIndex>(number); }

} // namespace cnem::testing::literals
