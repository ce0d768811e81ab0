#include "results/history_log.hpp"

#include "core/index.hpp"

#include <utility>

namespace cnem::results {

void HistoryLog::start(std::filesystem::path path, std::vector<std::string> names) {
  writer_.reset();
  path_ = std::move(path);
  if (!path_.empty()) writer_.emplace(path_, names);
  names_ = std::move(names);
  column_.assign(in_memory() ? names_.size() : 0, Field());
}

void HistoryLog::resume(std::filesystem::path path, std::vector<std::string> names, std::int64_t rows) {
  path_ = std::move(path);
  names_ = std::move(names);
  if (path_.empty()) {
    column_.resize(names_.size());
    for (Field& column : column_) {
      column.resize(index_of(rows));
      column = Field(column); // a new block: whoever looks at the old one keeps the rows that were there
    }
    return;
  }
  writer_.reset();
  writer_ = HistoryWriter::resume(path_, names_, rows);
  if (!keep_) return;
  column_.clear();
  for (const std::vector<double>& column : read_history(path_).column)
    column_.emplace_back(column.begin(), column.end());
}

void HistoryLog::write(std::span<const double> row) {
  if (writer_) writer_->write(row);
  for (std::size_t k = 0; k < column_.size(); ++k) column_[k].push_back(row[k]);
}

HistoryTable HistoryLog::table() const {
  if (!in_memory()) return read_history(path_);
  HistoryTable table;
  table.names = names_;
  for (const Field& column : column_) table.column.emplace_back(column.begin(), column.end());
  return table;
}

} // namespace cnem::results
