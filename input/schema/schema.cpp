#include "input/schema/schema.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <numbers>

namespace cnem::input {

std::string range_text(const Range& range, const Dimension& dimension, std::string_view example) {
  const bool angle = dimension == dimension::angle;
  const auto bound = [&](double x) {
    return angle ? fmt::format("{:.12g}", x * 180.0 / std::numbers::pi) : fmt::format("{}", x);
  };
  const std::string low = bound(range.low), high = bound(range.high),
                    unit = angle ? "deg" : describe(dimension, example).si_unit;
  const std::string suffix = unit.empty() || unit == "1" ? "" : " " + unit;
  if (range.low == anything.low) return fmt::format("{} {}{}", range.high_open ? "<" : "≤", high, suffix);
  if (range.high == anything.high) return fmt::format("{} {}{}", range.low_open ? ">" : "≥", low, suffix);
  return fmt::format("in {}{}, {}{}{}", range.low_open ? "(" : "[", low, high, range.high_open ? ")" : "]",
                     suffix);
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
  if (type == Type::vector || type == Type::vector_function)
    return fmt::format("\"{}{}\"", components == 3 ? "0 0 " : "0 ", quantity);
  return fmt::format("\"{}\"", quantity);
}

std::string Key::expectation() const {
  const DimensionText unit = quantity();
  const std::string zeros = components == 3 ? "0 0 " : "0 ";
  const std::string such_as = " such as " + example_text();
  switch (type) {
  case Type::table:
    return fmt::format("a table [{}]", readable(path));
  case Type::named_tables:
    return fmt::format("tables [{}.NAME]", readable(path));
  case Type::table_list:
    return "an array of tables such as [{ to = \"20 0 mm\" }, { to = \"20 10 mm\" }]";
  case Type::variables:
    return fmt::format("a table [{}] of quantities and expressions", path);
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
    return fmt::format("{} components in {}{}", components == 3 ? "three" : "two", unit.si_unit, such_as);
  case Type::vectors:
    return fmt::format("an array of points{}", such_as);
  case Type::quantities:
    return fmt::format("values in {}{}", unit.si_unit, such_as);
  case Type::function:
    return fmt::format("{} such as \"{}\", or {{ value, ramp, from }}, or {{ times, values }}", unit.name,
                       unit.example);
  case Type::vector_function:
    return fmt::format("{} components such as \"{}{}\", or a table with {}, with value and ramp, or with "
                       "times and values",
                       components == 3 ? "three" : "two", zeros, unit.example,
                       components == 3 ? "x, y and z" : "x and y");
  }
  return "";
}

std::string Key::missing() const {
  return fmt::format("missing, expected {}{}{}", expectation(), elsewhere.empty() ? "" : ", or ", elsewhere);
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

namespace {

/// The keys that `change` alters, by path; it says whether it did.
template<class Change> std::map<std::string, Key, std::less<>> altered(const Change& change) {
  std::map<std::string, Key, std::less<>> map;
  for (const Key& plane : schema())
    if (Key key = plane; change(key)) map.emplace(plane.path, std::move(key));
  return map;
}

const Key& in(const std::map<std::string, Key, std::less<>>& map, const Key& key) {
  const auto found = map.find(key.path);
  return found == map.end() ? key : found->second;
}

bool make_round(Key& key) {
  if (!key.revolution) return false;
  key.dimension = *key.revolution;
  key.example.clear();
  return true;
}

bool make_spatial(Key& key) {
  const bool vector = !key.planar && (key.type == Type::vector || key.type == Type::vectors ||
                                      key.type == Type::vector_function);
  if (vector && key.scope == Scope::everywhere) key.example.clear(); // it has two components
  if (vector) key.components = 3;
  if (!key.choices_in_space.empty()) {
    key.choices = key.choices_in_space;
    if (!key.fallback.empty()) key.fallback = fmt::format("\"{}\"", key.choices.front());
  }
  if (key.free_in_space) key.presence = Presence::optional;
  // Forces and masses are those of whole bodies, as of revolution.
  return make_round(key) || vector || !key.choices_in_space.empty() || key.free_in_space;
}

} // namespace

const Key& in_revolution(const Key& key) {
  static const auto map = altered(make_round);
  return in(map, key);
}

const Key& in_space(const Key& key) {
  static const auto map = altered(make_spatial);
  return in(map, key);
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
