#pragma once
// Numbers of cells along the axes of a part.
#include "input/schema/diagnostics.hpp"
#include "input/schema/settings.hpp"
#include "machining/structure/part.hpp"

#include <array>
#include <optional>
#include <span>

namespace cnem::input {

/// Whole numbers of something along the axes; none, and a mistake, where they are not.
std::optional<std::array<int, 3>> whole_numbers(const Setting& written, const char* what, double most,
                                                Diagnostics& diagnostics);

/// Divides a part with zones as `cells` of its table says, or by default.
void read_cells(const Setting& part, machining::PartElement element,
                std::span<const machining::PartSupport> supports, machining::PartShape& shape,
                Diagnostics& diagnostics);

} // namespace cnem::input
