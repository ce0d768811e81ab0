#pragma once
// Ramps of temperature, which begin where the body does.
#include "input/schema/document.hpp"

namespace cnem::input {

/// Writes `from` into ramps of temperature that do not say where they start: `initial.temperature`.
void start_temperature_ramps(Value& document);

} // namespace cnem::input
