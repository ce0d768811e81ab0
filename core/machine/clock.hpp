#pragma once
// Wall-clock time for measuring.
#include <chrono>

namespace cnem {

/// s since an arbitrary moment, never going back.
inline double wall_time() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

} // namespace cnem
