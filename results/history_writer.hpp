#pragma once
// history.csv: one row per time, units in the header, full precision.
//
// Names of columns, which the report goes by (units in brackets, none when dimensionless):
//   time[s], step, dt[s], nodes
//   <tool>.force_x[N/m], <tool>.force_y[N/m], <tool>.stroke[m], <tool>.work[J/m]
//   energy.<term>[J/m], energy.residual[J/m]
//   max.<field>[unit], e.g. max.plastic_strain, max.temperature[K]
//   probe.<name>.<field>[unit]
//   mass[kg/m], area[m^2]
// Axisymmetric and three-dimensional runs count the whole body: N, J, kg, enclosed_volume[m^3].
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace cnem::results {

/// Columns of a history file. Values in the units of the header.
struct HistoryTable {
  std::vector<std::string> names;          ///< with units, as in the header
  std::vector<std::vector<double>> column; ///< [column][row]

  std::size_t rows() const { return column.empty() ? 0 : column.front().size(); }
  /// Index of the column with this name, with or without its unit; −1 if there is none.
  int find(std::string_view name) const;
};

/// "force_x[N/m]" → {"force_x", "N/m"}
struct ColumnName {
  std::string name, unit;
};
ColumnName split_column_name(std::string_view header);

class HistoryWriter {
public:
  /// Starts a new file (an existing one is replaced). The first column must be "time[s]".
  /// Throws InputError for names that CSV cannot carry or that repeat, IoError when the file cannot be
  /// written.
  HistoryWriter(std::filesystem::path path, std::vector<std::string> names);

  /// Goes on with an existing file after a restart behind its first `rows` rows; later ones, and a
  /// half-written last one, are dropped. Throws InputError when the columns of the file differ from `names`,
  /// IoError when it has fewer rows.
  static HistoryWriter resume(std::filesystem::path path, std::vector<std::string> names, std::int64_t rows);

  /// Appends one row and flushes it; one value per column. Numbers round-trip exactly. Throws IoError.
  void write(std::span<const double> row);

  const std::vector<std::string>& names() const { return names_; }

private:
  HistoryWriter() = default;
  void open();

  std::filesystem::path path_;
  std::vector<std::string> names_;
  std::ofstream file_;
};

/// Reads a history file; a last line without its end (a run killed while writing) is ignored. Throws IoError.
HistoryTable read_history(const std::filesystem::path& path);

/// Drops all but the first `rows` rows, and a half-written last one. Throws IoError.
void truncate_history(const std::filesystem::path& path, std::int64_t rows);

} // namespace cnem::results
