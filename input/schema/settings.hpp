#pragma once
// A document checked against the schema: typed values in SI with defaults filled in, as a tree.
#include "input/case.hpp"
#include "input/schema/diagnostics.hpp"
#include "input/schema/document.hpp"
#include "input/schema/schema.hpp"

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace cnem::input {

/// Whether it is at most `longest_name` letters, digits, '_' and '-'.
bool valid_name(std::string_view name);

using SettingValue =
    std::variant<std::monostate, bool, std::int64_t, double, std::string, std::vector<double>, Vec2, Vec3,
                 std::vector<Vec2>, std::vector<Vec3>, std::vector<std::string>, TimeTable, VectorFunction>;

/// A key with its value, or a table with its members: keys in the order of the schema, names in the order
/// they were written, elements of a list in theirs.
struct Setting {
  const Key* key = nullptr; ///< nullptr at the top
  std::string name;         ///< "end", "304L", "[2]"
  std::string path;         ///< "time.end", "domain.outer.path[2].to"
  Location where;           ///< of a given key; of the nearest table that was written otherwise
  bool given = false;
  SettingValue value;
  std::vector<Setting> members;
  std::vector<Location> element_where; ///< of the elements, where the value is written as an array

  /// Where element i of the value is written; where the key is when it has no place of its own.
  const Location& where_of(std::size_t i) const {
    return i < element_where.size() ? element_where[i] : where;
  }

  /// Setting at a path relative to this one; nullptr when it has no value.
  const Setting* find(std::string_view relative) const;
  Setting* find(std::string_view relative);

  /// Value at a relative path, which has to be there.
  template<class T> const T& get(std::string_view relative) const {
    return std::get<T>(find(relative)->value);
  }
  template<class T> std::optional<T> maybe(std::string_view relative) const {
    const Setting* setting = find(relative);
    return setting ? std::optional<T>(std::get<T>(setting->value)) : std::nullopt;
  }
  /// A vector of the plane or of space; z = 0 in the plane.
  Vec3 vector(std::string_view relative) const;
  /// A list of them; none where the key is absent.
  std::vector<Vec3> vectors(std::string_view relative) const;
  /// A choice as an enumeration whose values stand in the order of the schema.
  template<class E> E choice(std::string_view relative) const {
    const Setting& setting = *find(relative);
    return static_cast<E>(choice_index(setting));
  }
  /// Members of a table of names or of a list; none when it is absent.
  const std::vector<Setting>& entries(std::string_view relative) const;

  /// Gives a key that was not written its computed default, beside the other members of its table; nothing
  /// where that table is absent.
  void set_default(std::string_view relative, SettingValue value);

  /// Takes out the setting at a relative path, if there is one.
  void erase(std::string_view relative);

private:
  static int choice_index(const Setting& setting);
};

/// Which family of analyses a document asks for.
Family family_of(const Value& document);

/// Checks keys, types, units, ranges and presence; all mistakes go to `diagnostics`, and then the tree lacks
/// what was wrong.
Setting apply_schema(const Value& document, Diagnostics& diagnostics);

/// The same for a table alone: `pattern` is its key, `path` what messages call it; kinematics are those of
/// `document`, else plane.
Setting apply_schema(const Value& table, const std::string& pattern, const std::string& path,
                     Diagnostics& diagnostics, const Value* document = nullptr);

/// The tree as TOML in SI, which reads back to the same tree.
std::string write_resolved(const Setting& root, std::string_view header);

} // namespace cnem::input
