#pragma once
// Outlines that a case takes from drawings: they become paths before the case is read, so that nothing
// downstream knows of files, and the resolved case stands alone.
#include "input/schema/diagnostics.hpp"
#include "input/schema/document.hpp"

#include <filesystem>

namespace cnem::input {

/// Puts paths and circles in the place of the tables `drawing` of a document: of domain (its outline and its
/// holes), domain.outer, domain.holes.NAME and tools.NAME. Names of files are seen from `folder`. Messages
/// about what was put there name key, file and line.
void take_from_drawings(Value& document, const std::filesystem::path& folder, Diagnostics& diagnostics);

} // namespace cnem::input
