// Node lists in CSV files.
#include "io/case_parts.hpp"
#include "io/units.hpp"

#include <charconv>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>

namespace cnem::io {
namespace {

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

/// The two fields of a line.
std::array<std::string_view, 2> fields(std::string_view line, const std::string& where) {
  const auto comma = line.find(',');
  if (comma == std::string_view::npos || line.find(',', comma + 1) != std::string_view::npos)
    throw InputError(fmt::format("{}: found '{}', expected two columns separated by a comma", where, line));
  return {trimmed(line.substr(0, comma)), trimmed(line.substr(comma + 1))};
}

/// Unit of a header field such as "x[mm]" or "x [mm]".
Unit unit_of(std::string_view field, char name, const std::string& where) {
  try {
    const auto open = field.find('[');
    if (open != std::string_view::npos && field.back() == ']' &&
        trimmed(field.substr(0, open)) == std::string_view(&name, 1)) {
      const Unit unit = parse_unit(field.substr(open + 1, field.size() - open - 2));
      if (unit.dimension == dimension::length) return unit;
    }
  } catch (const UnitError& error) { throw InputError(fmt::format("{}: {}", where, error.what())); }
  throw InputError(fmt::format("{}: found the column '{}', expected {} with a unit of length such as {}[mm]",
                               where, field, name, name));
}

double number(std::string_view field, const std::string& where) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  if (error != std::errc{} || end != field.data() + field.size() || !std::isfinite(value))
    throw InputError(fmt::format("{}: found '{}', expected a finite number", where, field));
  return value;
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
  for (int n = 1; std::getline(stream, line); ++n) {
    const std::string where = fmt::format("{}:{}", path, n);
    const std::string_view text = trimmed(line);
    if (text.empty() || text.front() == '#') continue;
    const auto [x, y] = fields(text, where);
    if (header)
      unit = {unit_of(x, 'x', where), unit_of(y, 'y', where)};
    else
      points.emplace_back(unit[0].to_si(number(x, where)), unit[1].to_si(number(y, where)));
    header = false;
  }
  if (points.empty())
    throw InputError(fmt::format("{}: found no points, expected a line for each node", path));
  return points;
}

} // namespace cnem::io
