#pragma once
// The one description of what a case file may hold. Checks, JSON Schema, the case reference and the resolved
// case all come from it.
#include "core/parameter.hpp"
#include "input/schema/units.hpp"

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace cnem::input {

enum class Type {
  table,           ///< [a]
  named_tables,    ///< [a.NAME], any number of them
  table_list,      ///< a = [{…}, {…}]
  variables,       ///< [a] with NAME = quantity or expression, of any dimension
  quantity,        ///< "11 m/s"; a plain number when dimensionless
  integer,         ///< 3
  boolean,         ///< true
  text,            ///< "…"
  choice,          ///< one of `choices`
  texts,           ///< "…" or ["…", "…"]
  choices,         ///< one or several of `choices`
  vector,          ///< "x y unit" or ["x unit", "y unit"], in space with z
  vectors,         ///< array of vectors
  quantities,      ///< "2 4 us" or ["2 us", "4 us"]
  function,        ///< quantity, { value, ramp, from } or { times, values }
  vector_function, ///< vector, the same tables with vectors, or { x = function, y = function }, in space with
                   ///< z
};

/// In which analyses a key has a meaning.
enum class Scope { everywhere, plane, space };

/// In which analyses: of bodies that deform; of milling, where cutter, cut and modes are all there is; of
/// structures, whose modes are sought; machining: of the latter two.
enum class Family { everywhere, bodies, milling, structures, machining };

/// Whether a key has to be written. For a table, `fallback` means that its own defaults hold without it.
enum class Presence { required, fallback, optional };

/// "> 0 m", "in [0, 1]", "≥ 1"; angles in degrees, as they are written: "in [-60, 60] deg".
std::string range_text(const Range& range, const Dimension& dimension, std::string_view example = "");

/// A key only makes sense when a sibling has one of these values.
struct Condition {
  std::string sibling;
  std::vector<std::string> values;
};

struct Key {
  std::string path; ///< '*' stands for a name and '[]' for an element: "tools.*.path[].to"
  Type type = Type::table;
  std::string doc;
  Presence presence = Presence::optional;
  std::string fallback = {}; ///< TOML text of the default; for computed ones `computed` says how
  Dimension dimension = {};
  std::optional<Dimension> revolution = {}; ///< dimension in axisymmetric analyses, where that is another one
  Scope scope = Scope::everywhere;
  Family family = Family::everywhere;
  std::string scope_reason = {}; ///< why it has none elsewhere
  std::size_t components = 2;    ///< of vectors; 3 in space
  bool free_in_space = false;    ///< required in the plane alone
  bool planar = false;           ///< vectors of an outline: two components in space, too
  Range range = anything;
  std::vector<std::string> choices = {};
  std::vector<std::string> choices_in_space = {}; ///< where they are others
  Condition when = {};
  std::string example = {};   ///< TOML text
  std::string computed = {};  ///< words for a default that depends on other keys
  bool may_be_empty = false;  ///< an empty list is judged by who reads it
  bool alone = false;         ///< of named tables: a single one may stand in place of all
  std::string elsewhere = {}; ///< of a required key: what may bring it instead of the file, in words

  std::string name() const; ///< last part of the path
  /// Name and unit of its dimension, as its example has them.
  DimensionText quantity() const { return describe(dimension, example); }
  std::string parent() const; ///< path of the table it belongs to; "" at the top
  /// What a value of this key looks like, for messages and documents: `a velocity such as "11 m/s"`.
  std::string expectation() const;
  /// What is said where a key that has to be there is not.
  std::string missing() const;
  /// TOML text of a value.
  std::string example_text() const;
};

/// All keys, tables before their members, in the order of documents.
const std::vector<Key>& schema();

/// The key with this pattern; nullptr when there is none.
const Key* find_key(std::string_view pattern);

/// The key as it is in axisymmetric analyses, and in three-dimensional ones.
const Key& in_revolution(const Key& key);
const Key& in_space(const Key& key);

/// A pattern for people: "tools.NAME.velocity".
std::string readable(std::string pattern);

/// Members of the table with this pattern, in order.
const std::vector<const Key*>& members_of(const std::string& pattern);

/// JSON Schema (draft 2020-12) of a case, for editors: `cnem schema`.
std::string json_schema();

/// The case reference in Markdown: docs/case_reference.md.
std::string case_reference();

} // namespace cnem::input
