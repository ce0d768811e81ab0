#include "input/schema/schema.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace cnem::input {

std::string range_text(const Range& range, std::string_view unit) {
  const auto [low, high, low_open, high_open] = range;
  const std::string suffix = unit.empty() || unit == "1" ? "" : fmt::format(" {}", unit);
  if (low == anything.low) return fmt::format("{} {}{}", high_open ? "<" : "≤", high, suffix);
  if (high == anything.high) return fmt::format("{} {}{}", low_open ? ">" : "≥", low, suffix);
  return fmt::format("in {}{}, {}{}{}", low_open ? "(" : "[", low, high, high_open ? ")" : "]", suffix);
}

std::string Key::name() const { return path.substr(path.rfind('.') + 1); }

std::string Key::parent() const {
  const auto dot = path.rfind('.');
  return dot == std::string::npos ? "" : path.substr(0, dot);
}

std::string Key::example_text() const {
  if (!example.empty()) return example;
  if (!fallback.empty()) return fallback;
  if (type == Type::choice) return fmt::format("\"{}\"", choices.front());
  if (type == Type::choices) return fmt::format("[\"{}\"]", choices.front());
  if (type == Type::text || type == Type::texts) return "\"name\"";
  std::string quantity = describe(dimension).example;
  if (dimension.dimensionless()) return quantity;
  if (type == Type::vector || type == Type::vector_function) return fmt::format("\"0 {}\"", quantity);
  return fmt::format("\"{}\"", quantity);
}

std::string Key::expectation() const {
  const DimensionText unit = describe(dimension);
  const std::string such_as = " such as " + example_text();
  switch (type) {
  case Type::table:
    return fmt::format("a table [{}]", readable(path));
  case Type::named_tables:
    return fmt::format("tables [{}.NAME]", readable(path));
  case Type::table_list:
    return "an array of tables such as [{ to = \"20 0 mm\" }, { to = \"20 10 mm\" }]";
  case Type::quantity:
    return unit.name + such_as;
  case Type::integer:
    return "a whole number" + such_as;
  case Type::boolean:
    return "true or false";
  case Type::text:
    return fallback == "\"\"" ? "a text" : "a text" + such_as;
  case Type::choice:
    return fmt::format("one of \"{}\"", fmt::join(choices, "\", \""));
  case Type::texts:
    return "a text or an array of them" + such_as;
  case Type::choices:
    return fmt::format("an array of \"{}\"", fmt::join(choices, "\", \""));
  case Type::vector:
    return fmt::format("two components in {}{}", unit.si_unit, such_as);
  case Type::vectors:
    return fmt::format("an array of points{}", such_as);
  case Type::quantities:
    return fmt::format("values in {}{}", unit.si_unit, such_as);
  case Type::function:
    return fmt::format("{} such as \"{}\", or {{ value, ramp, from }}, or {{ times, values }}", unit.name,
                       unit.example);
  case Type::vector_function:
    return fmt::format(
        "two components such as \"0 {}\", or a table with x and y, with value and ramp, or with "
        "times and values",
        unit.example);
  }
  return "";
}

const Key* find_key(std::string_view pattern) {
  static const std::map<std::string, const Key*, std::less<>> index = [] {
    std::map<std::string, const Key*, std::less<>> map;
    for (const Key& key : schema()) map.emplace(key.path, &key);
    return map;
  }();
  const auto found = index.find(pattern);
  return found == index.end() ? nullptr : found->second;
}

const Key& in_revolution(const Key& key) {
  static const std::map<std::string, Key, std::less<>> index = [] {
    std::map<std::string, Key, std::less<>> map;
    for (const Key& plane : schema()) {
      if (!plane.revolution) continue;
      Key& round = map.emplace(plane.path, plane).first->second;
      round.dimension = *plane.revolution;
      round.example.clear();
    }
    return map;
  }();
  const auto found = index.find(key.path);
  return found == index.end() ? key : found->second;
}

std::string readable(std::string pattern) {
  for (auto star = pattern.find('*'); star != std::string::npos; star = pattern.find('*'))
    pattern.replace(star, 1, "NAME");
  return pattern;
}

const std::vector<const Key*>& members_of(const std::string& pattern) {
  static const std::map<std::string, std::vector<const Key*>> index = [] {
    std::map<std::string, std::vector<const Key*>> map;
    for (const Key& key : schema())
      if (key.name() != "*") map[key.parent()].push_back(&key);
    return map;
  }();
  static const std::vector<const Key*> none;
  const auto found = index.find(pattern);
  return found == index.end() ? none : found->second;
}

} // namespace cnem::input
