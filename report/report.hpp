#pragma once
// report.html: one file that needs nothing else, neither network nor the folder it came from.
#include "evaluate/blanking_result.hpp"
#include "evaluate/cutting_result.hpp"
#include "evaluate/experiment.hpp"
#include "report/chart.hpp"
#include "report/headline.hpp"
#include "report/report_tables.hpp"
#include "results/status.hpp"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace cnem::report {

struct ReportPicture {
  std::string png; ///< the file itself
  std::string field;
  double time = 0.0; ///< s
  std::string caption;
  std::string note{}; ///< what the case says of it
};

struct ReportData {
  std::string title;           ///< of the case, or its name
  std::string subtitle;        ///< code, version, name of the case
  bool failed = false;         ///< colours the verdict
  std::string verdict;         ///< one line: how the run ended
  std::string run_line;        ///< one line: time, nodes, steps, residual
  std::vector<Figure> figures; ///< the few numbers to see first
  results::ShownUnits units;   ///< of charts and of the sections of cuts
  std::vector<std::string> warnings;
  std::optional<results::PostMortem> post_mortem;
  std::optional<ReportPicture> place;  ///< where it went wrong
  std::vector<ReportPicture> pictures; ///< shown by field, in order of time
  std::vector<Chart> charts;
  std::optional<evaluate::BlankingResult> blanking;
  std::optional<Chart> blanking_forces;
  std::optional<evaluate::CuttingResult> cutting;
  std::vector<evaluate::ExperimentResult> experiments;
  std::vector<ReportTable> tables;
  std::string case_text; ///< resolved case, shown verbatim
  std::string warnings_title = "Warnings", charts_title = "Histories",
              case_title = "The case, resolved (SI units)";
};

/// The report as HTML text.
std::string render_report(const ReportData& data);

/// What the files of an output folder (status.json, history.csv, case.resolved.toml, pictures/) say; history,
/// case and pictures may be absent. Throws IoError when the status cannot be read.
ReportData collect_report(const std::filesystem::path& folder);
/// The same with a status that is not in the folder yet.
ReportData collect_report(const std::filesystem::path& folder, const results::RunStatus& status);

/// Writes `folder`/report.html from the other files of the folder. Returns its path. Throws IoError, also
/// where history.csv is missing or ends before the run did.
std::filesystem::path write_report(const std::filesystem::path& folder);
/// The same with a status that is not in the folder yet.
std::filesystem::path write_report(const std::filesystem::path& folder, const results::RunStatus& status);

} // namespace cnem::report
