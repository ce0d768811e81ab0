#pragma once
// Rows of a history as they come up: into a file, into memory, or both.
#include "core/fields/aligned.hpp"
#include "results/history_writer.hpp"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace cnem::results {

class HistoryLog {
public:
  /// keep: rows stay in memory although a file has them.
  explicit HistoryLog(bool keep = false) : keep_(keep) {}

  /// Begins anew with these columns, as HistoryWriter does. path: of the file; empty: there is none, and rows
  /// stay in memory. Throws InputError and IoError as HistoryWriter.
  void start(std::filesystem::path path, std::vector<std::string> names);
  /// Goes on behind the first `rows` rows of the file, or of those in memory. Throws as
  /// HistoryWriter::resume.
  void resume(std::filesystem::path path, std::vector<std::string> names, std::int64_t rows);
  bool begun() const { return !names_.empty(); }

  /// Appends one value per column. Throws IoError.
  void write(std::span<const double> row);

  const std::vector<std::string>& names() const { return names_; } ///< with units; none before it has begun
  /// [column][row] of those that stay in memory. Rows that are added leave earlier ones in their place; those
  /// that are dropped stay with whoever keeps them.
  const std::vector<Field>& columns() const { return column_; }
  /// All rows until now. Throws IoError.
  HistoryTable table() const;

private:
  bool in_memory() const { return keep_ || !writer_; }

  bool keep_;
  std::filesystem::path path_;
  std::vector<std::string> names_;
  std::optional<HistoryWriter> writer_;
  std::vector<Field> column_;
};

} // namespace cnem::results
