// Node lists in CSV files.
#include "input/case_parts.hpp"
#include "input/csv_lines.hpp"
#include "input/schema/finite_number.hpp"

#include <fmt/format.h>

namespace cnem::input {
namespace {

/// Unit of a header field such as "x[mm]" or "x [mm]".
Unit unit_of(const FileField& field, char name) {
  const std::string_view text = field.text;
  try {
    const auto open = text.find('[');
    if (open != std::string_view::npos && text.back() == ']' &&
        trimmed(text.substr(0, open)) == std::string_view(&name, 1)) {
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
  const std::optional<double> value = finite_number(field.text, unit);
  if (!value) throw InputError(found_in_file(field, "a finite number"));
  return *value;
}

} // namespace

std::vector<Vec2> read_points(const std::string& path) {
  std::vector<Vec2> points;
  std::array<Unit, 2> unit;
  bool header = true;
  for (const FileLine& line : csv_lines(path, "columns x and y")) {
    const std::vector<FileField> field = csv_fields(line, path, ',');
    if (field.size() != 2) {
      const std::string_view text = trimmed(line.text);
      throw InputError(found_in_file({text, {path, line.number, 1}}, "two columns separated by a comma"));
    }
    if (header)
      unit = {unit_of(field[0], 'x'), unit_of(field[1], 'y')};
    else
      points.emplace_back(number(field[0], unit[0]), number(field[1], unit[1]));
    header = false;
  }
  if (points.empty())
    throw InputError(fmt::format("{}: found no points, expected a line for each node", path));
  return points;
}

} // namespace cnem::input
