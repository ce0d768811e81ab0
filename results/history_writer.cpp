#include "results/history_writer.hpp"

#include "core/error.hpp"
#include "results/output_folder.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <charconv>
#include <cmath>
#include <set>
#include <system_error>

namespace cnem::results {
namespace {

void check_names(const std::vector<std::string>& names) {
  if (names.empty() || names.front() != "time[s]")
    throw InputError("history: the first column must be \"time[s]\"");
  std::set<std::string> seen;
  for (const std::string& name : names) {
    if (name.empty() || name.find_first_of(",\"\r\n") != std::string::npos)
      throw InputError(
          fmt::format("history: the column name \"{}\" is empty or holds a comma, a quote or a line "
                      "break",
                      name));
    if (!seen.insert(name).second)
      throw InputError(fmt::format("history: the column \"{}\" occurs twice", name));
  }
}

std::string header(const std::vector<std::string>& names) {
  return fmt::format("{}\n", fmt::join(names, ","));
}

std::vector<std::string_view> split(std::string_view line) {
  std::vector<std::string_view> parts;
  for (std::size_t from = 0;;) {
    const std::size_t comma = line.find(',', from);
    parts.push_back(line.substr(from, comma - from));
    if (comma == std::string_view::npos) return parts;
    from = comma + 1;
  }
}

// Calls use(line) for each line that is complete, without its line break.
template<class Use> void for_complete_lines(std::string_view text, Use&& use) {
  for (std::size_t from = 0;;) {
    const std::size_t end = text.find('\n', from);
    if (end == std::string_view::npos) return;
    std::string_view line = text.substr(from, end - from);
    if (line.ends_with('\r')) line.remove_suffix(1);
    use(line);
    from = end + 1;
  }
}

double parse(std::string_view text, const std::filesystem::path& path, std::size_t line) {
  double value = std::nan("");
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error == std::errc::result_out_of_range || (error == std::errc() && end == text.data() + text.size()))
    return value;
  throw IoError(fmt::format("{}: line {}: \"{}\" is not a number", path.string(), line, text));
}

} // namespace

ColumnName split_column_name(std::string_view header_name) {
  const std::size_t open = header_name.rfind('[');
  if (open == std::string_view::npos || !header_name.ends_with(']')) return {std::string(header_name), ""};
  return {std::string(header_name.substr(0, open)),
          std::string(header_name.substr(open + 1, header_name.size() - open - 2))};
}

int HistoryTable::find(std::string_view name) const {
  for (std::size_t k = 0; k < names.size(); ++k)
    if (names[k] == name || split_column_name(names[k]).name == name) return static_cast<int>(k);
  return -1;
}

HistoryWriter::HistoryWriter(std::filesystem::path path, std::vector<std::string> names)
    : path_(std::move(path)), names_(std::move(names)) {
  check_names(names_);
  write_atomically(path_, header(names_));
  open();
}

HistoryWriter HistoryWriter::resume(std::filesystem::path path, std::vector<std::string> names,
                                    std::int64_t rows) {
  check_names(names);
  const HistoryTable table = read_history(path);
  if (table.names != names)
    throw InputError(fmt::format("{}: its columns are not those of this case: it has \"{}\", expected \"{}\"",
                                 path.string(), fmt::join(table.names, ","), fmt::join(names, ",")));
  const auto found = static_cast<std::int64_t>(table.rows());
  if (found < rows)
    throw IoError(fmt::format("{} has {} of the {} rows written until then", path.string(), found, rows));
  truncate_history(path, rows);
  HistoryWriter writer;
  writer.path_ = std::move(path);
  writer.names_ = std::move(names);
  writer.open();
  return writer;
}

void HistoryWriter::open() {
  errno = 0;
  file_.open(path_, std::ios::binary | std::ios::app);
  if (!file_)
    throw IoError(fmt::format("cannot write {}: {}", path_.string(), std::generic_category().message(errno)));
}

void HistoryWriter::write(std::span<const double> row) {
  if (row.size() != names_.size())
    throw InputError(fmt::format("history: a row of {} values for {} columns", row.size(), names_.size()));
  fmt::memory_buffer line;
  for (std::size_t k = 0; k < row.size(); ++k)
    fmt::format_to(std::back_inserter(line), "{}{}", k == 0 ? "" : ",", row[k]); // shortest that reads back
  line.push_back('\n');
  errno = 0;
  file_.write(line.data(), static_cast<std::streamsize>(line.size()));
  file_.flush();
  if (!file_)
    throw IoError(fmt::format("cannot write {}: {}", path_.string(), std::generic_category().message(errno)));
}

HistoryTable read_history(const std::filesystem::path& path) {
  const std::string text = read_file(path);
  HistoryTable table;
  std::size_t number = 0;
  for_complete_lines(text, [&](std::string_view line) {
    ++number;
    const std::vector<std::string_view> parts = split(line);
    if (number == 1) {
      table.names.assign(parts.begin(), parts.end());
      table.column.resize(parts.size());
      return;
    }
    if (parts.size() != table.names.size())
      throw IoError(fmt::format("{}: line {} has {} values, expected {}", path.string(), number, parts.size(),
                                table.names.size()));
    for (std::size_t k = 0; k < parts.size(); ++k) table.column[k].push_back(parse(parts[k], path, number));
  });
  if (table.names.empty()) throw IoError(fmt::format("{}: no header line", path.string()));
  return table;
}

void truncate_history(const std::filesystem::path& path, std::int64_t rows) {
  const std::string text = read_file(path);
  std::string kept;
  std::int64_t lines = 0;
  for_complete_lines(text, [&](std::string_view line) {
    if (lines++ <= rows) kept.append(line).push_back('\n'); // after the header
  });
  write_atomically(path, kept);
}

} // namespace cnem::results
