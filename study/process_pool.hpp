#pragma once
// Child processes, several at a time.
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace cnem::study {

struct Job {
  std::vector<std::string> command; ///< program and arguments
  std::filesystem::path log;        ///< takes what it prints
};

/// How a process ended: its exit code, or the signal that killed it.
struct JobEnd {
  int code = -1;
  int signal = 0;
};

/// Runs the jobs in their order, at most `processes` at a time. `begin` is called before a job starts, `end`
/// after it, with its index. SIGINT, SIGTERM and SIGHUP (unless it was ignored before) end all children (with
/// SIGTERM) and return false; so does the death of this process. Throws IoError when a process cannot be
/// made, and what the callbacks throw; no child outlives the call.
bool run_jobs(const std::vector<Job>& jobs, std::size_t processes,
              const std::function<void(std::size_t)>& begin,
              const std::function<void(std::size_t, JobEnd)>& end);

} // namespace cnem::study
