#pragma once
// One static solution of a case, with stress intensity factors where there are cracks.
#include "app/run.hpp"
#include "app/statics/static_model.hpp"
#include "app/stopwatch.hpp"
#include "input/case.hpp"

#include <optional>
#include <vector>

namespace cnem::app {

/// Solved in one go. Before that its state is that of the body at rest.
template<int dim> class StaticRun final : public Session {
public:
  /// Builds the model, then takes the folder. `input` and `observer` must outlive this object. Throws
  /// InputError and IoError.
  StaticRun(const input::Case& input, const RunOptions& options, RunObserver& observer);

  /// Solves the case and writes its folder: fields, history (one row), pictures, status.json with K_I, K_II
  /// of every tip, report. Throws InputError (a missing support is named) and IoError.
  std::optional<Exit> go_on() override;
  results::RunStatus status() override { return status_; }
  std::variant<results::Snapshot<2>, results::Snapshot<3>> snapshot() override { return shot(); }
  const results::HistoryLog& history() const override { return history_; }

private:
  results::Snapshot<dim> shot() const;
  void solve();
  void give_up(const DivergenceError& error);
  void write_history();
  void write_files();
  /// Makes the report, and the status with its times. Returns the path of the report, "" without a folder.
  std::filesystem::path write_report();
  results::RunStatus blank_status() const;
  void judge(const std::vector<TipResult>& tips);

  const input::Case& input_;
  RunOptions options_;
  RunObserver& observer_;
  Stopwatch watch_;
  StaticModel<dim> model_;
  StaticSolution<dim> solution_;
  State<dim> state_;
  double displacement_scale_ = 1.0; ///< of pictures
  results::HistoryLog history_;
  results::RunStatus status_;
  bool ended_ = false;
};

/// Builds geometry: nodes, unknowns, crack tips with the domains they are evaluated in, and what is held.
/// Throws InputError.
template<int dim> Checked check_static(const input::Case& input, const RunOptions& options);

extern template class StaticRun<2>;
extern template class StaticRun<3>;

} // namespace cnem::app
