#include "input/law_file.hpp"

#include "core/error.hpp"
#include "input/constants.hpp"
#include "input/schema/nearest.hpp"
#include "machining/laws/list.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <utility>

namespace cnem::input {
namespace {

namespace fs = std::filesystem;
using Kind = Value::Kind;

std::vector<std::string> law_names() {
  std::vector<std::string> names;
  for (const LawText& law : law_texts(machining::CuttingLaws{})) names.push_back(law.name);
  return names;
}

/// What a file of a law may have beside laws: how well they are known, for whoever reads it.
const std::vector<std::string> beside_laws{"title", "law", "range", "errors", "fit", "groups"};

[[noreturn]] void fail(const Location& where, const std::string& key, const std::string& what) {
  throw InputError(fmt::format("{}: key '{}': {}", where.text(), key, what));
}

/// Files beside the one that was not found.
std::vector<std::string> neighbours(const fs::path& path) {
  std::vector<std::string> names;
  std::error_code error;
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  for (const auto& entry : fs::directory_iterator(folder, error))
    if (entry.path().extension() == ".toml") names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

Value read_file_of(const Member& law, const fs::path& folder) {
  if (law.value.kind != Kind::text || law.value.text.empty())
    fail(law.value.where, "cutting.law",
         fmt::format("found {}, expected the name of a file such as \"law.toml\"", law.value.show()));
  const fs::path path = (folder / law.value.text).lexically_normal();
  std::error_code status;
  if (!fs::is_regular_file(path, status))
    fail(law.value.where, "cutting.law",
         fmt::format(
             "there is no file {}, expected one with a cutting law, seen from the folder of the case{}",
             path.string(), did_you_mean(path.filename().string(), neighbours(path))));
  return read_document(path.string());
}

/// Throws InputError for keys at the top of the file that say nothing of a law.
void check_keys(const Value& file) {
  std::vector<std::string> known = beside_laws;
  for (std::string& name : law_names()) known.push_back(std::move(name));
  for (const Member& member : file.members)
    if (std::find(known.begin(), known.end(), member.key) == known.end())
      fail(member.where, member.key,
           fmt::format("unknown key of a cutting law, expected one of {}{}", fmt::join(known, ", "),
                       did_you_mean(member.key, known)));
}

/// The table of the law that is meant, and its name where that was written.
const Member& chosen(const Value& file, const Value* wanted) {
  std::vector<std::string> there;
  for (const std::string& name : law_names())
    if (file.find(name)) there.push_back(name);
  const Member* own = file.find("law");
  const Value* name = wanted ? wanted : own ? &own->value : nullptr;
  if (!name) fail(file.where, "law", "missing, expected the name of one of the laws in this file");
  const Member* law = nullptr;
  if (name->kind == Kind::text && std::find(there.begin(), there.end(), name->text) != there.end())
    law = file.find(name->text);
  if (!law)
    fail(name->where, wanted ? "cutting.forces.law" : "law",
         there.empty() ? fmt::format("found {}, but no law in {}, expected a table such as [linear]",
                                     name->show(), file.where.source)
                       : fmt::format("found {}, expected a law of {}: {}{}", name->show(), file.where.source,
                                     fmt::join(there, ", "), did_you_mean(name->text, there)));
  if (law->value.kind != Kind::table)
    fail(law->where, law->key, fmt::format("found {}, expected a table [{}]", law->value.show(), law->key));
  return *law;
}

/// Puts members of `from` beside those that are there, table by table.
void add_missing(Value& into, const Value& from) {
  for (const Member& member : from.members) {
    Member* known = into.find(member.key);
    if (!known)
      into.members.push_back(member);
    else if (known->value.kind == Kind::table && member.value.kind == Kind::table)
      add_missing(known->value, member.value);
  }
}

} // namespace

void take_law_from_file(Value& document, const fs::path& folder) {
  Member* cutting = document.find("cutting");
  Member* law = cutting ? cutting->value.find("law") : nullptr;
  if (!law) return;
  const Value file = read_file_of(*law, folder);
  check_keys(file);
  std::erase_if(cutting->value.members, [](const Member& member) { return member.key == "law"; });
  Member* forces = cutting->value.find("forces");
  if (forces && forces->value.kind != Kind::table) return; // the schema tells
  const Member* wanted = forces ? forces->value.find("law") : nullptr;
  const Member& meant = chosen(file, wanted ? &wanted->value : nullptr);
  Member made{"forces", meant.where, meant.value};
  made.value.where = meant.where;
  if (!wanted) {
    Member name{"law", meant.where, {}};
    name.value.kind = Kind::text;
    name.value.text = meant.key;
    name.value.where = meant.where;
    made.value.members.push_back(std::move(name));
  }
  if (const Member* range = file.find("range")) made.value.members.push_back(*range);
  if (forces)
    add_missing(forces->value, made.value);
  else
    cutting->value.members.push_back(std::move(made));
}

} // namespace cnem::input
