#pragma once
// A run within Python: when it comes back, calls of Python on its way, interrupts.
#include "app/observer.hpp"

#include <atomic>
#include <cstdint>
#include <exception>
#include <limits>
#include <mutex>
#include <optional>
#include <pybind11/pybind11.h>
#include <string>
#include <vector>

namespace cnem::python {

namespace py = pybind11;

/// When a call comes back before the run has ended.
struct Until {
  double time = std::numeric_limits<double>::infinity();         ///< s, at the first step there or beyond
  std::int64_t steps = std::numeric_limits<std::int64_t>::max(); ///< after so many
  bool output = false;                                           ///< after the next one
};

class Watcher final : public app::RunObserver {
public:
  /// For the next call. callback(row, frame) is called after each output, with the lock of the interpreter;
  /// False (of bool or NumPy) asks to stop, as an exception does.
  void expect(const Until& until, py::object callback);
  /// After it: forgets the callback, and throws what stopped the run: py::error_already_set.
  void settle();
  /// From any thread.
  void stop(const std::string& by);

  bool calls_back() const { return calling_; }
  bool row() const { return row_; } ///< from any thread: the last output since the call began
  bool frame() const { return frame_; }
  /// From any thread.
  std::vector<std::string> messages() const;
  std::string failed() const;

  void remark(const std::string& text) override;
  void outcome(const std::string& text) override { remark(text); }
  void failure(const std::string& text) override;
  void progress(const results::ProgressState& state) override { now_ = state.time; }
  void recorded(bool row, bool frame) override;
  app::Request request() override;

private:
  void look_for_interrupt();

  Until until_;
  py::object callback_;
  std::atomic<bool> row_{false}, frame_{false};
  std::atomic<bool> calling_{false};
  std::exception_ptr thrown_;
  double now_ = 0.0;                      ///< s
  double looked_at_ = 0.0;                ///< s, wall time of the last look for interrupts
  mutable std::mutex mutex_;              ///< of what follows
  std::optional<std::string> stopped_by_; ///< asked for
  std::vector<std::string> messages_;
  std::string failed_;
};

} // namespace cnem::python
