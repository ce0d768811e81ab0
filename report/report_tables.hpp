#pragma once
// Tables at the end of a page: results, energies, the run, and what the resolved case says.
#include "results/history_writer.hpp"
#include "results/shown_units.hpp"
#include "results/status.hpp"

#include <string>
#include <utility>
#include <vector>

namespace cnem::report {

struct ReportTable {
  std::string title;
  std::vector<std::pair<std::string, std::string>> rows; ///< name, value with unit
};

/// "2 653": groups of three digits, a narrow space between them.
std::string grouped(std::int64_t count);

/// Named results; those of sections of their own (cutting, blanking, springback, experiment) are left out.
ReportTable result_table(const results::RunStatus& status, const results::ShownUnits& units);
/// Every term of the energy balance at the end, with its largest size where that is larger. No rows without
/// energies.
ReportTable energy_table(const results::HistoryTable& history, const results::ShownUnits& units);
/// Version, threads, steps, memory; wall time by phase; what limited the step.
std::vector<ReportTable> run_tables(const results::RunStatus& status);

/// What a page says of a case: from its resolved text.
struct CaseWords {
  std::string title;      ///< "" when it has none
  std::string kinematics; ///< what forces and lengths are of, where they are not per thickness; else ""
  bool moves = true;      ///< false: heat alone
  std::vector<ReportTable> tables; ///< variables, materials of the library, constants of damage
};
CaseWords case_words(const std::string& resolved);

} // namespace cnem::report
