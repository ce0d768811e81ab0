#pragma once
// Numbers in JSON.
#include <nlohmann/json.hpp>

#include <cmath>

namespace cnem::results {

/// The number, or null where it is not finite: JSON has no word for that.
inline nlohmann::ordered_json json_number(double value) {
  return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json(nullptr);
}

} // namespace cnem::results
