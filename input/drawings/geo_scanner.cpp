#include "input/drawings/geo_scanner.hpp"

#include "input/drawings/drawing.hpp"
#include "input/schema/finite_number.hpp"

#include <algorithm>
#include <cctype>
#include <fmt/format.h>

namespace cnem::input {

GeoScanner::GeoScanner(std::string_view text, const std::string& file) : rest_(text), file_(file) {
  advance();
}

void GeoScanner::fail(std::size_t line, const std::string& message) const {
  throw DrawingError(file_, line, message);
}

std::string GeoScanner::shown() const {
  return now_.kind == GeoToken::Kind::end ? "the end of the file" : fmt::format("'{}'", shortened(now_.text));
}

void GeoScanner::advance() {
  skip_blanks();
  now_ = {GeoToken::Kind::end, "", 0.0, line_};
  if (rest_.empty()) return;
  const auto is_word = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '.';
  };
  std::size_t length = 1;
  const char first = rest_.front();
  if (first == '"') {
    const auto close = rest_.find('"', 1);
    if (close == std::string_view::npos) fail(line_, "found a text that does not end, expected \" after it");
    now_.kind = GeoToken::Kind::text;
    now_.text = rest_.substr(1, close - 1);
    length = close + 1;
  } else if (std::isdigit(static_cast<unsigned char>(first)) || first == '.') {
    while (length < rest_.size() &&
           (is_word(rest_[length]) ||
            ((rest_[length] == '-' || rest_[length] == '+') && std::tolower(rest_[length - 1]) == 'e')))
      ++length;
    now_.kind = GeoToken::Kind::number;
    now_.text = rest_.substr(0, length);
    const auto number = finite_number(now_.text);
    if (!number) fail(line_, fmt::format("found {}, expected a finite number", shown()));
    now_.number = *number;
  } else {
    now_.kind = is_word(first) ? GeoToken::Kind::word : GeoToken::Kind::sign;
    while (now_.kind == GeoToken::Kind::word && length < rest_.size() && is_word(rest_[length])) ++length;
    now_.text = rest_.substr(0, length);
  }
  rest_.remove_prefix(length);
}

void GeoScanner::skip_blanks() {
  while (!rest_.empty()) {
    const std::string_view end = rest_.starts_with("//") ? "\n" : rest_.starts_with("/*") ? "*/" : "";
    std::size_t length = 1;
    if (!end.empty()) {
      const auto close = rest_.find(end, 2);
      if (close == std::string_view::npos && end == "*/")
        fail(line_, "found a comment that does not end, expected */ after it");
      length = close == std::string_view::npos ? rest_.size() : close + end.size();
    } else if (!std::isspace(static_cast<unsigned char>(rest_.front())))
      return;
    line_ += static_cast<std::size_t>(std::count(rest_.begin(), rest_.begin() + long(length), '\n'));
    rest_.remove_prefix(length);
  }
}

bool GeoScanner::take(std::string_view what) {
  if (!now_.is(what)) return false;
  advance();
  return true;
}

void GeoScanner::expect(std::string_view what) {
  if (!take(what)) fail(now_.line, fmt::format("found {}, expected '{}'", shown(), what));
}

} // namespace cnem::input
