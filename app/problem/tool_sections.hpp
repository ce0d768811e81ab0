#pragma once
// The nodes of tools that conduct.
#include "input/case.hpp"
#include "thermal/tool_section.hpp"

#include <string>
#include <vector>

namespace cnem::app {

/// Sections of the tools of a case that have one. Throws InputError with file, line and key for an outline
/// that cannot be filled. Warnings of their clouds are added.
std::vector<ToolSection<2>> tool_sections(const input::Case& input, std::vector<std::string>& warnings);

} // namespace cnem::app
