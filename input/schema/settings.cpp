#include "input/schema/settings.hpp"

#include "input/schema/conversion.hpp"
#include "input/schema/nearest.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace cnem::input {
namespace {

std::string join(const std::string& table, const std::string& name) {
  return table.empty() ? name : table + "." + name;
}

/// A key as messages write it.
std::string shown(const std::string& key) { return valid_name(key) ? key : toml_quoted(shortened(key)); }

std::size_t common_prefix(std::string_view a, std::string_view b) {
  std::size_t n = 0;
  while (n < std::min(a.size(), b.size()) && a[n] == b[n]) ++n;
  return n;
}

/// What an unknown key may have meant: a sibling, else the same word in another table.
std::string suggestion(const std::string& name, const std::string& pattern, const std::string& path) {
  std::vector<std::string> siblings;
  for (const Key* key : members_of(pattern)) siblings.push_back(key->name());
  if (const auto sibling = nearest(name, siblings))
    return fmt::format(" (did you mean '{}'?)", join(path, *sibling));
  const Key* best = nullptr;
  for (const Key& key : schema())
    if (key.name() == name &&
        (!best || common_prefix(key.path, pattern) > common_prefix(best->path, pattern)))
      best = &key;
  return best ? fmt::format(" (did you mean '{}'?)", readable(best->path)) : "";
}

class Resolver {
public:
  Resolver(Diagnostics& diagnostics, std::string_view kinematics, Family family)
      : diagnostics_(diagnostics), revolution_(kinematics == "axisymmetric"),
        space_(kinematics == "three-dimensional"), family_(family) {}

  /// Fills the members of a table from what was written (nullptr: nothing).
  void table(Setting& setting, const Value* written, const std::string& pattern) {
    if (written) report_unknown(*written, pattern, setting.path);
    for (const Key* plane : members_of(pattern)) {
      const Key* key = space_ ? &in_space(*plane) : revolution_ ? &in_revolution(*plane) : plane;
      const Member* found = written ? written->find(key->name()) : nullptr;
      const std::string path = join(setting.path, key->name());
      if (!in_family(*key, found, path) || !in_scope(*key, found, path)) continue;
      if (!key->when.sibling.empty() && !applies(*key, setting, found, path)) continue;
      if (!found && key->presence != Presence::fallback) {
        if (key->presence == Presence::required)
          diagnostics_.add(Mistake::missing_key, setting.where, path,
                           key->missing() + other_choice(*key, setting));
        continue;
      }
      Setting member{key, key->name(), path, found ? found->where : setting.where, found != nullptr,
                     {},  {},          {}};
      if (fill(member, found ? &found->value : nullptr)) setting.members.push_back(std::move(member));
    }
  }

private:
  void report_unknown(const Value& written, const std::string& pattern, const std::string& path) {
    std::vector<std::string> known;
    for (const Key* key : members_of(pattern))
      if (belongs(*key)) known.push_back(key->name());
    for (const Member& member : written.members) {
      if (find_key(join(pattern, member.key))) continue;
      if (diagnostics_.tells(Mistake::unknown_key))
        diagnostics_.add(Mistake::unknown_key, member.where, join(path, shown(member.key)),
                         fmt::format("unknown key, expected one of {}{}", fmt::join(known, ", "),
                                     suggestion(member.key, pattern, path)));
      else
        diagnostics_.count(Mistake::unknown_key);
    }
  }

  bool belongs(const Key& key) const {
    return key.family == Family::everywhere || key.family == family_ ||
           (key.family == Family::machining && family_ != Family::bodies);
  }

  /// Whether the key belongs to analyses of this kind; if not, it must not have been written.
  bool in_family(const Key& key, const Member* found, const std::string& path) {
    if (belongs(key)) return true;
    if (found)
      diagnostics_.add(
          Mistake::conflict, found->where, path,
          family_ == Family::milling && key.family == Family::structures
              ? "found in a milling analysis, expected it in an analysis of a structure alone: "
                "analysis.type = \"modes\" for [shaft], whose modes go into [modes], \"removal\" for "
                "[removal]"
          : family_ == Family::milling
              ? "found in a milling analysis, expected none: it has no body that deforms"
          : family_ == Family::structures    ? "found in an analysis of structures, expected none: it has "
                                               "[part], [shaft] and [removal] alone"
          : key.family == Family::structures ? "found in an analysis of bodies, expected it with "
                                               "analysis.type = \"modes\" or \"removal\" only"
          : key.family == Family::machining
              ? "found in an analysis of bodies, expected it with analysis.type = \"modes\", \"removal\", "
                "\"stability\" or \"milling\" only"
              : "found in an analysis of bodies, expected it with analysis.type = \"stability\" "
                "or \"milling\" only");
    return false;
  }

  /// Whether the key has a meaning in this analysis; if not, it must not have been written.
  bool in_scope(const Key& key, const Member* found, const std::string& path) {
    if (key.scope == Scope::everywhere || (key.scope == Scope::space) == space_) return true;
    if (found)
      diagnostics_.add(Mistake::conflict, found->where, path,
                       fmt::format("found in a {} analysis, expected none: {}",
                                   space_ ? "three-dimensional" : "plane", key.scope_reason));
    return false;
  }

  /// Whether the key goes with its sibling's value; if not, it must not have been written.
  bool applies(const Key& key, const Setting& table, const Member* found, const std::string& path) {
    const Setting* sibling = table.find(key.when.sibling);
    if (!sibling) return false;
    const std::string& value = std::get<std::string>(sibling->value);
    const std::vector<std::string>& values = key.when.values;
    if (std::find(values.begin(), values.end(), value) != values.end()) return true;
    if (found)
      diagnostics_.add(Mistake::conflict, found->where, path,
                       fmt::format("goes with {0} = \"{1}\", expected none with {0} = \"{2}\"",
                                   key.when.sibling, fmt::join(values, "\" or \""), value));
    return false;
  }

  /// What else may be meant where a key is missing that goes with the default of its sibling.
  static std::string other_choice(const Key& key, const Setting& table) {
    const Setting* sibling = key.when.sibling.empty() ? nullptr : table.find(key.when.sibling);
    if (!sibling || sibling->given) return "";
    return fmt::format(", or another {} than \"{}\", the default", sibling->name,
                       std::get<std::string>(sibling->value));
  }

  /// False when the value is wrong; that has been reported.
  bool fill(Setting& setting, const Value* written) {
    const Key& key = *setting.key;
    try {
      switch (key.type) {
      case Type::table:
        if (written && written->kind != Value::Kind::table) (void)convert_value(*written, key);
        table(setting, written, key.path);
        break;
      case Type::named_tables:
        if (!written) break; // no entries
        if (written->kind != Value::Kind::table) (void)convert_value(*written, key);
        named(setting, *written);
        break;
      case Type::table_list:
        if (!written) break;
        if (written->kind != Value::Kind::array) (void)convert_value(*written, key);
        list(setting, *written);
        break;
      case Type::variables:
        if (!written) break;
        for (const Member& member : written->members) {
          const bool bare = member.value.kind == Value::Kind::real;
          setting.members.push_back(
              {&key, member.key, join(setting.path, member.key), member.where, true, {}, {}, {}});
          setting.members.back().value = bare ? SettingValue(member.value.real) : member.value.text;
        }
        break;
      default:
        setting.value = written ? convert_value(*written, key) : fallback(key);
        if (written)
          for (const Value& element : written->elements) setting.element_where.push_back(element.where);
      }
    } catch (const ConversionError& error) {
      diagnostics_.add(error.kind, error.where, setting.path, error.what());
      return false;
    }
    return true;
  }

  static SettingValue fallback(const Key& key) {
    const Value document = parse_document("value = " + key.fallback, "default of " + key.path);
    return convert_value(document.find("value")->value, key);
  }

  void named(Setting& setting, const Value& written) {
    const std::string pattern = setting.key->path + ".*";
    for (const Member& member : written.members) {
      const std::string path = join(setting.path, shown(member.key));
      if (!valid_name(member.key))
        diagnostics_.add(Mistake::type, member.where, path,
                         fmt::format("found the name {}, expected at most {} letters, digits, '_' and '-'",
                                     toml_quoted(shortened(member.key)), longest_name));
      else
        entry(setting, member.key, path, member.where, member.value, pattern);
    }
    if (setting.key->presence == Presence::required && written.members.empty())
      diagnostics_.add(Mistake::missing_key, setting.where, setting.path,
                       "is empty, expected " + setting.key->expectation());
  }

  void list(Setting& setting, const Value& written) {
    const std::string pattern = setting.key->path + "[]";
    for (std::size_t i = 0; i < written.elements.size(); ++i) {
      const std::string name = fmt::format("[{}]", i);
      entry(setting, name, setting.path + name, written.elements[i].where, written.elements[i], pattern);
    }
  }

  void entry(Setting& parent, const std::string& name, const std::string& path, const Location& where,
             const Value& value, const std::string& pattern) {
    if (value.kind != Value::Kind::table) {
      diagnostics_.add(Mistake::type, value.where, path,
                       fmt::format("found {}, expected a table", value.show()));
      return;
    }
    Setting member{find_key(pattern), name, path, where, true, {}, {}, {}};
    table(member, &value, pattern);
    parent.members.push_back(std::move(member));
  }

  Diagnostics& diagnostics_;
  bool revolution_, space_;
  Family family_;
};

/// What the document says of its analysis, of which other keys depend; "" where it says nothing.
std::string_view analysis_of(const Value& document, std::string_view key) {
  const Member* analysis = document.find("analysis");
  const Member* found = analysis ? analysis->value.find(key) : nullptr;
  const bool said = found && found->value.kind == Value::Kind::text;
  return said ? std::string_view(found->value.text) : "";
}

std::string_view kinematics_of(const Value& document) { return analysis_of(document, "kinematics"); }

} // namespace

Family family_of(const Value& document) {
  const std::string_view type = analysis_of(document, "type");
  if (type == "modes" || type == "removal") return Family::structures;
  if (type == "stability" || type == "milling") return Family::milling;
  const std::vector<std::string>& known = find_key("analysis.type")->choices;
  if (type.empty() || std::find(known.begin(), known.end(), type) != known.end()) return Family::bodies;
  // Misspelt: what else the case has is no mistake.
  if (document.find("milling") || document.find("cutter")) return Family::milling;
  return document.find("part") || document.find("shaft") ? Family::structures : Family::bodies;
}

bool valid_name(std::string_view name) {
  return !name.empty() && name.size() <= longest_name && std::all_of(name.begin(), name.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
  });
}

const Setting* Setting::find(std::string_view relative) const {
  const Setting* setting = this;
  while (setting && !relative.empty()) {
    const auto dot = relative.find('.');
    const std::string_view step = relative.substr(0, dot);
    const auto found = std::find_if(setting->members.begin(), setting->members.end(),
                                    [&](const Setting& member) { return member.name == step; });
    setting = found == setting->members.end() ? nullptr : &*found;
    relative = dot == std::string_view::npos ? std::string_view{} : relative.substr(dot + 1);
  }
  return setting;
}

Setting* Setting::find(std::string_view relative) {
  return const_cast<Setting*>(static_cast<const Setting*>(this)->find(relative));
}

Vec3 Setting::vector(std::string_view relative) const {
  const SettingValue& held = find(relative)->value;
  if (const Vec2* plane = std::get_if<Vec2>(&held)) return {plane->x(), plane->y(), 0.0};
  return std::get<Vec3>(held);
}

std::vector<Vec3> Setting::vectors(std::string_view relative) const {
  const Setting* setting = find(relative);
  if (!setting) return {};
  if (const auto* space = std::get_if<std::vector<Vec3>>(&setting->value)) return *space;
  std::vector<Vec3> list;
  for (const Vec2& x : std::get<std::vector<Vec2>>(setting->value)) list.emplace_back(x.x(), x.y(), 0.0);
  return list;
}

const std::vector<Setting>& Setting::entries(std::string_view relative) const {
  static const std::vector<Setting> none;
  const Setting* setting = find(relative);
  return setting ? setting->members : none;
}

int Setting::choice_index(const Setting& setting) {
  const std::vector<std::string>& choices = setting.key->choices;
  const auto found = std::find(choices.begin(), choices.end(), std::get<std::string>(setting.value));
  return static_cast<int>(found - choices.begin());
}

void Setting::set_default(std::string_view relative, SettingValue computed) {
  if (find(relative)) return;
  const auto dot = relative.rfind('.');
  Setting* table = dot == std::string_view::npos ? this : find(relative.substr(0, dot));
  if (!table) return;
  const std::string member(dot == std::string_view::npos ? relative : relative.substr(dot + 1));
  const std::string pattern = table->key ? join(table->key->path, member) : member;
  const Key* spec = find_key(pattern);
  // The schema is one array, so its order is that of addresses in it.
  const auto place = std::find_if(table->members.begin(), table->members.end(),
                                  [&](const Setting& other) { return find_key(other.key->path) > spec; });
  const auto* function = std::get_if<VectorFunction>(&computed);
  const bool spatial = std::holds_alternative<Vec3>(computed) || (function && (*function)[2]);
  table->members.insert(place, {spatial ? &in_space(*spec) : spec,
                                member,
                                join(table->path, member),
                                table->where,
                                false,
                                std::move(computed),
                                {},
                                {}});
}

void Setting::erase(std::string_view relative) {
  const auto dot = relative.rfind('.');
  Setting* table = dot == std::string_view::npos ? this : find(relative.substr(0, dot));
  const std::string_view member = dot == std::string_view::npos ? relative : relative.substr(dot + 1);
  if (table) std::erase_if(table->members, [&](const Setting& setting) { return setting.name == member; });
}

Setting apply_schema(const Value& document, Diagnostics& diagnostics) {
  Setting root;
  root.where = document.where;
  Resolver(diagnostics, kinematics_of(document), family_of(document)).table(root, &document, "");
  return root;
}

Setting apply_schema(const Value& table, const std::string& pattern, const std::string& path,
                     Diagnostics& diagnostics, const Value* document) {
  Setting setting;
  setting.key = find_key(pattern);
  setting.path = path;
  setting.where = table.where;
  setting.given = true;
  Resolver(diagnostics, document ? kinematics_of(*document) : "",
           document ? family_of(*document) : Family::bodies)
      .table(setting, &table, pattern);
  return setting;
}

} // namespace cnem::input
