#include "input/schema/conversion.hpp"

#include "input/schema/nearest.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace cnem::input {
namespace {

using Kind = Value::Kind;

[[noreturn]] void wrong_type(const Value& value, const Key& key) {
  throw ConversionError(Mistake::type, value.where,
                        fmt::format("found {}, expected {}", value.show(), key.expectation()));
}

void check_range(double number, const Value& value, const Key& key) {
  if (!std::isfinite(number))
    throw ConversionError(Mistake::range, value.where,
                          fmt::format("found {}, expected a finite number", value.show()));
  if (key.range.contains(number)) return;
  throw ConversionError(Mistake::range, value.where,
                        fmt::format("found {}, expected {} {}", value.show(), key.quantity().name,
                                    range_text(key.range, key.dimension, key.example)));
}

/// Whether a text can be repeated in a message of one line.
bool is_line(std::string_view text) {
  return std::none_of(text.begin(), text.end(),
                      [](char c) { return static_cast<unsigned char>(c) < ' ' && c != '\t'; });
}

/// A value of a dimension as the key would have it, as TOML text.
std::string example_of(const Key& key, const Dimension& dimension) {
  const bool own = dimension == key.dimension && !key.example.empty() && key.example.front() == '"';
  return own ? key.example : fmt::format("\"{}\"", describe(dimension).example);
}

/// Numbers of a text or a bare number, in SI and in range.
std::vector<double> numbers(const Value& value, const Key& key, const Dimension& dimension) {
  std::vector<double> result;
  if (value.kind == Kind::text) {
    if (!is_line(value.text)) wrong_type(value, key);
    try {
      result = parse_quantities(value.text, dimension, example_of(key, dimension));
    } catch (const UnitError& error) {
      throw ConversionError(Mistake::unit, value.where,
                            value.expression.empty()
                                ? error.what()
                                : fmt::format("{} (it comes from \"{}\")", error.what(), value.expression));
    }
  } else if (value.kind == Kind::integer || value.kind == Kind::real) {
    if (!dimension.dimensionless())
      throw ConversionError(Mistake::unit, value.where,
                            fmt::format("found {} without a unit, expected {} such as {}", value.show(),
                                        describe(dimension, example_of(key, dimension)).name,
                                        example_of(key, dimension)));
    result = {value.kind == Kind::integer ? static_cast<double>(value.integer) : value.real};
  } else {
    wrong_type(value, key);
  }
  if (dimension == key.dimension)
    for (const double number : result) check_range(number, value, key);
  return result;
}

double number(const Value& value, const Key& key, const Dimension& dimension) {
  const std::vector<double> list = numbers(value, key, dimension);
  if (list.size() == 1) return list.front();
  const std::string example = example_of(key, dimension);
  throw ConversionError(Mistake::type, value.where,
                        fmt::format("found {} numbers in {}, expected one: {} such as {}", list.size(),
                                    value.show(), describe(dimension, example).name, example));
}

/// n numbers that belong together: "x y mm", or an array of n quantities.
std::vector<double> components(const Value& value, const Key& key, std::size_t n) {
  std::vector<double> list;
  if (value.kind == Kind::array && n > 1)
    for (const Value& element : value.elements) list.push_back(number(element, key, key.dimension));
  else
    list = numbers(value, key, key.dimension);
  if (list.size() == n) return list;
  const DimensionText wanted = describe(key.dimension);
  throw ConversionError(Mistake::type, value.where,
                        n == 1
                            ? fmt::format("found {} numbers in {}, expected one: {} such as \"{}\"",
                                          list.size(), value.show(), wanted.name, wanted.example)
                            : fmt::format("found {} numbers in {}, expected {} such as \"{}{}\"", list.size(),
                                          value.show(), n, n == 3 ? "0 0 " : "0 ", wanted.example));
}

template<int n> Vec<n> vector(const Value& value, const Key& key) {
  return Vec<n>(components(value, key, n).data());
}

std::vector<double> quantities(const Value& value, const Key& key, const Dimension& dimension) {
  if (value.kind != Kind::array) return numbers(value, key, dimension);
  std::vector<double> list;
  for (const Value& element : value.elements) list.push_back(number(element, key, dimension));
  return list;
}

const Value* member(const Value& table, std::string_view name) {
  const Member* found = table.find(name);
  return found ? &found->value : nullptr;
}

void check_members(const Value& table, const std::vector<std::string>& allowed) {
  for (const Member& found : table.members)
    if (std::find(allowed.begin(), allowed.end(), found.key) == allowed.end())
      throw ConversionError(Mistake::unknown_key, found.where,
                            fmt::format("unknown part '{}', expected {}{}", shortened(found.key),
                                        fmt::join(allowed, ", "), did_you_mean(found.key, allowed)));
}

std::vector<std::string> axes(std::size_t n) {
  std::vector<std::string> names{"x", "y", "z"};
  names.resize(n);
  return names;
}

/// A value over time with n components, one table each.
std::vector<TimeTable> functions(const Value& value, const Key& key, std::size_t n) {
  std::vector<TimeTable> result;
  if (value.kind != Kind::table) {
    for (const double constant : components(value, key, n)) result.emplace_back(constant);
    return result;
  }
  std::vector<std::string> parts = n == 1 ? std::vector<std::string>{} : axes(n);
  parts.insert(parts.end(), {"value", "ramp", "from", "smooth", "times", "values"});
  check_members(value, parts);
  const Value *end = member(value, "value"), *ramp = member(value, "ramp"), *from = member(value, "from");
  const Value* smooth = member(value, "smooth");
  const Value *times = member(value, "times"), *values = member(value, "values");
  const bool is_ramp = end != nullptr, is_table = times && values;
  if (is_ramp == is_table || (is_ramp && (times || values)) || (is_table && (ramp || from || smooth)))
    throw ConversionError(Mistake::type, value.where,
                          "found a table, expected either { value, ramp, from, smooth }, of which only value "
                          "has to be there, or { times, values }");
  if (is_ramp) {
    const std::vector<double> last = components(*end, key, n);
    if (!ramp && from)
      throw ConversionError(Mistake::missing_key, from->where,
                            "found 'from' without 'ramp', expected the duration such as ramp = \"1 us\"");
    if (smooth && smooth->kind != Kind::boolean)
      throw ConversionError(Mistake::type, smooth->where,
                            fmt::format("found {}, expected true or false", smooth->show()));
    if (!ramp && smooth)
      throw ConversionError(Mistake::missing_key, smooth->where,
                            "found 'smooth' without 'ramp', expected the duration such as ramp = \"1 us\"");
    const double duration = ramp ? number(*ramp, key, dimension::time) : 0.0;
    if (ramp && !(duration > 0.0))
      throw ConversionError(Mistake::range, ramp->where,
                            fmt::format("found a ramp of {}, expected a time > 0 s", ramp->show()));
    const std::vector<double> first = from ? components(*from, key, n) : std::vector<double>(n, 0.0);
    for (std::size_t k = 0; k < n; ++k)
      result.push_back(ramp ? ramp_table(duration, first[k], last[k], smooth && smooth->boolean)
                            : TimeTable(last[k]));
    return result;
  }
  const std::vector<double> time = quantities(*times, key, dimension::time);
  std::vector<std::vector<double>> columns(n);
  if (values->kind == Kind::array) {
    for (const Value& element : values->elements) {
      const std::vector<double> row = components(element, key, n);
      for (std::size_t k = 0; k < n; ++k) columns[k].push_back(row[k]);
    }
  } else if (n == 1) {
    columns[0] = quantities(*values, key, key.dimension);
  } else {
    wrong_type(*values, key);
  }
  try {
    for (std::vector<double>& column : columns) result.emplace_back(time, std::move(column));
  } catch (const InputError& error) { throw ConversionError(Mistake::range, times->where, error.what()); }
  return result;
}

VectorFunction vector_function(const Value& value, const Key& key) {
  const std::vector<std::string> names = axes(key.components);
  VectorFunction result;
  if (value.kind != Kind::table || std::none_of(names.begin(), names.end(), [&](const std::string& axis) {
        return member(value, axis) != nullptr;
      })) {
    std::vector<TimeTable> all = functions(value, key, key.components);
    std::move(all.begin(), all.end(), result.begin());
    return result;
  }
  check_members(value, names);
  for (std::size_t k = 0; k < names.size(); ++k)
    if (const Value* component = member(value, names[k])) result[k] = functions(*component, key, 1).front();
  return result;
}

std::string text(const Value& value, const Key& key) {
  if (value.kind != Kind::text) wrong_type(value, key);
  return value.text;
}

std::string choice(const Value& value, const Key& key) {
  const std::string word = text(value, key);
  if (std::find(key.choices.begin(), key.choices.end(), word) != key.choices.end()) return word;
  throw ConversionError(Mistake::reference, value.where,
                        fmt::format("found {}, expected one of \"{}\"{}", value.show(),
                                    fmt::join(key.choices, "\", \""), did_you_mean(word, key.choices)));
}

std::vector<std::string> words(const Value& value, const Key& key,
                               std::string (*word)(const Value&, const Key&)) {
  if (value.kind == Kind::text) return {word(value, key)};
  if (value.kind != Kind::array) wrong_type(value, key);
  std::vector<std::string> list;
  for (const Value& element : value.elements) {
    list.push_back(word(element, key));
    if (std::find(list.begin(), list.end() - 1, list.back()) != list.end() - 1)
      throw ConversionError(Mistake::conflict, element.where,
                            fmt::format("found {} twice, expected each once", element.show()));
  }
  // A default stands for a list that is left out, so an empty one is a wish there: no pictures, say.
  if (list.empty() && key.presence != Presence::fallback && !key.may_be_empty)
    throw ConversionError(Mistake::type, value.where,
                          fmt::format("found an empty array, expected {}", key.expectation()));
  return list;
}

template<int n> std::vector<Vec<n>> vectors(const Value& value, const Key& key) {
  if (value.kind != Kind::array) wrong_type(value, key);
  std::vector<Vec<n>> list;
  for (const Value& element : value.elements) list.push_back(vector<n>(element, key));
  return list;
}

std::int64_t integer(const Value& value, const Key& key) {
  if (value.kind == Kind::real) check_range(value.real, value, key);
  const std::optional<std::int64_t> number = value.whole_number();
  if (!number) wrong_type(value, key);
  check_range(static_cast<double>(*number), value, key);
  return *number;
}

} // namespace

TimeTable ramp_table(double duration, double first, double last, bool smooth) {
  if (!smooth) return TimeTable({0.0, duration}, {first, last});
  constexpr int pieces = 64;
  std::vector<double> time, value;
  for (int k = 0; k <= pieces; ++k) {
    const double s = static_cast<double>(k) / pieces;
    time.push_back(s * duration);
    value.push_back(first + (last - first) * (s * s * s * (10.0 + s * (6.0 * s - 15.0))));
  }
  return {std::move(time), std::move(value)};
}

SettingValue convert_value(const Value& value, const Key& key) {
  switch (key.type) {
  case Type::quantity:
    return number(value, key, key.dimension);
  case Type::integer:
    return integer(value, key);
  case Type::boolean:
    if (value.kind != Kind::boolean) wrong_type(value, key);
    return value.boolean;
  case Type::text:
    return text(value, key);
  case Type::choice:
    return choice(value, key);
  case Type::texts:
    return words(value, key, text);
  case Type::choices:
    return words(value, key, choice);
  case Type::vector:
    if (key.components == 3) return vector<3>(value, key);
    return vector<2>(value, key);
  case Type::vectors:
    if (key.components == 3) return vectors<3>(value, key);
    return vectors<2>(value, key);
  case Type::quantities:
    return quantities(value, key, key.dimension);
  case Type::function:
    return functions(value, key, 1).front();
  case Type::vector_function:
    return vector_function(value, key);
  case Type::table:
  case Type::named_tables:
  case Type::table_list:
  case Type::variables:
    break;
  }
  wrong_type(value, key);
}

} // namespace cnem::input
