#pragma once
// Words, numbers and units in the text of an expression.
#include <cstddef>
#include <string_view>

namespace cnem::input {

bool is_unit(std::string_view word);
/// Whether it is the name of a function of expressions.
bool is_function(std::string_view word);

/// Finds words, numbers and units in a text, from any place; `at` is a place that moves on.
class ExpressionScanner {
public:
  explicit ExpressionScanner(std::string_view text) : text_(text) {}

  std::string_view text() const { return text_; }
  bool at_end() const { return at >= text_.size(); }
  char next() const { return at_end() ? '\0' : text_[at]; }
  void skip_blanks() { at = skip(at); }

  /// The word that begins at a place; "" for none. '²' and 'µ', bytes beyond ASCII, are letters.
  std::string_view word_at(std::size_t from) const;
  /// Whether a '(' follows.
  bool is_called(std::size_t from) const;
  /// End of the number that begins at a place, without a sign; that place when there is none. The value is
  /// infinite where a double cannot hold it.
  std::size_t number_end(std::size_t from, double& value) const;
  /// End of a unit with its exponent, or of units in parentheses.
  std::size_t factor_end(std::size_t from, int depth = 0) const;
  /// End of products and quotients of units.
  std::size_t unit_end(std::size_t from, int depth = 0) const;

  std::size_t at = 0;

private:
  std::size_t skip(std::size_t from) const;

  std::string_view text_;
};

} // namespace cnem::input
