#pragma once
// The stress that stays in a body when load, supports and heat are gone.
#include "evaluate/springback.hpp"
#include "results/snapshot.hpp"

#include <string>

namespace cnem::evaluate {

/// Not-a-number where it is not known; `note` says why.
struct ResidualStress {
  Fields<4> stress;  ///< [·][node] Pa: xx, yy, zz, xy
  Field yield_ratio; ///< [node] von Mises stress over the flow stress at rest and at the last temperature
  std::string note;
};

/// Cauchy stress of a state, laid as in ResidualStress.
Fields<4> stress_at_nodes(const results::Snapshot<2>& shot);

/// None of any of the nodes, for a reason.
ResidualStress no_residual_stress(std::size_t nodes, const std::string& reason);

/// Of a state at the end of a run. body: the same state as springback() takes it, with the temperatures that
/// it cools to; null where nodes are tied.
ResidualStress residual_stress(const results::Snapshot<2>& shot, const StressedBody* body);

} // namespace cnem::evaluate
