#include "study/study_parts.hpp"

#include "input/schema/nearest.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace cnem::study {

using Kind = input::Value::Kind;

TableReader::TableReader(const input::Value& table, std::string path, const std::vector<std::string>& known,
                         input::Diagnostics& diagnostics)
    : table_(table), path_(std::move(path)), diagnostics_(diagnostics) {
  for (const input::Member& member : table_.members)
    if (std::find(known.begin(), known.end(), member.key) == known.end())
      diagnostics_.add(input::Mistake::unknown_key, member.where, path_ + member.key,
                       fmt::format("unknown key, expected one of {}{}", fmt::join(known, ", "),
                                   input::did_you_mean(member.key, known)));
}

const input::Value* TableReader::find(const std::string& key, Kind kind, const std::string& expected) {
  const input::Member* member = table_.find(key);
  if (!member) return nullptr;
  if (member->value.kind == kind) return &member->value;
  wrong(key, member->value, expected);
  return nullptr;
}

const input::Value* TableReader::require(const std::string& key, Kind kind, const std::string& expected) {
  if (!table_.find(key))
    diagnostics_.add(input::Mistake::missing_key, table_.where, path_ + key, "missing, expected " + expected);
  return find(key, kind, expected);
}

std::string TableReader::text(const std::string& key) {
  const input::Value* value = find(key, Kind::text, "a text");
  return value ? value->text : "";
}

int TableReader::count(const std::string& key, int fallback) {
  const input::Member* member = table_.find(key);
  if (!member) return fallback;
  const std::optional<std::int64_t> number = member->value.whole_number();
  if (number && *number >= 1 && *number <= 4096) return static_cast<int>(*number);
  wrong(key, member->value, "a whole number from 1 to 4096");
  return fallback;
}

std::vector<std::string> TableReader::texts(const std::string& key) {
  std::vector<std::string> list;
  const input::Value* value = find(key, Kind::array, "a list of texts");
  if (!value) return list;
  for (const input::Value& element : value->elements) {
    if (element.kind == Kind::text)
      list.push_back(element.text);
    else
      wrong(key, element, "texts in the list");
  }
  return list;
}

void TableReader::wrong(const std::string& key, const input::Value& value, const std::string& expected) {
  diagnostics_.add(input::Mistake::type, value.where, path_ + key,
                   fmt::format("found {}, expected {}", value.show(), expected));
}

std::vector<input::Override> read_set(const input::Value& table, const std::string& path,
                                      input::Diagnostics& diagnostics) {
  std::vector<input::Override> list;
  for (const input::Member& member : table.members) {
    if (member.value.kind == Kind::table && member.key.find('.') == std::string::npos)
      diagnostics.add(
          input::Mistake::type, member.where, path + member.key,
          "found a table, expected a key of the case in quotes, such as \"cloud.spacing\" = \"0.1 mm\"");
    list.push_back({member.key, member.value, member.where});
  }
  return list;
}

} // namespace cnem::study
