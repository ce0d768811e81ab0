#pragma once
// What is looked at in TOML text before its parser sees it.
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace cnem::input {

/// Something that is not TOML, and where: line and column (in characters) from 1.
struct TextFault {
  std::uint32_t line = 1, column = 1;
  std::string message;
};

/// The first place where the text is wrong in a way that the parser of toml++ 3 takes to be impossible, so
/// that its behaviour would be undefined: characters beyond ASCII outside of quotes and comments or behind a
/// line of a text that ends with '\', quotes in the middle of a word, brackets and braces that do not match,
/// and table headers without a name. Whatever else is wrong is left to the parser.
std::optional<TextFault> find_fault(std::string_view text);

} // namespace cnem::input
