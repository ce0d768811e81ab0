#include "study/calibration_evaluator.hpp"

#include "core/error.hpp"
#include "evaluate/force_stroke.hpp"
#include "input/case_reader.hpp"
#include "results/checkpoint_folder.hpp"
#include "results/output_folder.hpp"
#include "results/si_format.hpp"
#include "study/process_pool.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fmt/format.h>

namespace cnem::study {
namespace fs = std::filesystem;
namespace {

/// The exit code that a run has left; none while it has not ended, or was stopped.
std::optional<int> ended_with(const fs::path& folder) {
  if (!fs::exists(folder / results::files::status)) return std::nullopt;
  try {
    const int exit = results::read_status(folder).exit;
    if (exit == Exit::interrupted || exit == Exit::io_failed) return std::nullopt;
    return exit;
  } catch (const IoError&) { return std::nullopt; } // half a status is none: the run is done again
}

bool can_go_on(const fs::path& folder) {
  return fs::exists(folder / results::files::resolved_case) && !results::list_checkpoints(folder).empty();
}

/// Why a run has no result.
std::string failure_of(const fs::path& folder, const fs::path& log) {
  std::string reason;
  if (fs::exists(folder / results::files::status)) reason = results::read_status(folder).reason;
  if (reason.empty() && fs::exists(log)) reason = last_line(log);
  return reason.empty() ? "it left no message" : reason;
}

/// Throws IoError for a run that has ended for reasons that are none of its constants.
void check_end(const fs::path& folder, const fs::path& log, const JobEnd& end) {
  if (end.code == Exit::done || end.code == Exit::bad_input || end.code == Exit::diverged) return;
  const std::string how = end.signal != 0
                              ? fmt::format("was killed by signal {}", end.signal)
                              : fmt::format("ended with exit code {}: {}", end.code, failure_of(folder, log));
  throw IoError(
      fmt::format("the run {} {} (log {}): that says nothing of its constants; the same command goes "
                  "on from here",
                  folder.string(), how, log.string()));
}

/// The part of a curve from x to x, with interpolated ends.
evaluate::ComparedCurve cropped(const evaluate::ComparedCurve& curve, double from, double to) {
  const double rounding = 1e-9 * (to - from);
  evaluate::ComparedCurve part{{from}, {}};
  for (const double x : curve.x)
    if (x > from + rounding && x < to - rounding) part.x.push_back(x);
  part.x.push_back(to);
  part.y = evaluate::interpolated(curve.x, curve.y, part.x);
  return part;
}

/// What is said of a measured curve that the run does not go along with.
std::string note_of(const evaluate::ExperimentResult& experiment) {
  constexpr double notable = 0.01; // of the measured range
  const evaluate::CurveDifference& difference = experiment.difference;
  const double first = experiment.measured.x.front(), last = experiment.measured.x.back();
  if (difference.to - difference.from > (1.0 - notable) * (last - first)) return "";
  const char* unit = experiment.over_stroke ? "m" : "s";
  return fmt::format("measured from {} to {}, compared from {} to {}: the run goes no farther.",
                     results::si_format(first, unit), results::si_format(last, unit),
                     results::si_format(difference.from, unit), results::si_format(difference.to, unit));
}

/// Between measured points nothing is known: few of them are compared themselves.
std::vector<double> places_of_residuals(const std::vector<double>& measured) {
  if (measured.size() <= most_residuals) return measured;
  std::vector<double> places;
  for (std::size_t k = 0; k < most_residuals; ++k)
    places.push_back(measured.front() +
                     (measured.back() - measured.front()) * (double(k) + 0.5) / double(most_residuals));
  return places;
}

/// computed − measured at the places of residuals; sets the rms share.
std::vector<double> compare(CalibratedCurve& curve) {
  const evaluate::ComparedCurve& measured = curve.measured;
  const std::vector<double> at = places_of_residuals(measured.x);
  std::vector<double> difference = evaluate::interpolated(curve.computed.x, curve.computed.y, at);
  const std::vector<double> there = evaluate::interpolated(measured.x, measured.y, at);
  double squares = 0.0;
  for (std::size_t k = 0; k < at.size(); ++k) {
    difference[k] -= there[k];
    squares += difference[k] * difference[k];
  }
  curve.rms_share = std::sqrt(squares / double(at.size())) / curve.peak;
  return difference;
}

} // namespace

const CalibratedCurve* Evaluation::curve(const std::string& name) const {
  const auto found =
      std::find_if(curves.begin(), curves.end(), [&](const auto& one) { return one.name == name; });
  return found == curves.end() ? nullptr : &*found;
}

std::optional<double> Evaluation::left_out_misfit() const {
  double squares = 0.0, count = 0.0;
  for (const CalibratedCurve& one : curves) {
    if (one.fitted) continue;
    squares += one.rms_share * one.rms_share;
    count += 1.0;
  }
  return count > 0.0 ? std::optional(std::sqrt(squares / count)) : std::nullopt;
}

std::string failure_of_run(const fs::path& folder) {
  if (ended_with(folder) == Exit::done) return "";
  return fmt::format("{}: {}", folder.filename().string(), failure_of(folder, log_of(folder)));
}

std::string place_key(const Eigen::VectorXd& place) {
  std::string key;
  for (const double value : place) key += fmt::format("{:a} ", value);
  return key;
}

void weigh(Evaluation& evaluation, const std::vector<double>& weights) {
  double all = 0.0;
  for (const double weight : weights) all += weight;
  std::vector<double> residual;
  for (std::size_t c = 0; c < evaluation.curves.size(); ++c) {
    const std::vector<double> difference = compare(evaluation.curves[c]);
    const double factor =
        std::sqrt(weights[c] / (all * double(difference.size()))) / evaluation.curves[c].peak;
    for (const double one : difference) residual.push_back(factor * one);
    evaluation.lengths.push_back(difference.size());
  }
  evaluation.residual =
      Eigen::Map<const Eigen::VectorXd>(residual.data(), static_cast<Eigen::Index>(residual.size()));
  evaluation.misfit = evaluation.residual.squaredNorm();
}

const Evaluation* Evaluator::known(const Eigen::VectorXd& place) const {
  const auto found = evaluations_.find(place_key(place));
  return found == evaluations_.end() ? nullptr : &found->second;
}

std::size_t Evaluator::failures() const {
  return index_of(std::count_if(evaluations_.begin(), evaluations_.end(),
                                [](const auto& entry) { return !entry.second.good(); }));
}

fs::path Evaluator::folder_of(const CalibrationTarget& target, const Eigen::VectorXd& place) const {
  const input::Case input =
      input::read_case_with(target.case_file.string(), calibration_.changes(target, place));
  return options_.output / "runs" / fmt::format("{}-{}", target.name, inputs_of(input));
}

std::string Evaluator::collect_run(const CalibrationTarget& target, std::size_t index,
                                   const Eigen::VectorXd& place, Evaluation& evaluation) const {
  const fs::path folder = folder_of(target, place);
  if (std::string failure = failure_of_run(folder); !failure.empty()) return failure;
  for (evaluate::ExperimentResult& experiment : evaluate::read_experiments(folder)) {
    const evaluate::CurveDifference& difference = experiment.difference;
    if (!difference.common()) return fmt::format("{}: {}", target.name, experiment.note);
    CalibratedCurve& curve = evaluation.curves.emplace_back();
    curve.name = fmt::format("{} {}", target.name, experiment.name);
    curve.target = index;
    curve.over_stroke = experiment.over_stroke;
    curve.x_unit = experiment.over_stroke ? "m" : "s";
    curve.y_unit = experiment.force_unit;
    curve.note = note_of(experiment);
    curve.measured = cropped(experiment.measured, difference.from, difference.to);
    curve.computed = std::move(experiment.computed);
    curve.peak = difference.peak_measured;
    if (experiment.passed_measured.x.size() > 1) { // at the points of the measured curve, and no others
      const evaluate::ComparedCurve& passed = experiment.passed_measured;
      curve.measured.y = evaluate::interpolated(passed.x, passed.y, curve.measured.x);
      curve.computed = std::move(experiment.passed_computed);
    }
  }
  return "";
}

std::string Evaluator::collect_point(const CalibrationTarget& target, std::size_t index,
                                     const Eigen::VectorXd& place, Evaluation& evaluation) const {
  const input::Case input =
      input::read_case_with(target.case_file.string(), calibration_.changes(target, place));
  evaluate::PointTest test = target.point->test;
  const plasticity::Material& material = input.material(target.point->material);
  // A plastic strain is reached a little later than the total one.
  if (test.plastic) test.strain += 2.0 * target.point->measured.y.back() / material.elasticity.young;
  evaluate::PointCurve point = evaluate::point_curve(material, test);
  CalibratedCurve& curve = evaluation.curves.emplace_back();
  curve.name = target.name;
  curve.target = index;
  curve.of_point = true;
  curve.y_unit = "Pa";
  curve.measured = target.point->measured;
  curve.peak = *std::max_element(curve.measured.y.begin(), curve.measured.y.end());
  curve.computed = {std::move(point.strain), std::move(point.stress)};
  if (test.plastic) { // the stress at which flow begins stands at no plastic strain
    const auto& flowing = point.equivalent_strain;
    const auto first = std::find_if(flowing.begin(), flowing.end(), [](double flow) { return flow > 0.0; });
    const auto before = std::max<std::ptrdiff_t>(0, first - flowing.begin() - 1);
    curve.computed.x.erase(curve.computed.x.begin(), curve.computed.x.begin() + before);
    curve.computed.y.erase(curve.computed.y.begin(), curve.computed.y.begin() + before);
  }
  return "";
}

std::string Evaluator::collect(std::size_t index, const Eigen::VectorXd& place,
                               Evaluation& evaluation) const {
  const CalibrationTarget& target = calibration_.targets[index];
  return target.point ? collect_point(target, index, place, evaluation)
         : target.cut ? collect_cut(target, index, place, evaluation)
                      : collect_run(target, index, place, evaluation);
}

Evaluation Evaluator::collected(const Eigen::VectorXd& place) const {
  Evaluation evaluation;
  evaluation.place = place;
  try {
    for (std::size_t t = 0; t < calibration_.targets.size() && evaluation.good(); ++t)
      if (calibration_.targets[t].fitted()) evaluation.failure = collect(t, place, evaluation);
  } catch (const InputError& error) { evaluation.failure = error.what(); }
  if (!evaluation.good()) {
    evaluation.curves.clear();
    evaluation.misfit = failed_misfit;
    return evaluation;
  }
  weigh_cuts(calibration_, evaluation);
  std::vector<double> weights;
  for (const CalibratedCurve& curve : evaluation.curves)
    weights.push_back(calibration_.targets[curve.target].weight * curve.weight);
  weigh(evaluation, weights);
  return evaluation;
}

bool Evaluator::run(const std::vector<Eigen::VectorXd>& places, bool fitted) {
  std::vector<Job> jobs;
  std::vector<fs::path> folders;
  for (const Eigen::VectorXd& place : places)
    for (const CalibrationTarget& target : calibration_.targets) {
      if (!target.runs() || target.fitted() != fitted) continue;
      try {
        const fs::path folder = folder_of(target, place);
        if (ended_with(folder) || !ended_.insert(folder).second) continue;
        jobs.push_back({run_command({.case_file = target.case_file,
                                     .changes = calibration_.changes(target, place),
                                     .folder = folder,
                                     .interrupted = can_go_on(folder),
                                     .threads = calibration_.threads},
                                    options_.program),
                        log_of(folder)});
        folders.push_back(folder);
      } catch (const InputError&) {} // collected() tells
    }
  const std::size_t processes = processes_for(
      options_.processes > 0 ? options_.processes : calibration_.processes, calibration_.threads);
  using Clock = std::chrono::steady_clock;
  std::vector<Clock::time_point> began(jobs.size());
  return run_jobs(
      jobs, processes, [&](std::size_t job) { began[job] = Clock::now(); },
      [&](std::size_t job, JobEnd end) {
        check_end(folders[job], jobs[job].log, end);
        const double seconds = std::chrono::duration<double>(Clock::now() - began[job]).count();
        fmt::print("  run {}: {}, {}\n", folders[job].filename().string(),
                   end.code == Exit::done ? "done" : "FAILED: " + failure_of(folders[job], jobs[job].log),
                   results::duration_format(seconds));
        std::fflush(stdout);
      });
}

bool Evaluator::evaluate(const std::vector<Eigen::VectorXd>& places) {
  if (!run(places, true)) return false;
  for (const Eigen::VectorXd& place : places)
    if (!known(place)) evaluations_.emplace(place_key(place), collected(place));
  return true;
}

bool Evaluator::compare_left_out(const std::vector<Eigen::VectorXd>& places) {
  std::vector<Eigen::VectorXd> good; // the start may be what was found, or have failed
  for (const Eigen::VectorXd& place : places)
    if (known(place)->good() && std::find(good.begin(), good.end(), place) == good.end())
      good.push_back(place);
  if (!run(good, false)) return false;
  for (const Eigen::VectorXd& place : good) {
    Evaluation& evaluation = evaluations_.at(place_key(place));
    const std::size_t before = evaluation.curves.size();
    for (std::size_t t = 0; t < calibration_.targets.size(); ++t) {
      if (calibration_.targets[t].fitted()) continue;
      const std::size_t whole = evaluation.curves.size();
      std::string failure;
      try {
        failure = collect(t, place, evaluation);
      } catch (const InputError& error) { failure = error.what(); }
      if (failure.empty()) continue;
      evaluation.left_out_failures.push_back(failure);
      evaluation.curves.resize(whole); // none of the curves of a target that has failed
    }
    for (std::size_t c = before; c < evaluation.curves.size(); ++c) {
      evaluation.curves[c].fitted = false;
      compare(evaluation.curves[c]);
    }
  }
  return true;
}

} // namespace cnem::study
