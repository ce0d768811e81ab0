#pragma once
#include <numbers>

namespace cnem {

inline constexpr double rpm = std::numbers::pi / 30.0; ///< rad/s, a revolution a minute

} // namespace cnem
