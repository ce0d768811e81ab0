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
      : unit_(key.dimension.dimensionless() ? "" : key.quantity().si_unit), components_(key.components) {}

  std::string operator()(std::monostate) const { return "\"\""; }
  std::string operator()(bool value) const { return value ? "true" : "false"; }
  std::string operator()(std::int64_t value) const { return std::to_string(value); }
  std::string operator()(double value) const {
    return unit_.empty() ? format_number(value) : fmt::format("\"{} {}\"", format_number(value), unit_);
  }
  std::string operator()(const std::string& value) const { return toml_quoted(value); }
  std::string operator()(const std::vector<double>& list) const { return array(list, *this); }
  template<int n> std::string operator()(const Vec<n>& v) const {
    std::string text = format_number(v[0]);
    for (int k = 1; k < n; ++k) text += fmt::format(" {}", format_number(v[k]));
    return fmt::format("\"{}{}{}\"", text, unit_.empty() ? "" : " ", unit_);
  }
  template<int n> std::string operator()(const std::vector<Vec<n>>& list) const {
    if (list.size() <= 8) return array(list, *this);
    std::string lines;
    for (const Vec<n>& point : list) lines += "  " + (*this)(point) + ",\n";
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
    const auto constant = [&](std::size_t k) { return function[k] && function[k]->times().size() == 1; };
    const auto value = [&](std::size_t k) { return function[k]->values().front(); };
    if (components_ == 2 && constant(0) && constant(1)) return (*this)(Vec2(value(0), value(1)));
    if (constant(0) && constant(1) && constant(2)) return (*this)(Vec3(value(0), value(1), value(2)));
    std::string parts;
    for (std::size_t k = 0; k < components_; ++k)
      if (function[k])
        parts += fmt::format("{}{} = {}", parts.empty() ? "" : ", ", axis_name(k), (*this)(*function[k]));
    return "{ " + parts + " }";
  }

private:
  std::string unit_;
  std::size_t components_; ///< of vectors
};

bool is_table(const Setting& setting) {
  return setting.key == nullptr || setting.key->type == Type::table ||
         setting.key->type == Type::named_tables ||
         (setting.key->type == Type::variables && setting.name == setting.key->name());
}

std::string assignment(const Setting& setting) {
  return fmt::format("{} = {}", setting.name, std::visit(ValueWriter(*setting.key), setting.value));
}

/// Lists of tables within them stand in one line.
std::string inline_table(const Setting& table) {
  std::string parts;
  for (const Setting& member : table.members) {
    std::string part;
    if (member.key->type == Type::table_list) {
      for (const Setting& element : member.members)
        part += (part.empty() ? "" : ", ") + inline_table(element);
      part = fmt::format("{} = [{}]", member.name, part);
    } else
      part = assignment(member);
    parts += (parts.empty() ? "" : ", ") + part;
  }
  return fmt::format("{{ {} }}", parts);
}

std::string list_of_tables(const Setting& list) {
  std::string lines;
  for (const Setting& element : list.members) lines += "  " + inline_table(element) + ",\n";
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
