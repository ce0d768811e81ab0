#pragma once
// What evaluations of cuts in the plane and in space share.
#include "evaluate/blanking_result.hpp"
#include "input/case_output.hpp"
#include "results/fields.hpp"

#include <vector>

namespace cnem::evaluate {

/// Nodes whose metal has lost all of its strength but what rubble bears; empty where no material breaks.
template<int dim> std::vector<char> broken_nodes(const results::Snapshot<dim>& shot) {
  if (shot.state.point.softening.empty()) return {};
  constexpr double all = 0.99; // resampling takes means
  const Field softening = results::values_at_nodes(shot, "softening");
  std::vector<char> broken;
  broken.reserve(softening.size());
  for (const double lost : softening) broken.push_back(lost >= all);
  return broken;
}

/// What was measured, beside each face that was computed.
std::vector<MeasuredHeights> measured_beside(const std::vector<ShearedFace>& faces,
                                             const std::vector<input::MeasuredFace>& measured);

} // namespace cnem::evaluate
