#pragma once
// What an orthogonal cut came to: looked at while it goes on, judged at its end.
#include "evaluate/cutting_result.hpp"
#include "evaluate/rake_contact.hpp"
#include "evaluate/springback.hpp"
#include "input/case.hpp"
#include "results/history_log.hpp"
#include "results/snapshot.hpp"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

namespace cnem::evaluate {

/// Whether a material of a case is a ply that can fail: then a chip breaks off, and more is recorded.
bool plies_fail(const input::Case& input);
/// Whether it has cohesive interfaces, of which the debonded length is recorded.
bool bonds_fail(const input::Case& input);

/// Follows a cut: contact on the rake face in every step, force and chip whenever a row of the history is
/// written, in cutting.csv.
class CuttingCourse {
public:
  /// Of a case with [report.cutting], which must outlive this object.
  explicit CuttingCourse(const input::Case& input);

  /// Begins cutting.csv; or goes on behind the rows of the checkpoint. Without a folder rows stay in memory.
  /// Throw IoError.
  void start(const std::filesystem::path& folder);
  void resume(const std::filesystem::path& folder);
  /// After every step.
  void add_step(const ExplicitSolver<2>& solver) { rake_.add_step(solver); }
  void record(const ExplicitSolver<2>& solver);
  void archive(Archive& archive);

  /// What cutting.csv holds. Throws IoError.
  results::HistoryTable rows() const { return log_.table(); }
  const input::CuttingTool& tool() const { return cut_; }
  const RakeContact& rake() const { return rake_; }

private:
  const input::Case* input_;
  input::CuttingTool cut_;
  RakeContact rake_;
  bool plies_, bonds_;
  results::HistoryLog log_;
  std::int64_t rows_ = 0;
  double last_time_ = 0.0;  ///< s, of the last row
  Vec2 last_impulse_{0, 0}; ///< N s/m, of the tool until then
};

/// The state of a run at its end. rows: those of the course; body: that state as it is let go, null where
/// nodes are tied.
CuttingResult evaluate_cutting(const input::Case& input, const results::Snapshot<2>& shot,
                               const CuttingCourse& course, results::HistoryTable rows,
                               const StressedBody* body);

} // namespace cnem::evaluate
