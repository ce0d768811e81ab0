#pragma once
#include <numbers>

namespace cnem {

inline constexpr double degree = std::numbers::pi / 180.0;

} // namespace cnem
