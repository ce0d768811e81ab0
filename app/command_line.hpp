#pragma once
// The command line: cnem run | check | schema | report, --version.

namespace cnem::app {

/// Parses and acts. Returns the process's exit code (docs/user_guide.md): 0 done, 2 bad input or usage, 3
/// diverged, 4 reading or writing failed or memory exhausted. Errors go to standard error.
int command_line(int argc, char** argv);

} // namespace cnem::app
