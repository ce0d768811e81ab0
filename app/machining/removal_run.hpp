#pragma once
// The motion of a part while a tool takes matter from it.
#include "app/machining/stepped_run.hpp"
#include "app/machining/structure_modes.hpp"
#include "machining/structure/removal.hpp"

namespace cnem::app {

/// Writes history.csv (a row a step), status.json and the report. Goes interval by interval, beside the
/// motion with K̂(t) itself where the case asks for it; checkpoints lie between intervals.
class RemovalRun final : public SteppedRun {
public:
  RemovalRun(const input::Case& input, const RunOptions& options, RunObserver& observer,
             bool goes_on = false);

private:
  bool at_end() const override { return state_.step >= removal_.settings.steps; }
  std::int64_t steps() const override { return state_.step; }
  double time() const override { return static_cast<double>(state_.step) * dt(); }
  double end() const override { return removal_.duration; }
  double dt() const override { return removal_.settings.dt; }
  void advance() override;
  void archive(Archive& archive) override;
  void judge() override;
  void write_files() override {}
  std::vector<double> presence(double time) const;
  Eigen::VectorXd load(double time) const;
  machining::Eigenmodes modes_at(double time) const;

  const input::PartCase& case_;
  const input::RemovalCase& removal_;
  machining::Part part_;
  std::vector<SparseMatrix> place_; ///< [point], [3 × unknowns]
  Eigen::VectorXd standing_;        ///< N, on the unknowns: of forces that stay
  machining::RemovalState state_, reference_;
  std::vector<double> largest_, deviation_, reference_largest_; ///< [point] m, so far
  std::int64_t iterations_ = 0, most_iterations_ = 0;
};

/// What there is to say of a case, and to doubt.
void describe_removal(const input::Case& input, const machining::Part& part, Checked& checked);
std::vector<std::string> removal_doubts(const input::Case& input);

} // namespace cnem::app
