#include "study/calibration.hpp"

#include "core/error.hpp"
#include "core/index.hpp"
#include "core/machine/threads.hpp"
#include "input/case_reader.hpp"
#include "results/folder_lock.hpp"
#include "results/output_folder.hpp"
#include "study/calibration_least_squares.hpp"
#include "study/calibration_search.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace cnem::study {
namespace fs = std::filesystem;
namespace {

constexpr const char* kind = "calibration";

/// Constants with their values, in words.
std::string constants_in_words(const Calibration& calibration, const Eigen::VectorXd& place) {
  std::string text;
  for (std::size_t k = 0; k < calibration.constants.size(); ++k) {
    const SoughtConstant& constant = calibration.constants[k];
    text += fmt::format("{}{} = {}", k ? ", " : "", constant.name,
                        constant.text(constant.at(place[static_cast<Eigen::Index>(k)]), 5));
  }
  return text;
}

double misfit_percent(double misfit) { return 100.0 * std::sqrt(misfit); }

std::string misfit_text(const Evaluation& evaluation) {
  return evaluation.good() ? fmt::format("{:.3g}%", misfit_percent(evaluation.misfit)) : "failed";
}

/// Ends where all searches have ended; false after a signal.
bool search_all(const Calibration& calibration, Evaluator& evaluator, std::vector<SearchEnd>& searches) {
  std::vector<std::size_t> told(index_of(calibration.starts), 0);
  for (;;) {
    std::vector<Eigen::VectorXd> wanted;
    searches.clear();
    for (int k = 0; k < calibration.starts; ++k) {
      SearchReplay replay = replay_search(calibration, start_place(calibration, k), evaluator);
      std::size_t& shown = told[index_of(k)];
      for (; shown < replay.end.course.size(); ++shown) {
        const VisitedPlace& visited = replay.end.course[shown];
        const Evaluation& evaluation = *evaluator.known(visited.place);
        fmt::print("start {}, evaluation {}: {}: {}\n", k + 1, shown + 1,
                   constants_in_words(calibration, visited.place),
                   evaluation.good() ? "misfit " + misfit_text(evaluation) : "FAILED: " + evaluation.failure);
      }
      if (replay.wanted.empty())
        searches.push_back(std::move(replay.end));
      else
        wanted.insert(wanted.end(), replay.wanted.begin(), replay.wanted.end());
    }
    std::fflush(stdout);
    if (wanted.empty()) return true;
    if (!evaluator.evaluate(wanted)) return false;
  }
}

/// What cnem calibrate names so: run folders of a target, and what they print beside them.
bool is_of_run(const std::string& name, const Calibration& calibration) {
  constexpr std::size_t hash_digits = 16;
  return std::any_of(calibration.targets.begin(), calibration.targets.end(), [&](const auto& target) {
    if (!name.starts_with(target.name + "-")) return false;
    const std::string rest = name.substr(target.name.size() + 1);
    const std::size_t digits = std::min(rest.find_first_not_of("0123456789abcdef"), rest.size());
    return digits == hash_digits && (rest.size() == digits || rest.substr(digits) == ".log");
  });
}

/// A folder may hold `runs` of somebody else: what else is in it stays.
void remove_runs(const fs::path& runs, const Calibration& calibration) {
  std::vector<fs::path> own;
  for (const auto& entry : fs::directory_iterator(runs))
    if (is_of_run(entry.path().filename().string(), calibration)) own.push_back(entry.path());
  for (const fs::path& path : own) fs::remove_all(path);
}

void write_files(const fs::path& folder, const CalibrationFiles& files) {
  results::write_atomically(folder / "calibrated.toml", files.constants);
  results::write_atomically(folder / "calibration.json", files.json);
  results::write_atomically(folder / "calibration.csv", files.table);
  results::write_atomically(folder / results::files::report, files.report);
}

Exit interrupted() {
  fmt::print(stderr, "interrupted: the same command goes on from here\n");
  return Exit::interrupted;
}

void tell(const Calibration& calibration, const CalibrationResult& result, const fs::path& folder) {
  fmt::print("\nmisfit: {} at the start, {} now\n", misfit_text(result.start), misfit_text(result.best));
  if (const auto misfit = result.best.left_out_misfit()) {
    const auto before = result.start.left_out_misfit();
    fmt::print("misfit of what is left out: {} at the start, {:.3g}% now\n",
               before ? fmt::format("{:.3g}%", 100.0 * *before) : "failed", 100.0 * *misfit);
  }
  for (std::size_t k = 0; k < calibration.constants.size(); ++k) {
    const SoughtConstant& constant = calibration.constants[k];
    const auto at = static_cast<Eigen::Index>(k);
    const double place = result.best.place[at], width = result.inference.half_width[at];
    std::string how;
    if (!result.inference.told[k])
      how = "  (not told by the curves)";
    else if (result.inference.intervals())
      how = fmt::format("  (95%: {} to {})", constant.text(constant.at(place - width), 4),
                        constant.text(constant.at(place + width), 4));
    fmt::print("{} = {}{}\n", constant.key, constant.text(constant.at(place)), how);
  }
  for (const std::string& words : result.inference.words) fmt::print("{}\n", words);
  for (const std::string& warning : warnings_of(calibration, result))
    fmt::print(stderr, "warning: {}\n", warning);
  fmt::print("constants: {}\nreport: {}\n", (folder / "calibrated.toml").string(),
             (folder / results::files::report).string());
}

} // namespace

std::vector<std::string> warnings_of(const Calibration& calibration, const CalibrationResult& result) {
  std::vector<std::string> list = calibration.warnings;
  constexpr double apart = 1.0;    // of the peak
  constexpr double doubtful = 3.0; // standard errors of a number, which may be near 0
  for (const CalibratedCurve& curve : result.best.curves) {
    if (!curve.note.empty()) list.push_back(fmt::format("{}: {}", curve.name, curve.note));
    if (curve.rms_share > apart &&
        !(curve.single_number() && curve.rms_share < doubtful * curve.relative_error))
      list.push_back(
          fmt::format("{}: computed and measured values differ by {:.3g} times the measured {}: are "
                      "{} in the units that are meant?",
                      curve.name, curve.rms_share, curve.single_number() ? "number" : "peak",
                      curve.single_number() ? "they" : "the columns"));
  }
  for (const std::string& failure : result.best.left_out_failures)
    list.push_back("left out, and not compared: " + failure);
  if (result.failures > 0)
    list.push_back(fmt::format("{} of {} evaluations failed and counted as a misfit of {:g}%",
                               result.failures, result.evaluations, misfit_percent(failed_misfit)));
  return list;
}

Exit calibrate(const Calibration& calibration, const BatchOptions& options) {
  check_threads(calibration.threads, "threads of the calibration");
  const fs::path& folder = options.output;
  holds_manifest(folder, kind, options.force);
  make_folder(folder);
  const results::FolderLock lock(folder, kind);
  make_folder(folder / "runs");
  if (options.force) remove_runs(folder / "runs", calibration);
  results::write_atomically(
      folder / "manifest.json",
      nlohmann::ordered_json{{"kind", kind}, {"study", calibration.name}, {"version", options.version}}.dump(
          2) +
          "\n");
  Evaluator evaluator(calibration, options);
  CalibrationResult result;
  if (!search_all(calibration, evaluator, result.searches)) return interrupted();
  const auto best = std::min_element(
      result.searches.begin(), result.searches.end(),
      [](const SearchEnd& a, const SearchEnd& b) { return a.course[a.best].better_than(b.course[b.best]); });
  Eigen::VectorXd place = best->course[best->best].place;
  const bool any_run = std::any_of(calibration.targets.begin(), calibration.targets.end(),
                                   [](const auto& target) { return target.runs() && target.fitted(); });
  std::optional<Linearised> end;
  if (evaluator.known(place)->good()) {
    end = any_run ? few_steps_from(place, evaluator) : least_squares_from(place, evaluator);
    if (!end) return interrupted();
    place = end->place;
  }
  const Evaluation& found = *evaluator.known(place);
  if (found.good() && !evaluator.compare_left_out({place, result.searches.front().course.front().place}))
    return interrupted();
  result.start = *evaluator.known(result.searches.front().course.front().place);
  if (!found.good()) {
    fmt::print(stderr,
               "failed: no evaluation went well, the last one: {}\nTry another start, or `starts = 3` for "
               "more of them between the bounds.\n",
               found.failure);
    return Exit::diverged;
  }
  result.best = found;
  result.inference = infer(calibration, found.residual, end->jacobian, found.lengths, found.known_variance);
  result.logarithmic = logarithmic_values(calibration, found.place, end->jacobian);
  result.evaluations = evaluator.count();
  result.failures = evaluator.failures();
  write_files(folder, calibration_files(calibration, result, flow_bands(calibration, result, folder),
                                        options.version));
  tell(calibration, result, folder);
  return Exit::done;
}

} // namespace cnem::study
