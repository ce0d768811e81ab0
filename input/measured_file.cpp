#include "input/measured_file.hpp"

#include "core/error.hpp"
#include "core/index.hpp"
#include "input/csv_lines.hpp"
#include "input/schema/finite_number.hpp"
#include "input/schema/nearest.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace cnem::input {
namespace {

std::string_view without_quotes(std::string_view text) {
  if (text.size() >= 2 && text.front() == '"' && text.back() == '"')
    text = trimmed(text.substr(1, text.size() - 2));
  return text;
}

/// A number as others write it: without quotes and, where `comma` stands for a decimal point too, with one.
std::string with_point(std::string_view text, bool comma) {
  std::string digits(without_quotes(text));
  if (comma && digits.find('.') == std::string::npos)
    if (const auto at = digits.find(','); at != std::string::npos) digits[at] = '.';
  return digits;
}
std::optional<double> read_number(std::string_view text, bool comma) {
  return finite_number(with_point(text, comma));
}

std::optional<Unit> read_unit(std::string_view text) {
  text = trimmed(text);
  if (text.empty() || text == "-" || text == "1") return Unit{};
  try {
    return parse_unit(text);
  } catch (const UnitError&) { return std::nullopt; }
}

/// What a field of a header says.
struct ColumnHead {
  std::string name;
  std::string unit_text; ///< in brackets; empty: none
  std::optional<Unit> unit;
  FileField field;
};

ColumnHead head_of(const FileField& field) {
  const std::string_view text = without_quotes(field.text);
  for (const auto& [open, close] : {std::pair{'[', ']'}, {'(', ')'}})
    if (const auto at = text.find(open); at != std::string_view::npos && text.ends_with(close)) {
      const std::string_view unit = text.substr(at + 1, text.size() - at - 2);
      return {std::string(trimmed(text.substr(0, at))), std::string(unit), read_unit(unit), field};
    }
  for (const std::string_view mark : {" in ", "/"})
    if (const auto at = text.find(mark); at != std::string_view::npos) {
      const std::string_view unit = text.substr(at + mark.size());
      if (const auto read = read_unit(unit); read && !trimmed(unit).empty())
        return {std::string(trimmed(text.substr(0, at))), std::string(trimmed(unit)), read, field};
    }
  return {std::string(text), "", std::nullopt, field};
}

/// The unit of a field in a line of units: "kN" or "[kN]".
std::optional<Unit> unit_alone(const FileField& field) {
  const std::string_view text = without_quotes(field.text);
  const bool brackets = text.size() >= 2 && ((text.front() == '[' && text.back() == ']') ||
                                             (text.front() == '(' && text.back() == ')'));
  if (text.empty()) return std::nullopt;
  return read_unit(brackets ? text.substr(1, text.size() - 2) : text);
}

char separator_of(std::string_view line) {
  for (const char separator : {';', '\t'})
    if (line.find(separator) != std::string_view::npos) return separator;
  return ',';
}

/// Reads one file.
class MeasuredReader {
public:
  MeasuredReader(const std::string& path, const MeasuredColumns& columns)
      : path_(path), columns_(columns),
        what_(fmt::format("columns such as {}, {}", columns.examples[0], columns.examples[1])),
        lines_(csv_lines(path, what_, "#%!")) {
    if (lines_.empty()) throw InputError(fmt::format("{}: found no lines, expected {}", path, what_));
    separator_ = separator_of(lines_.front().text);
  }

  MeasuredCurve read() {
    std::size_t next = read_heads();
    for (std::size_t c = 0; c < 2; ++c) choose_unit(c);
    MeasuredCurve curve;
    for (std::size_t c = 0; c < 2; ++c) curve.dimension[c] = unit_[c].dimension;
    for (; next < lines_.size(); ++next) {
      const std::vector<FileField> field = fields(lines_[next]);
      curve.x.push_back(number_in(field, 0, lines_[next]));
      curve.y.push_back(number_in(field, 1, lines_[next]));
    }
    if (curve.x.size() < 2)
      throw InputError(fmt::format("{}: found {} of points, expected at least two lines of numbers", path_,
                                   curve.x.empty() ? "none" : "one line"));
    return curve;
  }

private:
  bool decimal_commas() const { return separator_ != ','; }

  std::vector<FileField> fields(const FileLine& line) const {
    std::vector<FileField> list = csv_fields(line, path_, separator_);
    while (list.size() > 1 && list.back().text.empty()) list.pop_back(); // a separator at the end of a line
    return list;
  }

  /// Names and units of the columns. Returns the first line with numbers.
  std::size_t read_heads() {
    const std::vector<FileField> first = fields(lines_[0]);
    width_ = first.size();
    if (width_ < 2)
      throw InputError(found_in_file(first[0], "at least two columns between ';', tabs or commas"));
    const bool headless = read_number(first[0].text, decimal_commas()).has_value();
    for (const FileField& field : first)
      heads_.push_back(headless ? ColumnHead{"", "", std::nullopt, field} : head_of(field));
    choose_columns(headless);
    if (headless) return 0;
    if (lines_.size() < 2) return 1;
    const std::vector<FileField> second = fields(lines_[1]);
    std::array<std::optional<Unit>, 2> alone;
    for (std::size_t c = 0; c < 2; ++c) {
      if (column_[c] >= second.size() || read_number(second[column_[c]].text, decimal_commas())) return 1;
      alone[c] = unit_alone(second[column_[c]]);
      if (!alone[c]) return 1;
    }
    for (std::size_t c = 0; c < 2; ++c) heads_[column_[c]].unit = alone[c];
    return 2;
  }

  void choose_columns(bool headless) {
    const std::vector<std::string>& wanted = columns_.names;
    std::vector<std::string> there;
    for (const ColumnHead& head : heads_) there.push_back(head.name);
    const std::string list = headless ? fmt::format("{} columns without names", width_)
                                      : fmt::format("the columns '{}'", fmt::join(there, "', '"));
    if (wanted.empty() && width_ != 2)
      throw InputError(fmt::format(
          "{}: found {}, expected two, or `columns` that names the two that are meant{}",
          heads_[0].field.where.text(), list,
          separator_ == ',' ? "; numbers with decimal commas need ';' or tabs between the columns" : ""));
    for (std::size_t c = 0; c < wanted.size(); ++c) {
      const auto by_name = std::find(there.begin(), there.end(), wanted[c]);
      const std::optional<double> number = read_number(wanted[c], false);
      if (!headless && by_name != there.end())
        column_[c] = index_of(by_name - there.begin());
      else if (number && *number >= 1.0 && *number <= double(width_) && *number == std::floor(*number))
        column_[c] = static_cast<std::size_t>(*number) - 1;
      else
        throw InputError(fmt::format("{}: found {}, expected the column '{}'{}", heads_[0].field.where.text(),
                                     list, shortened(wanted[c]), did_you_mean(wanted[c], there)));
    }
  }

  void choose_unit(std::size_t c) {
    const ColumnHead& head = heads_[column_[c]];
    const std::vector<Dimension>& expected = columns_.expected[c];
    const auto allowed = [&](const Unit& unit) {
      return std::find(expected.begin(), expected.end(), unit.dimension) != expected.end();
    };
    if (const std::optional<Unit> unit = columns_.units[c] ? columns_.units[c] : head.unit;
        unit && allowed(*unit)) {
      unit_[c] = *unit;
      return;
    }
    const bool plain = std::find(expected.begin(), expected.end(), Dimension{}) != expected.end();
    if (!columns_.units[c] && head.unit_text.empty() && !head.unit && plain) return; // a number without one
    const std::string name = head.name.empty() ? fmt::format("{}", column_[c] + 1) : head.name;
    throw InputError(fmt::format(
        "{}: found the column '{}' {}, expected {}, with its unit in the header such as {}, or `units`",
        head.field.where.text(), shortened(name),
        head.unit                ? "in another unit"
        : head.unit_text.empty() ? "without a unit"
                                 : fmt::format("in the unknown unit '{}'", shortened(head.unit_text)),
        columns_.words[c], columns_.examples[c]));
  }

  double number_in(const std::vector<FileField>& field, std::size_t c, const FileLine& line) const {
    const FileField whole{trimmed(line.text), {path_, line.number, 1}};
    if (field.size() > width_ && separator_ == ',')
      throw InputError(found_in_file(
          whole, fmt::format("{} fields as in the first line: numbers with decimal commas need ';' or tabs "
                             "between the columns",
                             width_)));
    if (column_[c] >= field.size())
      throw InputError(found_in_file(
          whole, fmt::format("at least {} fields between '{}'", std::max(column_[0], column_[1]) + 1,
                             separator_ == '\t' ? "tabs" : std::string(1, separator_))));
    const std::optional<double> value =
        finite_number(with_point(field[column_[c]].text, decimal_commas()), unit_[c]);
    if (!value)
      throw InputError(found_in_file(field[column_[c]],
                                     "a finite number without signs between thousands; lines that are no "
                                     "data begin with #"));
    return *value;
  }

  const std::string& path_;
  const MeasuredColumns& columns_;
  std::string what_;
  std::vector<FileLine> lines_;
  char separator_ = ',';
  std::size_t width_ = 0;
  std::vector<ColumnHead> heads_;
  std::array<std::size_t, 2> column_{0, 1};
  std::array<Unit, 2> unit_;
};

} // namespace

MeasuredCurve read_measured(const std::string& path, const MeasuredColumns& columns) {
  return MeasuredReader(path, columns).read();
}

std::size_t keep_growing(std::vector<double>& x, std::vector<double>& y) {
  std::size_t kept = 0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    if (kept > 0 && !(x[k] > x[kept - 1])) continue;
    x[kept] = x[k];
    y[kept++] = y[k];
  }
  const std::size_t gone = x.size() - kept;
  x.resize(kept);
  y.resize(kept);
  return gone;
}

std::string keep_growing(std::vector<double>& x, std::vector<double>& y, const std::string& of,
                         const std::string& what) {
  const std::size_t all = x.size();
  const double first = x.front(), last = x.back();
  const std::size_t gone = keep_growing(x, y);
  if (x.size() < 2)
    throw InputError(
        fmt::format("{}: found a {} that goes from {:.4g} to {:.4g} (SI) and does not grow, expected one "
                    "that grows from row to row: of a machine that counts downwards write it "
                    "positive, of a file that ends with the start turn the rows round",
                    of, what, first, last));
  return gone == 0 ? ""
                   : fmt::format("{} of {} points of {} are left out: there the {} does not grow", gone, all,
                                 of, what);
}

void average_over_parts(std::vector<double>& x, std::vector<double>& y, std::size_t parts) {
  if (x.size() <= parts) return;
  const double from = x.front(), length = x.back() - x.front();
  std::vector<double> mean_x, mean_y;
  for (std::size_t k = 0; k < x.size();) {
    const auto part_of = [&](double at) {
      return std::min(parts - 1, static_cast<std::size_t>((at - from) / length * static_cast<double>(parts)));
    };
    const std::size_t part = part_of(x[k]);
    double sum_x = 0.0, sum_y = 0.0, count = 0.0;
    for (; k < x.size() && part_of(x[k]) == part; ++k, ++count) {
      sum_x += x[k];
      sum_y += y[k];
    }
    mean_x.push_back(sum_x / count);
    mean_y.push_back(sum_y / count);
  }
  x = std::move(mean_x);
  y = std::move(mean_y);
}

} // namespace cnem::input
