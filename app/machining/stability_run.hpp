#pragma once
// The stability of one milling case: its limit, a chart, and what they say.
#include "app/run.hpp"
#include "app/stopwatch.hpp"
#include "input/case.hpp"
#include "machining/stability.hpp"

#include <optional>
#include <string>
#include <vector>

namespace cnem::app {

/// Solved in one go, as a static analysis.
class StabilityRun final : public Session {
public:
  /// Takes the folder. `input` and `observer` must outlive this object. Throws InputError and IoError.
  StabilityRun(const input::Case& input, const RunOptions& options, RunObserver& observer);

  /// Writes stability.csv (limits over speeds), stability_chart.csv (spectral radii), stability.svg,
  /// status.json and the report.
  std::optional<Exit> go_on() override;
  results::RunStatus status() override { return status_; }
  /// Throws InputError: there is no body.
  std::variant<results::Snapshot<2>, results::Snapshot<3>> snapshot() override;
  const results::HistoryLog& history() const override { return history_; }

private:
  void solve();
  void judge(const machining::StabilityChart& chart);
  void write_files(const machining::StabilityChart& chart) const;

  const input::Case& input_;
  RunOptions options_;
  RunObserver& observer_;
  Stopwatch watch_;
  results::HistoryLog history_;
  results::RunStatus status_;
  bool ended_ = false;
};

/// What is known before anything is solved.
Checked check_stability(const input::Case& input);

/// What there is to doubt in a milling case, a sentence each.
std::vector<std::string> milling_doubts(const input::Case& input);

} // namespace cnem::app
