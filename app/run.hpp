#pragma once
// Runs of a case, as the command line asks for them.
#include "input/case.hpp"

#include <filesystem>
#include <string>

namespace cnem::app {

struct RunOptions {
  std::filesystem::path output; ///< folder of results
  bool force = false;           ///< replace a run that is there
  int threads = 0;              ///< 0: what OpenMP takes by itself
  std::string version;
  bool profile = false; ///< print where the time went
};

/// Runs the case into the folder and writes its report. Returns done, diverged (with the post-mortem in
/// status.json and the report), interrupted (a signal stopped it at a checkpoint) or io_failed (writing
/// failed on the way; checkpoints are whole). Throws InputError and IoError.
Exit run(const input::Case& input, const RunOptions& options);

/// Goes on with the run in options.output from its newest good checkpoint, from step 0 without one, and ends
/// as the uninterrupted run would have, to the bit. Returns as run() does; done at once for a run that has
/// finished. Throws InputError when the folder holds no run or only checkpoints of another case, and IoError.
Exit restart(const RunOptions& options);

/// Builds geometry and model without running: prints nodes, first step and what limits it, steps to come,
/// memory, tool overlap, and writes the initial fields to output/initial. Throws InputError and IoError.
void check(const input::Case& input, const RunOptions& options);

} // namespace cnem::app
