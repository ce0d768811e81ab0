#pragma once
// What there is to doubt in a milling case before it is run.
#include "input/case.hpp"
#include "input/case_machining.hpp"

#include <string>
#include <vector>

namespace cnem::app {

/// A sentence each: teeth that miss the cut, cuts beyond the range of their law, flanks that touch nothing,
/// passes below matter over their edges, dexels and steps that are too coarse; of removal, what it doubts;
/// forces at points of solids.
std::vector<std::string> milling_doubts(const input::Case& input, const std::vector<input::NamedMode>& modes);

} // namespace cnem::app
