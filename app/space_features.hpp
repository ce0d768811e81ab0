#pragma once
// What runs in space have of app/plane_features.hpp: their state, a cloud that follows the deformation,
// pictures, the evaluation of cuts. What they have not is refused by the reader (input/keys/space.cpp).
#include "app/space_adaptation.hpp"
#include "evaluate/blanking_result.hpp"
#include "input/case.hpp"
#include "mechanics/explicit_solver.hpp"
#include "report/space_recorder.hpp"
#include "results/file_queue.hpp"
#include "results/history_log.hpp"
#include "results/snapshot.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace cnem::app {

class SpaceFeatures {
public:
  using Follow = SpaceAdaptation::Follow;

  /// `input` must outlive this object.
  SpaceFeatures(const input::Case& input, const ExplicitSolver<3>& solver)
      : input_(&input), adaptation_(input, solver) {}
  /// Begin the files of a run, none without a folder, or go on with them; what is later than `time` (s) is
  /// dropped. Throw IoError.
  void start(const std::filesystem::path& folder, ExplicitSolver<3>& solver, const Follow& follow) {
    adaptation_.start_log(folder);
    adaptation_.fit_to_tools(solver, follow);
    if (!folder.empty()) pictures_.emplace(*input_, folder);
  }
  void resume(const std::filesystem::path& folder, double time) {
    adaptation_.resume_log(folder);
    if (!folder.empty()) pictures_.emplace(*input_, folder).truncate(time);
  }
  void archive(Archive& archive) { adaptation_.archive(archive); }
  double renew(ExplicitSolver<3>& solver, const Follow& follow) {
    if (adaptation_.active()) return adaptation_.renew(solver, follow);
    return solver.prepare(), 1.0;
  }
  void add_step(const ExplicitSolver<3>&) {}
  void record(const ExplicitSolver<3>&) {}
  results::Snapshot<3> snapshot(const ExplicitSolver<3>& solver) { return results::snapshot(solver); }
  /// In runs with a folder.
  void draw(results::FileQueue& files, const results::Snapshot<3>& shot) { pictures_->record(files, shot); }
  /// Gives all pictures of a field one scale, once the fields are on the disk. Throws IoError.
  void finish_pictures(results::FileQueue& files) {
    if (pictures_) pictures_->finish(files);
  }
  std::string draw_place(results::FileQueue&, const ExplicitSolver<3>&, std::size_t) { return ""; }
  std::string unload(const ExplicitSolver<3>&) { return ""; }
  /// Evaluates the cut of a run that has ended, where the case asks for it, and writes it into the folder, if
  /// there is one. Throws IoError.
  void evaluate(const std::filesystem::path& folder, const ExplicitSolver<3>& solver,
                const results::HistoryLog& history);
  std::vector<std::pair<std::string, double>> metrics() const;
  std::vector<std::string> flags() const { return {}; }

private:
  const input::Case* input_;
  SpaceAdaptation adaptation_;
  std::optional<report::SpaceRecorder> pictures_;
  std::optional<evaluate::BlankingResult> blanking_; ///< of the state at the end
};

} // namespace cnem::app
