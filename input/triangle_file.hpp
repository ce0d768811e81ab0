#pragma once
// Files of triangles that a case names.
#include "core/geometry/stl.hpp"
#include "input/schema/settings.hpp"

#include <optional>
#include <string>

namespace cnem::input {

/// The triangles of the table `stl`, m, their corners welded (core/geometry/triangle_surface.hpp); none where
/// the file is at fault. It is read once: what its checksum is of is what a run has. In the table the file
/// becomes named from the root, as the resolved case stands elsewhere, and `content` the checksum. case_path:
/// of the file of the case.
std::optional<FacetSoup> read_triangles(Setting& stl, const std::string& case_path, Diagnostics& diagnostics);

// What tables that name files share.
/// A path seen from the folder of the case, from the root.
std::string from_case(const std::string& given, const std::string& case_path);
/// None where it cannot be read.
std::optional<std::string> bytes_of_file(const std::string& path);
/// Makes `content` of the table the checksum of bytes; a mistake of its member `named` where the table, of a
/// resolved case, has another one. False then. Moves members of the table.
bool take_checksum(Setting& table, const char* named, const std::string& bytes, Diagnostics& diagnostics);

} // namespace cnem::input
