// Node lists in CSV files.
#include "input/case_parts.hpp"
#include "input/schema/units.hpp"

#include <charconv>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>

namespace cnem::input {
namespace {

std::string_view without_blanks(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

/// A part of a line and where it begins.
struct FileField {
  std::string_view text;
  Location where;
};

/// The two fields of a line, of which `where` is the first column.
std::array<FileField, 2> fields(std::string_view line, const Location& where) {
  const auto comma = line.find(',');
  if (comma == std::string_view::npos || line.find(',', comma + 1) != std::string_view::npos)
    throw InputError(fmt::format("{}: found '{}', expected two columns separated by a comma", where.text(),
                                 shortened(without_blanks(line))));
  const auto field = [&](std::size_t begin, std::size_t end) {
    const std::string_view text = without_blanks(line.substr(begin, end - begin));
    Location at = where;
    at.column += static_cast<std::uint32_t>(text.empty() ? begin : std::size_t(text.data() - line.data()));
    return FileField{text, at};
  };
  return {field(0, comma), field(comma + 1, line.size())};
}

/// Unit of a header field such as "x[mm]" or "x [mm]".
Unit unit_of(const FileField& field, char name) {
  const std::string_view text = field.text;
  try {
    const auto open = text.find('[');
    if (open != std::string_view::npos && text.back() == ']' &&
        without_blanks(text.substr(0, open)) == std::string_view(&name, 1)) {
      const Unit unit = parse_unit(text.substr(open + 1, text.size() - open - 2));
      if (unit.dimension == dimension::length) return unit;
    }
  } catch (const UnitError& error) {
    throw InputError(fmt::format("{}: {}, expected a unit of length such as {}[mm]", field.where.text(),
                                 error.what(), name));
  }
  throw InputError(fmt::format("{}: found the column '{}', expected {} with a unit of length such as {}[mm]",
                               field.where.text(), shortened(text), name, name));
}

double number(const FileField& field, const Unit& unit) {
  const char *begin = field.text.data(), *end = begin + field.text.size();
  double value = 0.0;
  const auto [rest, error] = std::from_chars(begin, end, value);
  value = unit.to_si(value);
  if (error != std::errc{} || rest != end || !std::isfinite(value))
    throw InputError(
        fmt::format("{}: found '{}', expected a finite number", field.where.text(), shortened(field.text)));
  return value;
}

/// Spreadsheets begin UTF-8 with a mark. Throws InputError for that of UTF-16.
void drop_byte_order_mark(std::string& first_line, const std::string& path) {
  if (first_line.starts_with("\xff\xfe") || first_line.starts_with("\xfe\xff"))
    throw InputError(fmt::format("{}:1:1: found text in UTF-16, expected UTF-8 or ASCII", path));
  if (first_line.starts_with("\xef\xbb\xbf")) first_line.erase(0, 3);
}

} // namespace

std::vector<Vec2> read_points(const std::string& path) {
  std::error_code status;
  if (!std::filesystem::is_regular_file(path, status))
    throw InputError(fmt::format("found no file {}, expected columns x and y", path));
  std::ifstream stream(path);
  if (!stream) throw IoError(fmt::format("{}: cannot be read, expected columns x and y", path));
  std::vector<Vec2> points;
  std::array<Unit, 2> unit;
  bool header = true;
  std::string line;
  for (std::uint32_t n = 1; std::getline(stream, line); ++n) {
    if (n == 1) drop_byte_order_mark(line, path);
    const std::string_view text = without_blanks(line);
    if (text.empty() || text.front() == '#') continue;
    const auto [x, y] = fields(line, {path, n, 1});
    if (header)
      unit = {unit_of(x, 'x'), unit_of(y, 'y')};
    else
      points.emplace_back(number(x, unit[0]), number(y, unit[1]));
    header = false;
  }
  if (points.empty())
    throw InputError(fmt::format("{}: found no points, expected a line for each node", path));
  return points;
}

} // namespace cnem::input
