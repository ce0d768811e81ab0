#pragma once
// Time for measuring: of the wall clock, and of processors.
#include <chrono>
#include <ctime>

namespace cnem {

/// s since an arbitrary moment, never going back.
inline double wall_time() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// s that all threads of this process have kept processors busy so far.
inline double cpu_time() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

} // namespace cnem
