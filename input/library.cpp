#include "input/library.hpp"

#include "core/error.hpp"
#include "input/case_parts.hpp"
#include "input/schema/conversion.hpp"
#include "input/schema/document_walk.hpp"
#include "input/schema/nearest.hpp"
#include "input/schema/written_values.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace cnem::input {
namespace {

constexpr std::string_view library_prefix = "lib:";

const LibraryFile* find_file(std::string_view name) {
  const auto files = library_files();
  const auto found =
      std::find_if(files.begin(), files.end(), [&](const LibraryFile& file) { return file.name == name; });
  return found == files.end() ? nullptr : &*found;
}

Value table_of(const LibraryFile& file) {
  return parse_document(file.text, fmt::format("materials/{}.toml", file.name));
}

std::string expected_names() {
  std::vector<std::string> names;
  for (const LibraryFile& file : library_files())
    names.push_back(fmt::format("{}{}", library_prefix, file.name));
  return fmt::format("{}", fmt::join(names, ", "));
}

bool is_text(const Member* member) { return member && member->value.kind == Value::Kind::text; }

/// Whose constants a case has changed.
struct Changes {
  std::vector<std::string> constants; ///< "density", "plastic.A"
  std::vector<std::string> left_out;  ///< "damage"
};

/// Says beside the sources of a table that they do not speak of some of its constants.
void correct_source(Value& table, const std::vector<std::string>& names, const Location& where) {
  Value list;
  list.kind = Value::Kind::array;
  list.where = where;
  if (const Member* source = table.find("source"))
    list.elements =
        source->value.kind == Value::Kind::array ? source->value.elements : std::vector<Value>{source->value};
  list.elements.push_back(text_value(fmt::format("{}: changed by the case", fmt::join(names, ", ")), where));
  std::erase_if(table.members, [](const Member& member) { return member.key == "source"; });
  table.members.push_back({"source", where, std::move(list)});
}

/// Puts what `own` says into `table`; pattern and path are those of keys.
void override_table(Value& table, const Value& own, const std::string& pattern, const std::string& path,
                    Changes& changes) {
  std::vector<std::string> changed;
  for (const Member& member : own.members) {
    const std::string key = fmt::format("{}.{}", pattern, member.key);
    const std::string name = path.empty() ? member.key : fmt::format("{}.{}", path, member.key);
    Member* base = table.find(member.key);
    const bool tables =
        base && base->value.kind == Value::Kind::table && member.value.kind == Value::Kind::table;
    const Member* law = member.value.find("law");
    const Member* base_law = tables ? base->value.find("law") : nullptr;
    const bool other_law = is_text(law) && is_text(base_law) && law->value.text != base_law->value.text;
    if (tables && !other_law) {
      override_table(base->value, member.value, key, name, changes);
      base->value.where = member.value.where;
      continue;
    }
    const Key* spec = find_key(key);
    if (spec && spec->type == Type::quantity) changed.push_back(member.key);
    if (spec && (spec->type == Type::quantity || spec->type == Type::table))
      changes.constants.push_back(name);
    if (base)
      *base = member;
    else
      table.members.push_back(member);
  }
  if (!changed.empty() && !own.find("source")) correct_source(table, changed, own.where);
}

std::string origin_text(const std::string& name, const Changes& changes) {
  std::string text = fmt::format("{}{}", library_prefix, name);
  if (!changes.constants.empty())
    text += fmt::format("; changed by the case: {}", fmt::join(changes.constants, ", "));
  if (!changes.left_out.empty()) text += fmt::format("; left out: {}", fmt::join(changes.left_out, ", "));
  return text;
}

class Expansion {
public:
  Expansion(Value& document, Diagnostics& diagnostics) : document_(document), diagnostics_(diagnostics) {}

  void bases() {
    for (Member& material : document_.find("materials")->value.members)
      if (material.value.kind == Value::Kind::table) base(material);
  }

  /// A text that names a material, at a key of the document.
  void reference(Value& value, const std::string& path) {
    if (value.kind != Value::Kind::text || !value.text.starts_with(library_prefix)) return;
    const LibraryFile* file = wanted(value, path);
    if (!file) return;
    const std::string name(file->name);
    value.text = name;
    if (std::find(added_.begin(), added_.end(), name) != added_.end()) return;
    Value& materials = document_.find("materials")->value;
    if (const Member* own = materials.find(name)) {
      diagnostics_.add(Mistake::conflict, value.where, path,
                       fmt::format("found \"{0}{1}\" beside a material '{1}' of the case, expected \"{1}\" "
                                   "with base = \"{0}{1}\" there, or another name for that one ({2})",
                                   library_prefix, name, own->where.text()));
      return;
    }
    Value table = table_of(*file);
    table.where = value.where;
    set_origin(table, origin_text(name, {}), value.where);
    materials.members.push_back({name, value.where, std::move(table)});
    added_.push_back(name);
  }

private:
  /// The file that a text names; nullptr, and a mistake, when there is none.
  const LibraryFile* wanted(const Value& value, const std::string& path) {
    const std::string_view text = value.text;
    const bool prefixed = text.starts_with(library_prefix);
    const std::string_view name = prefixed ? text.substr(library_prefix.size()) : text;
    if (const LibraryFile* file = prefixed ? find_file(name) : nullptr) return file;
    diagnostics_.add(Mistake::reference, value.where, path,
                     fmt::format("found {}, expected a material of the library: {}{}", value.show(),
                                 expected_names(), did_you_mean_library(name)));
    return nullptr;
  }

  void base(Member& material) {
    Value& own = material.value;
    const std::string path = "materials." + material.key;
    const Member* base = own.find("base");
    const Member* leave_out = own.find("leave_out");
    if (leave_out && !base)
      diagnostics_.add(Mistake::missing_key, leave_out->where, path + ".base",
                       "missing, expected a material of the library such as \"lib:304L\", of which leave_out "
                       "leaves something out");
    if (!is_text(base)) return; // what else it is, the schema tells
    const LibraryFile* file = wanted(base->value, path + ".base");
    if (!file) return;
    Changes changes;
    Value table = table_of(*file);
    if (leave_out) changes.left_out = tables_in(*leave_out, path);
    std::erase_if(table.members, [&](const Member& member) {
      return std::find(changes.left_out.begin(), changes.left_out.end(), member.key) !=
             changes.left_out.end();
    });
    std::erase_if(own.members,
                  [](const Member& member) { return member.key == "base" || member.key == "leave_out"; });
    override_table(table, own, "materials.*", "", changes);
    table.where = own.where;
    set_origin(table, origin_text(std::string(file->name), changes), own.where);
    own = std::move(table);
  }

  std::vector<std::string> tables_in(const Member& leave_out, const std::string& path) {
    try {
      return std::get<std::vector<std::string>>(
          convert_value(leave_out.value, *find_key("materials.*.leave_out")));
    } catch (const ConversionError& error) {
      diagnostics_.add(error.kind, error.where, path + ".leave_out", error.what());
      return {};
    }
  }

  static void set_origin(Value& table, std::string text, const Location& where) {
    if (!table.find("origin")) table.members.push_back({"origin", where, text_value(std::move(text), where)});
  }

  Value& document_;
  Diagnostics& diagnostics_;
  std::vector<std::string> added_;
};

} // namespace

std::vector<std::string> library_names() {
  std::vector<std::string> names;
  for (const LibraryFile& file : library_files()) names.emplace_back(file.name);
  return names;
}

std::string did_you_mean_library(std::string_view name) {
  const auto near = nearest(name, library_names());
  return near ? fmt::format(" (did you mean '{}{}'?)", library_prefix, *near) : "";
}

LibraryMaterial library_material(std::string_view name) {
  if (name.starts_with(library_prefix)) name.remove_prefix(library_prefix.size());
  const LibraryFile* file = find_file(name);
  if (!file)
    throw InputError(fmt::format("found {}, expected a material of the library: {}{}",
                                 toml_quoted(shortened(name)), expected_names(), did_you_mean_library(name)));
  Diagnostics diagnostics;
  const std::string path = fmt::format("materials.{}", file->name);
  Setting root, all;
  all.key = find_key("materials");
  all.name = all.path = "materials";
  all.members.push_back(apply_schema(table_of(*file), "materials.*", path, diagnostics));
  all.members.front().name = file->name;
  root.members.push_back(std::move(all));
  diagnostics.throw_if_any();
  set_material_defaults(root, plasticity::Material{}.expansion_reference);
  std::vector<std::string> warnings;
  LibraryMaterial result{std::string(file->name), root.members.front().members.front(), {}};
  result.material = read_material(result.settings, warnings, diagnostics);
  diagnostics.throw_if_any();
  return result;
}

void take_from_library(Value& document, Diagnostics& diagnostics) {
  // The table is there before references are looked for: they are places in the document, which must not
  // move.
  const bool added = !document.find("materials");
  if (added) {
    Value table;
    table.kind = Value::Kind::table;
    table.where = document.where;
    document.members.push_back({"materials", document.where, std::move(table)});
  }
  Expansion expansion(document, diagnostics);
  expansion.bases();
  for (const Key& key : schema())
    if (key.type == Type::text && key.name() == "material")
      for_each_at(document, key.path, "",
                  [&](Value& value, const std::string& path) { expansion.reference(value, path); });
  if (added && document.members.back().value.members.empty()) document.members.pop_back();
}

} // namespace cnem::input
