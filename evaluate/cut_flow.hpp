#pragma once
// How metal flows into a chip, in the frame of the tool (chip.hpp).
#include "core/fields/state.hpp"
#include "evaluate/chip.hpp"
#include "input/cutting_tool.hpp"

#include <span>
#include <vector>

namespace cnem::evaluate {

/// [node] m, of positions in space, for a tool that has moved by `moved`.
std::vector<Vec2> places(const input::CuttingTool& cut, const Vec2& moved, const Fields<2>& position);

/// Of the nodes within a polygon, weighted with mass, m/s; not in motion with the tool, but turned into its
/// axes. Not-a-number where there are none.
Vec2 mean_velocity(std::span<const Vec2> polygon, const input::CuttingTool& cut, std::span<const Vec2> place,
                   const NodeState<2>& node);

/// Angle (rad) of the line x = a + y cot φ through the places between the tip and the free surface where
/// metal flows fastest: least squares of x at each height, weighted with rate (1/s) and volume (m²), within
/// two fifths of a feed of the shear plane. Not-a-number without a chip.
double angle_of_rates(const Chip& chip, double feed, std::span<const Vec2> place,
                      std::span<const double> rate, std::span<const double> volume);

} // namespace cnem::evaluate
