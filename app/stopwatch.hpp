#pragma once
// Wall time by phase.
#include <chrono>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace cnem::app {

inline double wall_time() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Phases are setup, step, rebuild and output; the total runs from construction.
class Stopwatch {
public:
  template<class Work> auto time(const char* phase, Work&& work) {
    struct Guard {
      double& sum;
      double start = wall_time();
      ~Guard() { sum += wall_time() - start; }
    } guard{spent_[phase]};
    return work();
  }
  /// Counts what was spent before a restart.
  void add(const std::string& phase, double seconds) {
    if (phase == "total")
      start_ -= seconds;
    else
      spent_[phase] += seconds;
  }
  std::vector<std::pair<std::string, double>> spent() const {
    std::vector<std::pair<std::string, double>> list{{"total", wall_time() - start_}};
    for (const char* phase : {"setup", "step", "rebuild", "output"}) {
      const auto found = spent_.find(phase);
      list.emplace_back(phase, found == spent_.end() ? 0.0 : found->second);
    }
    return list;
  }

private:
  double start_ = wall_time();
  std::map<std::string, double> spent_;
};

} // namespace cnem::app
