#pragma once
// The threads of a run.

namespace cnem {

/// Throws InputError, which says what the machine has, for less than none and for more than are of any use;
/// `what` names who asked for them ("--threads").
void check_threads(int threads, const char* what);

/// Starts the threads of parallel loops: so many, or as many as OpenMP takes by itself when 0. Throws
/// InputError as check_threads() does, and IoError when the system does not give them.
void use_threads(int threads);

/// While one lives, parallel loops that this thread starts have so many threads; 0: as many as before.
class ThreadCount {
public:
  explicit ThreadCount(int threads);
  ~ThreadCount();
  ThreadCount(const ThreadCount&) = delete;
  ThreadCount& operator=(const ThreadCount&) = delete;

private:
  int before_;
};

} // namespace cnem
