#pragma once
// Which tools cut, where a case does not say so.
#include "input/case.hpp"

#include <optional>
#include <string>
#include <vector>

namespace cnem::input {

/// The name of the tool called `usual`, else of the only one that moves; none where several do.
std::optional<std::string> usual_leader(const std::vector<Tool>& tools, const std::string& usual);

/// Names of the tools that a punch cuts against: those that begin with "die", else those at rest.
std::vector<std::string> usual_dies(const std::vector<Tool>& tools, const std::string& punch);

/// What [report.blanking] is without keys; none where there is no punch or no die.
std::optional<BlankingReport> usual_blanking(const Case& input);

} // namespace cnem::input
