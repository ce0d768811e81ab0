#pragma once
// The signs of gmsh's .geo files, one after the other.
#include <cstddef>
#include <string>
#include <string_view>

namespace cnem::input {

/// Words, numbers, texts in quotes and single signs, with the line each stands in.
struct GeoToken {
  enum class Kind { word, number, text, sign, end } kind = Kind::end;
  std::string text;
  double number = 0.0;
  std::size_t line = 1;

  bool is(std::string_view what) const { return (kind == Kind::word || kind == Kind::sign) && text == what; }
};

class GeoScanner {
public:
  /// Stands at the first token of a text; `file` is for messages. Every step throws DrawingError where a text
  /// or a comment does not end, and for what begins as a number and is none.
  GeoScanner(std::string_view text, const std::string& file);

protected:
  [[noreturn]] void fail(std::size_t line, const std::string& message) const;
  /// The present token for messages.
  std::string shown() const;
  void advance();
  /// Goes on behind a word or sign where it stands there.
  bool take(std::string_view what);
  /// The same; throws DrawingError where it does not.
  void expect(std::string_view what);

  GeoToken now_;

private:
  void skip_blanks();

  std::string_view rest_;
  std::string file_;
  std::size_t line_ = 1;
};

} // namespace cnem::input
