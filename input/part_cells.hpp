#pragma once
// Numbers of cells along the axes of a part.
#include "input/schema/diagnostics.hpp"
#include "input/schema/settings.hpp"
#include "machining/structure/part.hpp"

#include <array>
#include <optional>

namespace cnem::input {

/// Whole numbers of something along the axes; none, and a mistake, where they are not.
std::optional<std::array<int, 3>> whole_numbers(const Setting& written, const char* what, double most,
                                                Diagnostics& diagnostics);

/// Cells of a box of some size (m), as `cells` of its table says or by default.
std::array<int, 3> read_cells(const Setting& part, const Vec3& size, machining::PartElement element,
                              Diagnostics& diagnostics);

} // namespace cnem::input
