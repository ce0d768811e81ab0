#include "input/csv_lines.hpp"

#include "core/error.hpp"

#include <filesystem>
#include <fmt/format.h>
#include <fstream>

namespace cnem::input {
namespace {

/// Spreadsheets begin UTF-8 with a mark. Throws InputError for that of UTF-16.
void drop_byte_order_mark(std::string& first_line, const std::string& path) {
  if (first_line.starts_with("\xff\xfe") || first_line.starts_with("\xfe\xff"))
    throw InputError(fmt::format("{}:1:1: found text in UTF-16, expected UTF-8 or ASCII", path));
  if (first_line.starts_with("\xef\xbb\xbf")) first_line.erase(0, 3);
}

} // namespace

std::vector<FileLine> csv_lines(const std::string& path, const std::string& expected,
                                std::string_view comments) {
  std::error_code status;
  if (!std::filesystem::is_regular_file(path, status))
    throw InputError(fmt::format("found no file {}, expected {}", path, expected));
  std::ifstream stream(path);
  if (!stream) throw IoError(fmt::format("{}: cannot be read, expected {}", path, expected));
  std::vector<FileLine> lines;
  std::string line;
  for (std::uint32_t n = 1; std::getline(stream, line); ++n) {
    if (n == 1) drop_byte_order_mark(line, path);
    const std::string_view text = trimmed(line);
    if (!text.empty() && comments.find(text.front()) == std::string_view::npos) lines.push_back({line, n});
  }
  return lines;
}

std::vector<FileField> csv_fields(const FileLine& line, const std::string& path, char separator) {
  std::vector<FileField> fields;
  const std::string_view whole = line.text;
  for (std::size_t begin = 0; begin <= whole.size();) {
    const std::size_t end = std::min(whole.find(separator, begin), whole.size());
    const std::string_view text = trimmed(whole.substr(begin, end - begin));
    const std::size_t column = text.empty() ? begin : static_cast<std::size_t>(text.data() - whole.data());
    fields.push_back({text, {path, line.number, static_cast<std::uint32_t>(column + 1)}});
    begin = end + 1;
  }
  return fields;
}

std::string found_in_file(const FileField& field, const std::string& expected) {
  return fmt::format("{}: found '{}', expected {}", field.where.text(), shortened(field.text), expected);
}

} // namespace cnem::input
