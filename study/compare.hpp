#pragma once
// One case, solved by several methods: a run for each, and a page that lays them side by side.
#include "evaluate/force_stroke.hpp"
#include "input/case.hpp"
#include "results/history_writer.hpp"
#include "study/batch.hpp"
#include "study/page.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace cnem::study {

/// What is compared, as a command line says it.
struct Comparison {
  std::filesystem::path case_file;                            ///< TOML
  std::string methods;                                        ///< names with commas between them
  std::vector<std::string> set;                               ///< "key=value", for all methods
  std::vector<std::pair<std::string, std::string>> set_for{}; ///< a method, and "key=value" for it alone
  int threads = 0;                                            ///< 0: as a run takes by itself
};

/// One run for each method, in their order, named after it; one at a time. Throws InputError for a method
/// that does not exist or is named twice, and for values of method.name. The case is not looked at.
Study study_of(const Comparison& comparison);

/// Runs the methods as run_batch() does and writes compare.csv and compare.html. All cases are read before
/// any starts: a method that cannot give what the case asks for is refused and shown with its reason, the
/// others run. Throws InputError when all are refused or anything else is wrong with a case.
Exit compare(const Comparison& comparison, const BatchOptions& options);

/// What a run has left behind, as far as it came.
struct Outcome {
  std::optional<input::Case> input; ///< none for a method that is refused
  RunRecord record;
  std::optional<results::RunStatus> status; ///< of failed runs too
  results::HistoryTable history;            ///< may be empty

  bool done() const { return record.state == RunRecord::State::done; }
};

/// A name of results in words: "support wall" of "support.wall".
std::string in_words(std::string name);

/// What is known of all runs of a comparison.
struct Compared {
  const Study& study;
  std::filesystem::path folder;
  std::string version;
  std::vector<Outcome> outcome;                  ///< [run]
  std::optional<evaluate::LeadingForce> force{}; ///< by which runs are compared; of the first that is done
};

/// A number of each run, SI unless its name gives another unit.
struct ComparedNumber : NumberColumn {
  std::string label; ///< in words
  enum class Shown { plain, count, unit, duration, percent } shown = Shown::plain;
  std::string unit{};
};
/// Size, cost and forces; probes at the end and all metrics of the runs.
std::vector<ComparedNumber> compared_numbers(const Compared& compared);
std::vector<ComparedNumber> compared_metrics(const Compared& compared);

/// compare.csv: a row for each method.
std::string compare_table(const Compared& compared);

/// compare.html: numbers, charts, and the pictures of the case, drawn anew with one scale for all methods.
std::string compare_report(const Compared& compared);

/// The part of it with pictures; nothing where there are none.
std::string compare_pictures(const Compared& compared);

} // namespace cnem::study
