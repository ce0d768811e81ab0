#pragma once
// Parts of the tables and pages that show several runs together.
#include "report/chart.hpp"
#include "results/history_writer.hpp"
#include "study/batch.hpp"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace cnem::study {

/// A number of each run.
struct NumberColumn {
  std::string name;
  std::vector<std::optional<double>> value; ///< [run]
};

/// A CSV file with a row for each run: name, values of the keys of the study, state, exit code, the columns.
/// Numbers round-trip; texts that a spreadsheet would take for formulas begin with an apostrophe.
std::string csv_table(const Study& study, const std::vector<RunRecord>& runs,
                      const std::vector<NumberColumn>& columns);

/// A text as a field of a CSV file; one that a spreadsheet would take for a formula begins with an
/// apostrophe.
std::string csv_field(const std::string& text);

/// "metrics.K_I" without its first part.
std::string column_name(const std::string& path);

/// The text as a cell of a table.
std::string cell(const std::string& text, const char* tag = "td");

/// One curve for each history that has the column, over time or another column.
report::Chart history_chart(std::span<const results::HistoryTable> histories,
                            std::span<const std::string> labels, const std::string& column,
                            const std::string& x = "time");

/// Charts with their titles and notes, beside each other under a heading; nothing for none.
std::string chart_section(const std::vector<report::Chart>& charts, const results::ShownUnits& units,
                          const std::string& id = "charts", const std::string& title = "The runs together");

/// The units that the runs want their numbers shown in: of the first that has a resolved case in `folder`.
results::ShownUnits shown_units(const Study& study, const std::filesystem::path& folder);

/// What a page begins with.
struct PageHead {
  std::string title, version, verdict;
  bool good = false;
  std::string style{}; ///< CSS beyond that of reports and tables of runs
};
/// The page as HTML that needs nothing from elsewhere.
std::string page(const PageHead& head, const std::string& body);

} // namespace cnem::study
