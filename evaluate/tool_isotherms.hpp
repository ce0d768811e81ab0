#pragma once
// How far temperatures reach into a tool that conducts.
#include "evaluate/chip.hpp"
#include "input/cutting_tool.hpp"
#include "mechanics/model.hpp"

#include <span>
#include <vector>

namespace cnem::evaluate {

/// The part of a tool, without its coating, that is at least as warm.
struct Isotherm {
  double temperature = 0.0;                      ///< K
  double depth = unknown;                        ///< m, of its deepest point below the rake face
  double face_from = unknown, face_to = unknown; ///< m, from the tip: what of the rake face is in it
};

/// temperature: [node of the section] K, straight between them. `at`: of the isotherms, K; lengths of those
/// that the tool does not reach are not-a-number.
std::vector<Isotherm> tool_isotherms(const ToolSection<2>& section, const Field& temperature,
                                     const input::CuttingTool& cut, std::span<const double> at);

/// Whole hundreds between the coldest and the warmest, K.
std::vector<double> round_temperatures(const Field& temperature);

} // namespace cnem::evaluate
