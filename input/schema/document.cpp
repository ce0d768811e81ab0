#include "input/schema/document.hpp"

#include "core/error.hpp"
#include "core/index.hpp"
#include "input/schema/toml_text.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <toml++/toml.h>

namespace cnem::input {
namespace {

Location location_of(const toml::source_region& region, const std::string& source) {
  return {source, region.begin.line, region.begin.column};
}

/// Far more than a case nests, and far less than a stack of calls can hold.
constexpr std::size_t deepest = 64;

/// Far more than a table of a case names; what is done for each name may look at all others.
constexpr std::size_t most_keys = 10000;

Value convert(const toml::node& node, const std::string& source, std::size_t depth = 0) {
  Value value;
  value.where = location_of(node.source(), source);
  if (depth > deepest)
    throw InputError(
        fmt::format("{}: found tables or arrays in one another more than {} deep, expected fewer",
                    value.where.text(), deepest));
  if (const auto* boolean = node.as_boolean()) {
    value.kind = Value::Kind::boolean;
    value.boolean = boolean->get();
  } else if (const auto* integer = node.as_integer()) {
    value.kind = Value::Kind::integer;
    value.integer = integer->get();
  } else if (const auto* real = node.as_floating_point()) {
    value.kind = Value::Kind::real;
    value.real = real->get();
  } else if (const auto* text = node.as_string()) {
    value.kind = Value::Kind::text;
    value.text = text->get();
  } else if (const auto* array = node.as_array()) {
    value.kind = Value::Kind::array;
    for (const toml::node& element : *array) value.elements.push_back(convert(element, source, depth + 1));
  } else if (const auto* table = node.as_table()) {
    value.kind = Value::Kind::table;
    if (table->size() > most_keys)
      throw InputError(fmt::format("{}: found a table of {} keys, expected at most {}", value.where.text(),
                                   table->size(), most_keys));
    for (const auto& [key, member] : *table)
      value.members.push_back(
          {std::string(key.str()), location_of(key.source(), source), convert(member, source, depth + 1)});
    // toml++ sorts by name; a case keeps the order of its author.
    std::stable_sort(value.members.begin(), value.members.end(), [](const Member& a, const Member& b) {
      return std::pair(a.where.line, a.where.column) < std::pair(b.where.line, b.where.column);
    });
  }
  return value;
}

/// The text after '=' as TOML where it is TOML, else as it stands.
Value override_value(std::string_view text, const Location& where) {
  Value value;
  bool is_toml = false;
  try {
    const std::string assignment = fmt::format("value = {}", text);
    if (!find_fault(assignment)) {
      const toml::table table = toml::parse(assignment);
      is_toml = table.size() == 1;
      if (is_toml) value = convert(*table.get("value"), "");
    }
  } catch (const toml::parse_error&) { is_toml = false; }
  if (!is_toml) {
    value.kind = Value::Kind::text;
    value.text = trimmed(text);
    try {
      (void)toml::parse("value = " + toml_quoted(value.text));
    } catch (const toml::parse_error&) {
      throw InputError(fmt::format("{}: found bytes that are no UTF-8, expected a text", where.text()));
    }
  }
  relocate(value, where);
  return value;
}

struct Step {
  std::string key;     ///< of a table, or empty:
  std::size_t index{}; ///< of an array
};

/// "a.b[2].c" as steps; empty when it is malformed or leads deeper than a case nests.
std::vector<Step> split_key(std::string_view key) {
  std::vector<Step> steps;
  while (!key.empty()) {
    if (steps.size() == deepest) return {};
    if (key.front() == '[') {
      const auto close = key.find(']');
      std::size_t index = 0;
      if (steps.empty() || close == std::string_view::npos) return {};
      const auto [end, error] = std::from_chars(key.data() + 1, key.data() + close, index);
      if (error != std::errc{} || end != key.data() + close) return {};
      steps.push_back({"", index});
      key.remove_prefix(close + 1);
      if (!key.empty() && key.front() != '.' && key.front() != '[') return {};
    } else {
      if (!steps.empty()) {
        if (key.front() != '.') return {};
        key.remove_prefix(1);
      }
      const auto end = std::min(key.find_first_of(".["), key.size());
      if (end == 0) return {};
      steps.push_back({std::string(key.substr(0, end)), 0});
      key.remove_prefix(end);
    }
  }
  return steps;
}

/// The value a step leads to from `value`, made when a table lacks it. The last step is what is overridden.
Value& descend(Value& value, const Step& step, const std::string& so_far, const Location& where, bool last) {
  const auto fail = [&](const std::string& message) {
    throw InputError(fmt::format("{}: key '{}': {}", where.text(), so_far, message));
  };
  if (step.key.empty()) {
    if (value.kind == Value::Kind::table && value.members.empty() && value.where.text() == where.text())
      fail(fmt::format("not in the case, expected an array with an element [{}]", step.index));
    if (value.kind != Value::Kind::array)
      fail(fmt::format("found {}, expected an array with an element [{}]", value.show(), step.index));
    if (step.index >= value.elements.size())
      fail(fmt::format("found an array of {} without an element [{}], expected one that exists; they count "
                       "from 0",
                       value.elements.size(), step.index));
    return value.elements[step.index];
  }
  if (value.kind != Value::Kind::table)
    fail(fmt::format("found {}, expected a table with a key '{}'", value.show(), step.key));
  if (Member* member = value.find(step.key)) {
    if (last) member->where = where;
    return member->value;
  }
  Value table;
  table.kind = Value::Kind::table;
  table.where = where;
  value.members.push_back({step.key, where, std::move(table)});
  return value.members.back().value;
}

} // namespace

void relocate(Value& value, const Location& where) {
  value.where = where;
  for (Value& element : value.elements) relocate(element, where);
  for (Member& member : value.members) {
    member.where = where;
    relocate(member.value, where);
  }
}

std::string Location::text() const {
  return line == 0 ? source : fmt::format("{}:{}:{}", source, line, column);
}

const Member* Value::find(std::string_view key) const {
  const auto found =
      std::find_if(members.begin(), members.end(), [&](const Member& m) { return m.key == key; });
  return found == members.end() ? nullptr : &*found;
}

Member* Value::find(std::string_view key) {
  return const_cast<Member*>(static_cast<const Value*>(this)->find(key));
}

std::optional<std::int64_t> Value::whole_number() const {
  constexpr double exact = 9007199254740992.0; // 2^53: beyond, floats skip whole numbers
  if (kind == Kind::integer) return integer;
  if (kind != Kind::real || real != std::trunc(real) || !(std::abs(real) <= exact)) return std::nullopt;
  return static_cast<std::int64_t>(real);
}

std::string Value::show() const {
  const std::string from =
      expression.empty() ? "" : fmt::format(" (from {})", toml_quoted(shortened(expression)));
  switch (kind) {
  case Kind::boolean:
    return boolean ? "true" : "false";
  case Kind::integer:
    return std::to_string(integer) + from;
  case Kind::real:
    return fmt::format("{}", real);
  case Kind::text:
    return toml_quoted(shortened(text)) + from;
  case Kind::array:
    return fmt::format("an array of {}", elements.size());
  case Kind::table:
    return "a table";
  case Kind::other:
    break;
  }
  return "a date or time of day";
}

std::string shortened(std::string_view text) {
  constexpr std::size_t longest = 60;
  if (text.size() <= longest) return std::string(text);
  std::size_t end = longest - 3;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xc0) == 0x80)
    --end; // whole characters of UTF-8
  return std::string(text.substr(0, end)) + "...";
}

namespace {

/// The byte at a place of the text; the end of a line beyond its end.
char character_at(std::string_view text, const Location& where) {
  for (std::uint32_t line = 1; line < where.line; ++line)
    text.remove_prefix(std::min(text.find('\n'), text.size() - 1) + 1);
  text = text.substr(0, text.find('\n'));
  return where.column > 0 && where.column <= text.size() ? text[where.column - 1] : '\n';
}

/// What the parser says, and in words where its users mostly mean one thing by it.
std::string explained(std::string_view description, char found) {
  const auto says = [&](std::string_view part) { return description.find(part) != std::string_view::npos; };
  std::string hint;
  if ((says("parsing string") || says("parsing literal string")) && (found == '\n' || found == '\r'))
    hint = "the text has no closing quote on its line";
  else if (says("expected a comment or whitespace"))
    hint = "one key and its value a line; values with a unit are texts, such as \"20 us\"";
  else if (says("expected '=', saw ':'"))
    hint = "a key and its value are joined by '='";
  return hint.empty() ? std::string(description) : fmt::format("{} ({})", description, hint);
}

} // namespace

Value parse_document(std::string_view text, const std::string& source) {
  if (const auto fault = find_fault(text))
    throw InputError(
        fmt::format("{}: not TOML: {}", Location{source, fault->line, fault->column}.text(), fault->message));
  try {
    return convert(toml::parse(text, source), source);
  } catch (const toml::parse_error& error) {
    const Location where = location_of(error.source(), source);
    throw InputError(fmt::format("{}: not TOML: {}", where.text(),
                                 explained(error.description(), character_at(text, where))));
  }
}

Value read_document(const std::string& path) {
  std::error_code status;
  if (!std::filesystem::exists(path, status)) {
    std::string there; // in its folder, of another command
    for (const auto& [name, command] : {std::pair{"study.toml", "sweep"}, {"calibration.toml", "calibrate"}})
      if (std::filesystem::exists(std::filesystem::path(path).parent_path() / name, status))
        there += fmt::format(": beside it is {}, for `cnem {}`", name, command);
    throw InputError(fmt::format("{}: no such file, expected a case such as case.toml{}", path, there));
  }
  if (std::filesystem::is_directory(path, status))
    throw InputError(fmt::format("{}: is a folder, expected a case file such as {}", path,
                                 (std::filesystem::path(path) / "case.toml").string()));
  constexpr std::size_t largest = std::size_t{1}
                                  << 28; // a list of all nodes that a cloud may have fits twice
  std::ifstream stream(path, std::ios::binary);
  std::string text;
  for (std::vector<char> part(1 << 16); stream.is_open() && !stream.bad() && !stream.eof();) {
    stream.read(part.data(), static_cast<std::streamsize>(part.size()));
    text.append(part.data(), index_of(stream.gcount()));
    if (text.size() > largest)
      throw InputError(fmt::format("{}: found more than {} bytes, expected a case file", path, largest));
  }
  if (stream.bad() || !stream.is_open())
    throw IoError(fmt::format("{}: cannot be read, expected a readable case file", path));
  return parse_document(text, path);
}

namespace {

/// Where a key such as "a.b[2].c" leads to; tables that lack are made.
Value& find_or_make(Value& root, const std::vector<Step>& steps, const Location& where) {
  Value* value = &root;
  std::string so_far;
  for (const Step& step : steps) {
    value = &descend(*value, step, so_far, where, &step == &steps.back());
    so_far += step.key.empty() ? fmt::format("[{}]", step.index) : (so_far.empty() ? "" : ".") + step.key;
  }
  return *value;
}

} // namespace

Override parse_override(std::string_view assignment, const std::string& option) {
  constexpr std::size_t longest = 1000; // in a message
  Location where{
      fmt::format("{} {}", option, assignment.size() <= longest ? assignment : shortened(assignment)), 0, 0};
  const auto equals = assignment.find('=');
  std::string key(trimmed(assignment.substr(0, std::min(equals, assignment.size()))));
  if (equals == std::string_view::npos || split_key(key).empty())
    throw InputError(fmt::format("{}: expected key=value, such as time.end=\"3 us\" or "
                                 "tools.punch.path[1].fillet=\"0.5 mm\"",
                                 where.text()));
  Value value = override_value(assignment.substr(equals + 1), where);
  return {std::move(key), std::move(value), std::move(where)};
}

void apply_override(Value& root, std::string_view assignment) {
  apply_override(root, parse_override(assignment, "--set"));
}

void apply_override(Value& root, const Override& change) {
  const std::vector<Step> steps = split_key(change.key);
  if (steps.empty())
    throw InputError(fmt::format("{}: found '{}', expected a key of the case, such as \"time.end\" or "
                                 "\"tools.punch.path[1].fillet\"",
                                 change.where.text(), shortened(change.key)));
  find_or_make(root, steps, change.where) = change.value;
}

std::string toml_quoted(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\')
      result += fmt::format("\\{}", c);
    else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
      result += fmt::format("\\u{:04x}", static_cast<unsigned>(static_cast<unsigned char>(c)));
    else
      result += c;
  }
  return result + '"';
}

std::string toml_text(const Value& value) {
  std::string list;
  switch (value.kind) {
  case Value::Kind::boolean:
    return value.boolean ? "true" : "false";
  case Value::Kind::integer:
    return std::to_string(value.integer);
  case Value::Kind::real: {
    const std::string number = fmt::format("{}", value.real);
    return number.find_first_of(".en") == std::string::npos ? number + ".0" : number;
  }
  case Value::Kind::text:
    return toml_quoted(value.text);
  case Value::Kind::array:
    for (const Value& element : value.elements) list += (list.empty() ? "" : ", ") + toml_text(element);
    return "[" + list + "]";
  case Value::Kind::table:
    for (const Member& member : value.members)
      list += (list.empty() ? "" : ", ") + toml_quoted(member.key) + " = " + toml_text(member.value);
    return "{" + list + "}";
  case Value::Kind::other:
    break;
  }
  return "";
}

std::string_view trimmed(std::string_view text) {
  constexpr const char* blank = " \t\r";
  const auto first = text.find_first_not_of(blank);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blank) - first + 1);
}

} // namespace cnem::input
