#include "app/process/run_signals.hpp"

#include <atomic>

namespace cnem::app {

namespace {

std::atomic<int> stop_signal{0};
std::atomic<bool> checkpoint_wanted{false};
static_assert(std::atomic<int>::is_always_lock_free && std::atomic<bool>::is_always_lock_free);

extern "C" void note_signal(int signal) {
  if (signal == SIGUSR1)
    checkpoint_wanted = true;
  else
    stop_signal = signal;
}

} // namespace

RunSignals::RunSignals() {
  stop_signal = 0;
  checkpoint_wanted = false;
  for (std::size_t k = 0; k < signals.size(); ++k) {
    struct sigaction action {};
    action.sa_handler = note_signal;
    action.sa_flags = SA_RESTART;
    sigaction(signals[k], nullptr, &before_[k]);
    if (signals[k] != SIGHUP || before_[k].sa_handler != SIG_IGN) sigaction(signals[k], &action, nullptr);
  }
}

RunSignals::~RunSignals() {
  for (std::size_t k = 0; k < signals.size(); ++k) sigaction(signals[k], &before_[k], nullptr);
}

const char* RunSignals::stop() {
  const int signal = stop_signal;
  return signal == 0 ? nullptr : signal == SIGINT ? "SIGINT" : signal == SIGHUP ? "SIGHUP" : "SIGTERM";
}

bool RunSignals::take_checkpoint() { return checkpoint_wanted.exchange(false); }

} // namespace cnem::app
