#include "input/schema/expression_scanner.hpp"

#include "core/index.hpp"
#include "input/schema/expression.hpp"

#include <algorithm>
#include <charconv>
#include <fmt/format.h>
#include <limits>

namespace cnem::input {
namespace {

constexpr std::string_view function_names[] = {"abs", "sqrt", "sin", "cos", "tan", "min", "max"};

bool is_digit(char c) { return c >= '0' && c <= '9'; }

bool begins_word(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || c == '%' ||
         static_cast<unsigned char>(c) >= 0x80;
}

} // namespace

bool is_unit(std::string_view word) {
  try {
    (void)parse_unit(word);
    return true;
  } catch (const UnitError&) { return false; }
}

bool is_function(std::string_view word) {
  return std::find(std::begin(function_names), std::end(function_names), word) != std::end(function_names);
}

std::string_view ExpressionScanner::word_at(std::size_t from) const {
  std::size_t end = from;
  while (end < text_.size() && (begins_word(text_[end]) || (end > from && is_digit(text_[end])))) ++end;
  return text_.substr(from, end - from);
}

bool ExpressionScanner::is_called(std::size_t from) const {
  from = skip(from);
  return from < text_.size() && text_[from] == '(';
}

std::size_t ExpressionScanner::number_end(std::size_t from, double& value) const {
  if (from >= text_.size() || !(is_digit(text_[from]) || text_[from] == '.')) return from;
  const char *begin = text_.data() + from, *end = text_.data() + text_.size();
  const auto [rest, error] = std::from_chars(begin, end, value);
  if (error == std::errc::result_out_of_range) value = std::numeric_limits<double>::infinity();
  return from + index_of(rest - begin);
}

std::size_t ExpressionScanner::factor_end(std::size_t from, int depth) const {
  constexpr int most_nested = 5;
  if (from < text_.size() && text_[from] == '(' && depth < most_nested) {
    const std::size_t inner = skip(from + 1), end = unit_end(inner, depth + 1);
    return end > inner && skip(end) < text_.size() && text_[skip(end)] == ')' ? skip(end) + 1 : from;
  }
  const std::string_view word = word_at(from);
  if (word.empty() || !is_unit(word) || (is_function(word) && is_called(from + word.size()))) return from;
  const std::size_t end = from + word.size();
  if (end >= text_.size() || text_[end] != '^') return end;
  const std::size_t digits = end + (text_.substr(end + 1).starts_with('-') ? 2 : 1);
  double exponent = 0.0;
  const std::size_t power = number_end(digits, exponent);
  return power > digits ? power : end;
}

std::size_t ExpressionScanner::unit_end(std::size_t from, int depth) const {
  std::size_t end = factor_end(from, depth);
  for (bool more = end > from; more;) {
    std::size_t other = skip(end);
    if (other < text_.size() && (text_[other] == '/' || text_[other] == '*')) other = skip(other + 1);
    const std::size_t behind = factor_end(other, depth);
    more = behind > other;
    if (more) end = behind;
  }
  return end;
}

std::size_t ExpressionScanner::skip(std::size_t from) const {
  while (from < text_.size() && (text_[from] == ' ' || text_[from] == '\t')) ++from;
  return from;
}

bool is_plain(std::string_view text) {
  ExpressionScanner scan(text);
  bool any = false;
  for (scan.skip_blanks(); !scan.at_end(); scan.skip_blanks()) {
    const std::size_t sign = scan.next() == '-' || scan.next() == '+' ? 1 : 0;
    double number = 0.0;
    const std::size_t end = scan.number_end(scan.at + sign, number);
    if (end == scan.at + sign) break;
    scan.at = end;
    any = true;
  }
  return any && (scan.at_end() || is_unit(text.substr(scan.at)));
}

std::vector<std::string> names_in(std::string_view text) {
  std::vector<std::string> names;
  ExpressionScanner scan(text);
  while (!scan.at_end()) {
    double number = 0.0;
    const std::string_view word = scan.word_at(scan.at);
    const std::size_t end = scan.number_end(scan.at, number);
    const bool name = !word.empty() && word != "pi" && !is_unit(word) &&
                      !(is_function(word) && scan.is_called(scan.at + word.size()));
    if (name) names.emplace_back(word);
    scan.at = std::max({scan.at + 1, scan.at + word.size(), end});
  }
  return names;
}

bool calculates(std::string_view text) {
  ExpressionScanner scan(text);
  char before = '\0';
  for (scan.skip_blanks(); !scan.at_end(); scan.skip_blanks()) {
    double number = 0.0;
    const std::string_view word = scan.word_at(scan.at);
    if (const std::size_t end = scan.number_end(scan.at, number); end > scan.at) {
      if (std::string_view("+-*/(").find(before) != std::string_view::npos && before != '\0') return true;
      scan.at = end;
      before = '0';
    } else if (!word.empty()) {
      if (word == "pi" || (is_function(word) && scan.is_called(scan.at + word.size()))) return true;
      scan.at += word.size();
      before = 'a';
    } else {
      const char found = scan.next();
      if (found == '*' && before == '0') return true;
      const bool sign = (found == '-' || found == '+') && before != 'a' && before != ')';
      before = sign ? '\0' : found;
      ++scan.at;
    }
  }
  return false;
}

std::string refusal_of_name(std::string_view name) {
  const bool plain =
      !name.empty() && name.size() <= 100 && !is_digit(name.front()) &&
      std::all_of(name.begin(), name.end(), [](char c) {
        return is_digit(c) || (begins_word(c) && c != '%' && static_cast<unsigned char>(c) < 0x80);
      });
  if (!plain) return "which is no name of a variable, expected letters, digits and '_', not a digit first";
  if (name == "pi" || is_function(name))
    return "which stands for something in expressions already, expected another name";
  if (is_unit(name))
    return fmt::format("which is a unit, of {}, expected another name such as '{}_'",
                       describe(parse_unit(name).dimension).name, name);
  return "";
}

std::vector<std::string> split_at_commas(std::string_view text) {
  std::vector<std::string> parts(1);
  int open = 0;
  for (const char c : text) {
    open += c == '(' ? 1 : c == ')' ? -1 : 0;
    if (c == ',' && open == 0)
      parts.emplace_back();
    else
      parts.back() += c;
  }
  return parts;
}

} // namespace cnem::input
