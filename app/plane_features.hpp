#pragma once
// What runs in the plane have and those in space have not: a cloud that follows the deformation, pictures,
// springback, the evaluation of cuts.
#include "app/adaptation.hpp"
#include "evaluate/blanking_result.hpp"
#include "evaluate/cutting.hpp"
#include "evaluate/experiment.hpp"
#include "evaluate/springback.hpp"
#include "report/picture_recorder.hpp"
#include "results/file_queue.hpp"
#include "results/history_log.hpp"
#include "results/snapshot.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace cnem::app {

class PlaneFeatures {
public:
  /// `input` must outlive this object.
  PlaneFeatures(const input::Case& input, const ExplicitSolver<2>& solver)
      : input_(&input), adaptation_(input, solver) {
    if (input.report.cutting) cutting_.emplace(input);
  }

  /// Begins the files of a run, none without a folder, and fits the cloud to the tools before the first step.
  /// Throws IoError.
  void start(const std::filesystem::path& folder, ExplicitSolver<2>& solver,
             const Adaptation::Follow& follow);
  /// Goes on with the files that are there; what is later than `time` (s) is dropped. Throws IoError.
  void resume(const std::filesystem::path& folder, double time);
  void archive(Archive& archive) {
    adaptation_.archive(archive);
    if (cutting_) cutting_->archive(archive);
  }

  /// Makes a new reference. Returns the share of the nodes that came or went, 1 without adaptation. Throws
  /// GeometryError with the solver left as it was, IoError.
  double renew(ExplicitSolver<2>& solver, const Adaptation::Follow& follow);

  /// What is followed through every step, and through every row of the history. Throws IoError.
  void add_step(const ExplicitSolver<2>& solver) {
    if (cutting_) cutting_->add_step(solver);
  }
  void record(const ExplicitSolver<2>& solver) {
    if (cutting_) cutting_->record(solver);
  }

  /// The state with all that is known of it, good until the next one.
  results::Snapshot<2> snapshot(const ExplicitSolver<2>& solver);
  /// In runs with a folder.
  void draw(results::FileQueue& files, const results::Snapshot<2>& shot) { pictures_->record(files, shot); }
  /// Gives all pictures of a field one scale, once the fields are on the disk. Throws IoError.
  void finish_pictures(results::FileQueue& files) {
    if (pictures_) pictures_->finish(files);
  }
  /// Returns the file's name in the folder of pictures.
  std::string draw_place(results::FileQueue& files, const ExplicitSolver<2>& solver, std::size_t node);

  /// Lets the bodies go, where the case asks for it. Returns why that cannot be done; "" when it can.
  std::string unload(const ExplicitSolver<2>& solver);
  /// Evaluates the cut of a run that has ended, where the case asks for it, and writes it into the folder, if
  /// there is one. Throws IoError.
  void evaluate(const std::filesystem::path& folder, const ExplicitSolver<2>& solver,
                const results::HistoryLog& history);
  /// Named results for status.json, and the names of those that are true or false.
  std::vector<std::pair<std::string, double>> metrics() const;
  std::vector<std::string> flags() const;

private:
  const input::Case* input_;
  Adaptation adaptation_;
  AdaptationFields adaptation_fields_;
  std::optional<report::PictureRecorder> pictures_;
  std::optional<Springback> springback_; ///< of the state at the end
  std::optional<evaluate::BlankingResult> blanking_;
  std::vector<evaluate::ExperimentResult> experiments_;
  std::optional<evaluate::CuttingCourse> cutting_;
  std::optional<evaluate::CuttingResult> cut_; ///< of the state at the end
};

} // namespace cnem::app
