#pragma once
// Files of triangles that a case names.
#include "core/geometry/stl.hpp"
#include "input/schema/settings.hpp"

#include <optional>
#include <string>

namespace cnem::input {

/// The triangles of the table `stl`, m; none where the file is at fault. It is read once: what its checksum
/// is of is what a run has. In the table the file becomes named from the root, as the resolved case stands
/// elsewhere, and `content` the checksum. case_path: of the file of the case.
std::optional<FacetSoup> read_triangles(Setting& stl, const std::string& case_path, Diagnostics& diagnostics);

} // namespace cnem::input
