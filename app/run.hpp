#pragma once
// One run of a case: the time loop in a fixed order, output, adapt, step.
#include "io/case.hpp"

#include <filesystem>
#include <string>

namespace cnem::app {

/// Documented exit codes (docs/user_guide.md).
enum Exit : int { done = 0, bad_input = 2, diverged = 3, io_failed = 4, interrupted = 5 };

struct RunOptions {
  std::filesystem::path output; ///< folder of results
  bool force = false;           ///< replace a run that is there
  int threads = 0;              ///< 0: what OpenMP takes by itself
  std::string version;
};

/// Runs the case into the folder and writes its report. Returns done or diverged (with the post-mortem in
/// status.json and the report). Throws InputError and IoError.
Exit run(const io::Case& input, const RunOptions& options);

/// Builds geometry and model without running: prints nodes, first step and what limits it, steps to come,
/// memory, tool overlap, and writes the initial fields to output/initial. Throws InputError and IoError.
void check(const io::Case& input, const RunOptions& options);

} // namespace cnem::app
