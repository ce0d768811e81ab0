#include "study/compare.hpp"

#include "core/machine/threads.hpp"
#include "evaluate/blanking_result.hpp"
#include "input/case_reader.hpp"
#include "input/schema/diagnostics.hpp"
#include "input/schema/nearest.hpp"
#include "methods/registry.hpp"
#include "results/output_folder.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace cnem::study {

namespace {

namespace fs = std::filesystem;
using State = RunRecord::State;

constexpr const char* method_key = "method.name";

std::vector<std::string> split(const std::string& list) {
  std::vector<std::string> names(1);
  for (const char c : list)
    if (c == ',')
      names.emplace_back();
    else if (c != ' ')
      names.back() += c;
  return names;
}

std::vector<std::string> method_names(const std::string& list) {
  const std::vector<std::string> names = split(list), known = methods::names();
  for (auto name = names.begin(); name != names.end(); ++name) {
    if (std::find(known.begin(), known.end(), *name) == known.end())
      throw InputError(fmt::format("--methods {}: found '{}', expected methods out of {}, with commas{}",
                                   list, *name, fmt::join(known, ", "), input::did_you_mean(*name, known)));
    if (std::find(names.begin(), name, *name) != name)
      throw InputError(fmt::format("--methods {}: found '{}' twice, expected each method once", list, *name));
  }
  return names;
}

input::Override read_change(const std::string& assignment, const std::string& option) {
  input::Override change = input::parse_override(assignment, option);
  if (change.key == method_key)
    throw InputError(fmt::format("{}: found {}, expected another key: --methods says which methods run",
                                 change.where.text(), method_key));
  return change;
}

/// Reads the case of every method. The reason of a refusal is what the reader says.
std::vector<Outcome> compared_cases(const Study& study) {
  std::vector<Outcome> outcome(study.runs.size());
  std::string refusals;
  for (std::size_t k = 0; k < study.runs.size(); ++k) {
    const std::string& name = study.runs[k].name;
    RunRecord& record = outcome[k].record;
    try {
      outcome[k].input = input::read_case_with(study.case_file.string(), study.runs[k].changes());
      record.inputs = inputs_of(*outcome[k].input);
    } catch (const input::MethodRefusal& refusal) {
      record.state = State::refused;
      record.exit = Exit::bad_input;
      record.reason =
          fmt::format("{}\n--set-for {} KEY=VALUE says what it runs with instead", refusal.what(), name);
      refusals += fmt::format("{}{}", refusals.empty() ? "" : "\n", refusal.what());
    } catch (const InputError& error) {
      throw InputError(fmt::format("{}\nin the run of method '{}'", error.what(), name));
    }
  }
  if (std::none_of(outcome.begin(), outcome.end(), [](const Outcome& o) { return o.input.has_value(); }))
    throw InputError(refusals);
  return outcome;
}

/// The history of a run. One that failed before it began has left no resolved case: what else is there is not
/// its own; one that was killed may have left anything.
results::HistoryTable history_of(const Outcome& outcome, const fs::path& folder) {
  const fs::path file = folder / results::files::history;
  if (outcome.done()) return results::read_history(file);
  if (outcome.record.state != State::failed || !fs::exists(folder / results::files::resolved_case) ||
      !fs::exists(file))
    return {};
  try {
    return results::read_history(file);
  } catch (const IoError&) { return {}; }
}

/// The force to compare by; none in a static analysis, whose history has one row.
std::optional<evaluate::LeadingForce> force_of(const Outcome& outcome, const fs::path& folder) {
  if (outcome.history.rows() < 2) return {};
  if (outcome.done())
    if (const auto blanking = evaluate::read_blanking(folder); blanking && !blanking->punch.empty())
      return evaluate::leading_force(*blanking);
  return evaluate::leading_force(outcome.history);
}

/// Adds what lies in the folders of the runs.
void collect(Compared& compared, const std::vector<RunRecord>& runs) {
  const auto folder = [&](std::size_t k) { return compared.folder / compared.study.runs[k].name; };
  for (std::size_t k = 0; k < runs.size(); ++k) {
    Outcome& outcome = compared.outcome[k];
    outcome.record = runs[k];
    outcome.status = runs[k].status;
    if (runs[k].state == State::failed && fs::exists(folder(k) / results::files::status))
      outcome.status = results::read_status(folder(k));
    outcome.history = history_of(outcome, folder(k));
  }
  for (const bool done : {true, false})
    for (std::size_t k = 0; k < runs.size() && !compared.force; ++k)
      if (compared.outcome[k].done() == done) compared.force = force_of(compared.outcome[k], folder(k));
}

} // namespace

Study study_of(const Comparison& comparison) {
  Study study;
  study.name = input::name_after(comparison.case_file, "case");
  study.case_file = comparison.case_file;
  study.processes = 1;
  study.threads = comparison.threads;
  std::vector<input::Override> common;
  for (const std::string& assignment : comparison.set) common.push_back(read_change(assignment, "--set"));
  const std::vector<std::string> names = method_names(comparison.methods);
  for (const std::string& name : names) {
    const input::Location where{"--methods " + comparison.methods, 0, 0};
    input::Value method;
    method.kind = input::Value::Kind::text;
    method.text = name;
    method.where = where;
    study.runs.push_back({name, where, common, {{method_key, method, where}}});
  }
  for (const auto& [name, assignment] : comparison.set_for) {
    const auto run = std::find_if(study.runs.begin(), study.runs.end(),
                                  [&wanted = name](const StudyRun& other) { return other.name == wanted; });
    const std::string option = "--set-for " + name;
    if (run == study.runs.end())
      throw InputError(fmt::format("{} {}: found method '{}', expected one of --methods {}{}", option,
                                   assignment, name, comparison.methods, input::did_you_mean(name, names)));
    run->own.push_back(read_change(assignment, option));
    if (const std::string& key = run->own.back().key;
        std::find(study.keys.begin(), study.keys.end(), key) == study.keys.end())
      study.keys.push_back(key);
  }
  return study;
}

Exit compare(const Comparison& comparison, const BatchOptions& options) {
  if (comparison.threads > 0) check_threads(comparison.threads, "--threads");
  Study study = study_of(comparison);
  Compared compared{study, options.output, options.version, compared_cases(study)};
  std::vector<RunRecord> runs;
  for (const Outcome& outcome : compared.outcome) {
    runs.push_back(outcome.record);
    if (outcome.input) study.title = outcome.input->title;
  }
  return run_batch(study, runs, options,
                   {.kind = "comparison",
                    .table = "compare.csv",
                    .report = "compare.html",
                    .write = [&](const std::vector<RunRecord>& records) {
                      collect(compared, records);
                      return PageTexts{compare_table(compared), compare_report(compared)};
                    }});
}

} // namespace cnem::study
