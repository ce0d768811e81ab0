#pragma once
// What signals ask of a run.
#include <array>
#include <csignal>

namespace cnem::app {

/// While one lives, SIGTERM, SIGINT and SIGHUP ask to stop at a checkpoint, SIGUSR1 for a checkpoint. A
/// hang-up that was ignored before (nohup) stays ignored.
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
  static constexpr std::array<int, 4> signals{SIGTERM, SIGINT, SIGHUP, SIGUSR1};
  std::array<struct sigaction, 4> before_{};
};

} // namespace cnem::app
