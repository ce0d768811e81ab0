#include "input/schema/toml_text.hpp"

#include <fmt/format.h>

namespace cnem::input {
namespace {

bool is_ascii(char c) { return static_cast<unsigned char>(c) < 0x80; }

bool begins_key(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-' ||
         c == '"' || c == '\'';
}

/// Walks through the text from token to token, only as exactly as it has to: the parser refuses the rest.
class Scanner {
public:
  explicit Scanner(std::string_view text) : text_(text) {
    if (text_.starts_with("\xef\xbb\xbf")) text_.remove_prefix(3);
  }

  std::optional<TextFault> scan() {
    for (bool line_begins = true; !fault_ && !at_end();) {
      const char c = next();
      if (!is_ascii(c)) {
        fail("found a character other than ASCII outside of quotes, expected names and texts with it in "
             "quotes");
      } else if (c == '#') {
        skip_comment();
      } else if (c == '"' || c == '\'') {
        if (!may_quote())
          fail("found a quote in the middle of a word, expected the word to end before it");
        else if (!skip_string(c))
          return fault_;
      } else {
        if (line_begins && open_.empty() && c == '[') check_header();
        follow(c);
        if (!fault_) advance();
      }
      line_begins = c == '\n' || (line_begins && (c == ' ' || c == '\t'));
    }
    return fault_;
  }

private:
  bool at_end() const { return at_ >= text_.size(); }
  char next(std::size_t ahead = 0) const { return at_ + ahead < text_.size() ? text_[at_ + ahead] : '\0'; }
  void advance() {
    const char c = text_[at_++];
    if (c == '\n') {
      ++line_;
      column_ = 1;
    } else if ((static_cast<unsigned char>(c) & 0xc0) != 0x80) { // not inside a character of UTF-8
      ++column_;
    }
  }
  void fail(const std::string& message) { fault_ = TextFault{line_, column_, message}; }

  /// Whether a key may stand next, and in which brackets and braces.
  void follow(char c) {
    const bool header = c == '[' && in_key_ && open_.empty();
    if (in_key_) count_keys(c);
    if (fault_) return;
    if (c == '{' || (c == '[' && !header)) open_.push_back(c);
    if ((c == ']' || c == '}') && !open_.empty()) {
      if (c == '}' && open_.back() == '[') return fail("found '}' in an array, expected a value or ']'");
      if (c == ']' && open_.back() == '{') return fail("found ']' in an inline table, expected '}'");
      open_.pop_back();
    }
    if (c == '\n' && open_.empty()) in_key_ = true;
    if (c == '{') in_key_ = true;
    if (c == '=' || (c == '[' && !header)) in_key_ = false;
    if (c == ',') in_key_ = !open_.empty() && open_.back() == '{';
  }

  /// The parser keeps a table for each part of a dotted key, in one another, and some hundred bytes for each
  /// key.
  void count_keys(char c) {
    constexpr int most_parts = 64, most = 1000000;
    if (c == '.' && ++dots_ == most_parts)
      fail(fmt::format("found a key of more than {} parts, expected fewer", most_parts));
    if (c == '\n' || c == ',' || c == '{' || c == '=') dots_ = 0;
    if (c == '=' && ++keys_ > most) fail(fmt::format("found more than {} keys, expected fewer", most));
  }

  /// Whether a quote here begins a text; elsewhere the parser looks beyond it for the end of a word.
  bool may_quote() const {
    const char before = at_ == 0 ? '\n' : text_[at_ - 1];
    return std::string_view(" \t\r\n=[,{").find(before) != std::string_view::npos ||
           (before == '.' && in_key_);
  }

  void skip_comment() {
    while (!at_end() && next() != '\n') advance();
  }

  void check_header() {
    std::size_t ahead = next(1) == '[' ? 2 : 1;
    while (next(ahead) == ' ' || next(ahead) == '\t') ++ahead;
    if (!begins_key(next(ahead)) && next(ahead) != ']') fail("expected the name of a table after '['");
  }

  /// False when the text does not end where it may; the parser says so.
  bool skip_string(char quote) {
    const bool block = next(1) == quote && next(2) == quote;
    for (int k = block ? 3 : 1; k > 0; --k) advance();
    while (!at_end()) {
      const char c = next();
      if (c == '\n' && !block) return false;
      if (c == '\\' && quote == '"') {
        advance();
        if (at_end()) return false;
        if (block && (next() == '\n' || next() == '\r' || next() == ' ' || next() == '\t')) {
          if (!skip_line_end()) return false;
        } else {
          advance();
        }
      } else if (c == quote && (!block || (next(1) == quote && next(2) == quote))) {
        for (int k = block ? 3 : 1; k > 0; --k) advance();
        for (int extra = 0; block && extra < 2 && next() == quote; ++extra) advance();
        return true;
      } else {
        advance();
      }
    }
    return false;
  }

  /// What follows a '\' at the end of a line, up to the next character that counts.
  bool skip_line_end() {
    while (next() == '\n' || next() == '\r' || next() == ' ' || next() == '\t') advance();
    if (at_end() || is_ascii(next())) return true;
    fail("found a character other than ASCII where a line goes on after '\\', expected an ASCII one first");
    return false;
  }

  std::string_view text_;
  std::size_t at_ = 0;
  std::uint32_t line_ = 1, column_ = 1;
  std::string open_;   ///< brackets of arrays and braces that are open
  bool in_key_ = true; ///< not in a value
  int dots_ = 0;       ///< in the key
  int keys_ = 0;       ///< so far
  std::optional<TextFault> fault_;
};

} // namespace

std::optional<TextFault> find_fault(std::string_view text) { return Scanner(text).scan(); }

} // namespace cnem::input
