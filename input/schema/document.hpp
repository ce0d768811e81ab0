#pragma once
// A TOML file as a tree of values that know where they were written, with --set overrides applied.
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace cnem::input {

/// Where a value was written: "case.toml:12:7", or "--set time.end=3 us" for an override.
struct Location {
  std::string source;
  std::uint32_t line = 0; ///< from 1; 0 when the source has no lines
  std::uint32_t column = 0;

  std::string text() const;
};

/// Names become names of files and columns.
constexpr std::size_t longest_name = 100;

struct Member;

/// A TOML value. Only the member that belongs to `kind` is meaningful.
struct Value {
  enum class Kind { boolean, integer, real, text, array, table, other };
  Kind kind = Kind::other;
  bool boolean = false;
  std::int64_t integer = 0;
  double real = 0.0;
  std::string text;
  std::vector<Value> elements; ///< of an array
  std::vector<Member> members; ///< of a table, in the order they were written
  std::string expression;      ///< what the value was calculated from, or empty (input/variables.hpp)
  Location where;

  const Member* find(std::string_view key) const;
  Member* find(std::string_view key);
  /// Of an integer, and of a float that is one: 1e5.
  std::optional<std::int64_t> whole_number() const;
  /// The value as a user would recognise it in a message: `"11 mm"`, `12`, `a table`, with its expression.
  std::string show() const;
};

struct Member {
  std::string key;
  Location where; ///< of the key
  Value value;
};

/// The text, or its beginning and "..." when it is too long for a message.
std::string shortened(std::string_view text);

/// Parses TOML text. Throws InputError "source:line:column: …" for syntax errors, duplicate keys
/// and values nested without end.
Value parse_document(std::string_view text, const std::string& source);

/// Reads a file. Throws InputError when it is absent, a folder or not TOML; IoError when it cannot be read.
Value read_document(const std::string& path);

/// A value that a key is given, read from another file or from the command line.
struct Override {
  std::string key;
  Value value;
  Location where; ///< of the key
};

/// "key=value", as after `option` ("--set") on the command line; the value is TOML, or else bare text. Throws
/// InputError naming the whole override when it has no '=' or its key is none.
Override parse_override(std::string_view assignment, const std::string& option);

/// Applies "key=value": the key addresses tables and array elements ("tools.punch.path[1].fillet"), missing
/// tables are made; the value is TOML, or else bare text. Throws InputError naming the whole override when
/// it has no '=' or its key addresses something that cannot be there.
void apply_override(Value& root, std::string_view assignment);
/// The same for a value that was written elsewhere, in the file of a study say.
void apply_override(Value& root, const Override& change);

/// Says of a value and all in it that it was written at another place.
void relocate(Value& value, const Location& where);

/// The text as a TOML string, in quotes.
std::string toml_quoted(std::string_view text);

/// The value as TOML on one line, as it may follow "key = ". Dates have no such text: "".
std::string toml_text(const Value& value);

/// Without blanks at both ends.
std::string_view trimmed(std::string_view text);

} // namespace cnem::input
