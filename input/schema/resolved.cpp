// The resolved case: every setting in SI, defaults included, as TOML that reads back to the same case.
#include "core/error.hpp"
#include "input/schema/document.hpp"
#include "input/schema/settings.hpp"

#include <fmt/format.h>

namespace cnem::input {
namespace {

template<class List, class Write> std::string array(const List& list, const Write& write) {
  std::string result;
  for (const auto& element : list) result += (result.empty() ? "" : ", ") + write(element);
  return "[" + result + "]";
}

/// One value as TOML, with the SI unit of its key.
class ValueWriter {
public:
  explicit ValueWriter(const Key& key)
      : unit_(key.dimension.dimensionless() ? "" : describe(key.dimension).si_unit) {}

  std::string operator()(std::monostate) const { return "\"\""; }
  std::string operator()(bool value) const { return value ? "true" : "false"; }
  std::string operator()(std::int64_t value) const { return std::to_string(value); }
  std::string operator()(double value) const {
    return unit_.empty() ? format_number(value) : fmt::format("\"{} {}\"", format_number(value), unit_);
  }
  std::string operator()(const std::string& value) const { return toml_quoted(value); }
  std::string operator()(const std::vector<double>& list) const { return array(list, *this); }
  std::string operator()(const Vec2& v) const {
    return fmt::format("\"{} {}{}{}\"", format_number(v.x()), format_number(v.y()), unit_.empty() ? "" : " ",
                       unit_);
  }
  std::string operator()(const std::vector<Vec2>& list) const {
    if (list.size() <= 8) return array(list, *this);
    std::string lines;
    for (const Vec2& point : list) lines += "  " + (*this)(point) + ",\n";
    return "[\n" + lines + "]";
  }
  std::string operator()(const std::vector<std::string>& list) const {
    return array(list, [](const std::string& text) { return toml_quoted(text); });
  }
  std::string operator()(const TimeTable& table) const {
    if (table.times().size() == 1) return (*this)(table.values().front());
    const auto time = [](double t) { return fmt::format("\"{} s\"", format_number(t)); };
    return fmt::format("{{ times = {}, values = {} }}", array(table.times(), time),
                       array(table.values(), *this));
  }
  std::string operator()(const VectorFunction& function) const {
    const auto& [x, y] = function;
    if (x && y && x->times().size() == 1 && y->times().size() == 1)
      return (*this)(Vec2(x->values().front(), y->values().front()));
    std::string parts;
    if (x) parts += "x = " + (*this)(*x);
    if (y) parts += (parts.empty() ? "y = " : ", y = ") + (*this)(*y);
    return "{ " + parts + " }";
  }

private:
  std::string unit_;
};

bool is_table(const Setting& setting) {
  return setting.key == nullptr || setting.key->type == Type::table ||
         setting.key->type == Type::named_tables;
}

std::string assignment(const Setting& setting) {
  return fmt::format("{} = {}", setting.name, std::visit(ValueWriter(*setting.key), setting.value));
}

std::string list_of_tables(const Setting& list) {
  std::string lines;
  for (const Setting& element : list.members) {
    std::string parts;
    for (const Setting& member : element.members) parts += (parts.empty() ? "" : ", ") + assignment(member);
    lines += fmt::format("  {{ {} }},\n", parts);
  }
  return fmt::format("{} = [\n{}]", list.name, lines);
}

void write_table(const Setting& table, std::string& text) {
  std::string own;
  for (const Setting& member : table.members) {
    if (is_table(member)) continue;
    own += (member.key->type == Type::table_list ? list_of_tables(member) : assignment(member)) + "\n";
  }
  const bool names = table.key && table.key->type == Type::named_tables;
  if (table.key && !names) text += fmt::format("\n[{}]\n", table.path);
  text += own;
  for (const Setting& member : table.members)
    if (is_table(member)) write_table(member, text);
}

template<class Escaped> std::string escape(std::string_view text, Escaped&& escaped) {
  std::string result;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    result += escaped(byte) ? fmt::format("\\x{:02x}", byte) : std::string(1, c);
  }
  return result;
}

/// A comment of any text: names of files may hold line breaks, and bytes that are no UTF-8.
std::string comment(std::string_view text) {
  const std::string line =
      "# " + escape(text, [](unsigned char byte) { return byte < 0x20 || byte == 0x7f; }) + "\n";
  try {
    parse_document(line, "");
    return line;
  } catch (const InputError&) {
    return "# " + escape(text, [](unsigned char byte) { return byte < 0x20 || byte >= 0x7f; }) + "\n";
  }
}

} // namespace

std::string write_resolved(const Setting& root, std::string_view header) {
  std::string text = comment(header);
  write_table(root, text);
  return text;
}

} // namespace cnem::input
