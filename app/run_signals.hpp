#pragma once
// What signals ask of a run.
#include <array>
#include <csignal>

namespace cnem::app {

/// While one lives, SIGTERM and SIGINT ask to stop at a checkpoint, SIGUSR1 for a checkpoint.
class RunSignals {
public:
  RunSignals();
  ~RunSignals();
  RunSignals(const RunSignals&) = delete;
  RunSignals& operator=(const RunSignals&) = delete;

  /// Name of the signal that asked to stop; nullptr when none did.
  static const char* stop();
  /// Whether a checkpoint has been asked for since the last call.
  static bool take_checkpoint();

private:
  static constexpr std::array<int, 3> signals{SIGTERM, SIGINT, SIGUSR1};
  std::array<struct sigaction, 3> before_{};
};

} // namespace cnem::app
