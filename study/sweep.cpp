#include "study/sweep.hpp"

#include "core/index.hpp"
#include "core/machine/threads.hpp"
#include "input/case_reader.hpp"
#include "input/schema/nearest.hpp"
#include "results/history_writer.hpp"
#include "results/output_folder.hpp"
#include "study/laminate.hpp"
#include "study/page.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace cnem::study {

namespace {

/// What the cases of all runs say.
struct CasesOfStudy {
  std::vector<RunRecord> runs;
  std::vector<std::optional<CutConditions>> cuts; ///< [run], of laminates; none: no orthogonal cut
};

/// Reads the case of every run, so that a mistake in the last one shows before the first one starts.
CasesOfStudy read_cases(const Study& study) {
  CasesOfStudy cases;
  for (const StudyRun& run : study.runs) {
    try {
      const input::Case input = input::read_case_with(study.case_file.string(), run.changes());
      RunRecord& record = cases.runs.emplace_back();
      cases.cuts.push_back(study.laminate ? cut_conditions(input) : std::nullopt);
      record.inputs = inputs_of(input);
      record.variables = input.variables;
      if (const auto& blanking = input.report.blanking) record.punch = input.tools[blanking->punch].name;
    } catch (const InputError& error) {
      throw InputError(fmt::format("{}\nin run '{}' of the study", error.what(), run.name));
    }
  }
  return cases;
}

/// Throws InputError for a chart over a variable that no case has.
void check_variables_of_charts(const Study& study, const std::vector<RunRecord>& runs) {
  if (runs.empty()) return;
  std::vector<std::string> names;
  for (const input::Variable& variable : runs.front().variables) names.push_back("let." + variable.name);
  for (const StudyChart& chart : study.charts)
    if (is_variable(chart.x) && std::find(names.begin(), names.end(), chart.x) == names.end())
      throw InputError(fmt::format("{}: key 'charts.x': found \"{}\", expected a variable of the case{}",
                                   chart.where.text(), chart.x, input::did_you_mean(chart.x, names)));
}

/// Columns and charts that name what no run has.
void warn_of_absent_numbers(const Study& study, const std::vector<RunRecord>& runs) {
  std::vector<std::string> wanted = study.columns, there;
  if (study.laminate)
    wanted.insert(wanted.end(), study.laminate->columns.begin(), study.laminate->columns.end());
  for (const StudyChart& chart : study.charts) wanted.insert(wanted.end(), chart.y.begin(), chart.y.end());
  bool any = false;
  for (const RunRecord& run : runs) {
    if (!run.status) continue;
    any = true;
    for (const auto& [name, value] : run.status->metrics) there.push_back("metrics." + name);
  }
  std::sort(wanted.begin(), wanted.end());
  wanted.erase(std::unique(wanted.begin(), wanted.end()), wanted.end());
  for (const std::string& name : wanted)
    if (any && std::none_of(runs.begin(), runs.end(), [&](const RunRecord& run) {
          return run.status && status_number(*run.status, name);
        }))
      fmt::print(stderr, "warning: no run has '{}'{}\n", name, input::did_you_mean(name, there));
}

/// Curves of columns that no history has.
void warn_of_absent_columns(const Study& study, const std::vector<RunRecord>& runs,
                            const std::filesystem::path& folder) {
  const auto done = std::find_if(runs.begin(), runs.end(), [](const RunRecord& run) { return run.status; });
  if (done == runs.end() || study.history.empty()) return;
  const StudyRun& run = study.runs[index_of(done - runs.begin())];
  const results::HistoryTable table = results::read_history(folder / run.name / results::files::history);
  std::vector<std::string> there;
  for (const std::string& name : table.names) there.push_back(results::split_column_name(name).name);
  for (const StudyHistory& wanted : study.history)
    for (const std::string& name : {wanted.y, wanted.x})
      if (!name.empty() && table.find(name) < 0)
        fmt::print(stderr, "warning: history.csv of {} has no column '{}'{}\n", run.name, name,
                   input::did_you_mean(name, there));
}

} // namespace

Exit sweep(const Study& study, const BatchOptions& options, SweepWork work) {
  check_threads(study.threads, "threads of the study");
  using Runs = std::vector<RunRecord>;
  CasesOfStudy cases = read_cases(study);
  check_variables_of_charts(study, cases.runs);
  std::vector<std::size_t> plies; // the run of each
  if (study.laminate) plies = runs_of_plies(study, cases.runs, cases.cuts);
  const auto write = [&](const Runs& runs) {
    PageTexts texts{.table = sweep_table(study, runs), .report = {}};
    std::string section;
    if (study.laminate) {
      const LaminateCut cut = cut_of_laminate(study, runs, plies, options.output);
      section = laminate_section(study, plies, cut, shown_units(study, options.output));
      texts.more.emplace_back("laminate.csv", laminate_table(study, plies, cut));
    }
    texts.report = sweep_report(study, runs, options.output, options.version, section);
    return texts;
  };
  const auto tell = [&](const Runs& runs) {
    for (const std::string& warning : warnings_of_runs(study, runs))
      fmt::print(stderr, "warning: {}\n", warning);
    warn_of_absent_numbers(study, runs);
    warn_of_absent_columns(study, runs, options.output);
    fmt::print("{}", extrapolations(study, runs));
    if (study.laminate) fmt::print("{}", laminate_line(cut_of_laminate(study, runs, plies, options.output)));
  };
  const Pages pages{
      .kind = "sweep", .table = "table.csv", .report = results::files::report, .write = write, .tell = tell};
  return (work == SweepWork::merge ? merge_batch : run_batch)(study, std::move(cases.runs), options, pages);
}

} // namespace cnem::study
