#pragma once
// How keys are written down in keys.cpp and its neighbours: k.add("a.b", quantity, "…").unit(…)…
#include "input/schema/schema.hpp"

#include <initializer_list>
#include <string_view>
#include <utility>

namespace cnem::input {

/// What `content` of a file of triangles is.
inline constexpr const char* stl_content =
    "Written into resolved cases: a checksum of the file. One with another is refused, as by a restart.";

/// Whether a key is that of a path or within it.
inline bool below(std::string_view key, std::string_view path) {
  return key.starts_with(path) &&
         (key.size() == path.size() || key[path.size()] == '.' || key[path.size()] == '[');
}

/// The key just added, to be completed in a chain of calls.
class KeyDraft {
public:
  explicit KeyDraft(Key& key) : key_(key) {}

  KeyDraft& unit(const Dimension& dimension) { return key_.dimension = dimension, *this; }
  /// Dimension in axisymmetric analyses, which count whole bodies.
  KeyDraft& of_revolution(const Dimension& dimension) { return key_.revolution = dimension, *this; }
  KeyDraft& in(const Range& range) { return key_.range = range, *this; }
  KeyDraft& one_of(std::vector<std::string> choices) { return key_.choices = std::move(choices), *this; }
  /// Where three-dimensional analyses have others.
  KeyDraft& in_space_one_of(std::vector<std::string> choices) {
    return key_.choices_in_space = std::move(choices), *this;
  }
  KeyDraft& required() { return key_.presence = Presence::required, *this; }
  KeyDraft& or_in_library() {
    return key_.elsewhere = "a material of the library such as \"lib:304L\" where one is named", *this;
  }
  KeyDraft& or_from_cutting() { return key_.elsewhere = "[cutting], which makes it", *this; }
  KeyDraft& or_from_drawing() { return key_.elsewhere = "domain.drawing or [cutting], which make it", *this; }
  /// A vector with three components in all analyses.
  KeyDraft& of_space() { return key_.components = 3, *this; }
  /// Where three-dimensional analyses may do without.
  KeyDraft& in_plane_only_required() { return key_.free_in_space = true, *this; }
  /// Of a table: the defaults of its members hold without it.
  KeyDraft& always() { return key_.presence = Presence::fallback, *this; }
  KeyDraft& fallback(std::string toml) { return key_.fallback = std::move(toml), always(); }
  /// Of named tables: a single one may stand in place of all.
  KeyDraft& or_alone() { return key_.alone = true, *this; }
  KeyDraft& when(std::string sibling, std::vector<std::string> values) {
    return key_.when = {std::move(sibling), std::move(values)}, *this;
  }
  KeyDraft& example(std::string toml) { return key_.example = std::move(toml), *this; }
  KeyDraft& or_empty() { return key_.may_be_empty = true, *this; }
  KeyDraft& computed(std::string words) { return key_.computed = std::move(words), *this; }

private:
  Key& key_;
};

class Keys {
public:
  KeyDraft add(std::string path, Type type, std::string doc) {
    Key& key = all.emplace_back();
    key.path = std::move(path);
    key.type = type;
    key.doc = std::move(doc);
    return KeyDraft(key);
  }
  std::vector<Key> all;
};

/// What makes a piece of a path an arc: members of the table `piece`.
void add_arc(Keys& k, const std::string& piece);
/// A body from a file of triangles: members of the table `at`. Returns the last one, where the file's origin
/// is.
KeyDraft add_stl(Keys& k, const std::string& at, const std::string& example);
/// The closed curve of a domain, a hole or a tool: members of the table `at`.
void add_outline(Keys& k, const std::string& at, const std::string& rectangle_names);
/// The table of a law of friction.
void add_friction(Keys& k, const std::string& at, const std::string& doc);
/// What of it differs between materials.
void add_friction_by_material(Keys& k, const std::string& friction);
void add_cutting(Keys& k);
/// Members of a table with a spacing: regions where it is finer, `of` what (" of the nodes"), at the ends of
/// cracks too.
void add_refinements(Keys& k, const std::string& table, const std::string& of, bool of_cracks);
void add_domain(Keys& k);
void add_block(Keys& k);
void add_parts(Keys& k);
void add_cloud(Keys& k);
void add_materials(Keys& k);
void add_tools(Keys& k);
void add_contact(Keys& k);
void add_adaptation(Keys& k);
void add_method(Keys& k);
void add_pictures(Keys& k);
void add_report(Keys& k);
void add_machining(Keys& k);
void add_structure(Keys& k);

/// Members of the table of a tool, "tools.*.", that let it move as a body.
void add_drive(Keys& k, const std::string& tool);
void add_mass_scaling(Keys& k);

/// Says which keys have a meaning in the plane alone, or in space alone: the one table of it.
void mark_scopes(Keys& k);
/// Says which keys belong to analyses of bodies, which to milling and which to structures: the one table of
/// it.
void mark_families(Keys& k);

} // namespace cnem::input
