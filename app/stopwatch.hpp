#pragma once
// Wall time by phase, and time of processors.
#include "core/machine/clock.hpp"

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace cnem::app {

/// Phases of a run in the order they are listed: what is behind a dot is a part of what stands before it.
inline constexpr const char* phases[] = {
    "setup",          "step",          "step.motion",     "step.contact",      "step.stress",
    "step.forces",    "step.heat",     "step.stable",     "rebuild",           "output",
    "output.history", "output.fields", "output.pictures", "output.checkpoint", "output.disk",
    "output.report"};

/// Seconds spent in each of the phases; the total, and the time of processors, run from construction.
class Stopwatch {
public:
  /// Counts the wall time of work() to a phase; calls may nest.
  template<class Work> auto time(const char* phase, Work&& work) {
    struct Guard {
      double& sum;
      double start = wall_time();
      ~Guard() { sum += wall_time() - start; }
    } guard{spent_[phase]};
    return work();
  }
  /// Counts what was spent elsewhere, before a restart for instance.
  void add(const std::string& phase, double seconds) {
    if (phase == "total")
      start_ -= seconds;
    else
      spent_[phase] += seconds;
  }
  /// Time between the two does not count.
  void pause() { paused_ = {wall_time(), cpu_time()}; }
  void go_on() {
    if (!paused_) return;
    start_ += wall_time() - paused_->first;
    cpu_start_ += cpu_time() - paused_->second;
    paused_.reset();
  }
  void add_cpu(double seconds) { cpu_start_ -= seconds; }
  /// s, of all threads of the process.
  double cpu() const { return (paused_ ? paused_->second : cpu_time()) - cpu_start_; }
  std::vector<std::pair<std::string, double>> spent() const {
    std::vector<std::pair<std::string, double>> list{
        {"total", (paused_ ? paused_->first : wall_time()) - start_}};
    for (const char* phase : phases) {
      const auto found = spent_.find(phase);
      list.emplace_back(phase, found == spent_.end() ? 0.0 : found->second);
    }
    return list;
  }

private:
  double start_ = wall_time(), cpu_start_ = cpu_time();
  std::map<std::string, double> spent_;
  std::optional<std::pair<double, double>> paused_; ///< s, wall and processors, since when
};

} // namespace cnem::app
