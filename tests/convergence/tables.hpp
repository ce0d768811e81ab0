#pragma once
// Convergence tables: rows of numbers, kept as baselines in cases/verification/convergence.
#include <string>
#include <vector>

namespace cnem::convergence {

struct Row {
  std::string method;
  std::vector<double> values;
};

struct Table {
  std::string name; ///< file name of the baseline
  std::string title;
  std::vector<std::string> columns; ///< of the values
  std::vector<Row> rows;
  std::vector<double> seconds; ///< [row] of wall time for the whole row: reported, never compared
};

std::vector<std::string> table_names();

/// Computes one table: seconds each.
Table compute(const std::string& name);

/// The rows of a baseline file. Throws IoError when it is absent.
Table read_baseline(const std::string& folder, const std::string& name);

/// Writes baselines and tables.md into the folder.
void write_baselines(const std::string& folder, const std::vector<Table>& tables);

} // namespace cnem::convergence
