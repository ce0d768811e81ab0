#include "core/geometry/stl.hpp"

#include "core/error.hpp"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <fmt/format.h>

namespace cnem {

namespace {

constexpr std::size_t header = 84, record = 50; // bytes of a binary file

float number_at(std::string_view bytes, std::size_t at) {
  std::uint32_t bits = 0;
  for (std::size_t k = 0; k < 4; ++k)
    bits |= static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[at + k])) << (8 * k);
  return std::bit_cast<float>(bits);
}

std::uint32_t count_at(std::string_view bytes, std::size_t at) {
  return std::bit_cast<std::uint32_t>(number_at(bytes, at));
}

FacetSoup read_binary(std::string_view bytes, double scale) {
  FacetSoup soup;
  soup.solids = {""};
  for (std::size_t at = header; at + record <= bytes.size(); at += record) {
    FacetSoup::Triangle triangle;
    for (std::size_t k = 0; k < 3; ++k) {
      for (std::size_t c = 0; c < 3; ++c)
        triangle.corner[k][static_cast<int>(c)] =
            scale * static_cast<double>(number_at(bytes, at + 12 * (k + 1) + 4 * c));
      if (!triangle.corner[k].allFinite())
        throw InputError(fmt::format("triangle {} has a corner that is no place, expected finite numbers",
                                     soup.triangles.size() + 1));
    }
    soup.triangles.push_back(triangle);
  }
  return soup;
}

/// Words of a text, with the line they stand on.
class Words {
public:
  explicit Words(std::string_view text) : text_(text) {}

  std::string_view next() {
    while (at_ < text_.size() && is_space(text_[at_])) line_ += text_[at_++] == '\n';
    const std::size_t begin = at_;
    while (at_ < text_.size() && !is_space(text_[at_])) ++at_;
    return text_.substr(begin, at_ - begin);
  }
  std::string_view rest_of_line() {
    const std::size_t end = std::min(text_.find('\n', at_), text_.size());
    std::string_view rest = text_.substr(at_, end - at_);
    at_ = end;
    while (!rest.empty() && is_space(rest.front())) rest.remove_prefix(1);
    while (!rest.empty() && is_space(rest.back())) rest.remove_suffix(1);
    return rest;
  }
  void expect(std::string_view word) {
    if (const auto found = next(); found != word) fail(found, fmt::format("\"{}\"", word));
  }
  double number() {
    const std::string_view word = next();
    std::string_view digits = word;
    if (digits.starts_with('+')) digits.remove_prefix(1);
    double value = 0.0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (error != std::errc{} || end != digits.data() + digits.size() || !std::isfinite(value))
      fail(word, "a number");
    return value;
  }
  [[noreturn]] void fail(std::string_view found, std::string_view expected) const {
    throw InputError(fmt::format("line {} of the STL file: found {}, expected {}", line_,
                                 found.empty() ? "its end" : fmt::format("\"{}\"", found.substr(0, 40)),
                                 expected));
  }

private:
  static bool is_space(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

  std::string_view text_;
  std::size_t at_ = 0;
  int line_ = 1;
};

FacetSoup read_text(std::string_view bytes, double scale) {
  FacetSoup soup;
  Words words(bytes);
  for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
    if (word != "solid") words.fail(word, "\"solid\"");
    const std::string name(words.rest_of_line());
    const auto known = std::ranges::find(soup.solids, name);
    const auto solid = static_cast<std::int32_t>(known - soup.solids.begin());
    if (known == soup.solids.end()) soup.solids.push_back(name);
    for (word = words.next(); word != "endsolid"; word = words.next()) {
      if (word != "facet") words.fail(word, "\"facet\" or \"endsolid\"");
      FacetSoup::Triangle triangle;
      triangle.solid = solid;
      words.expect("normal");
      for (int k = 0; k < 3; ++k) // not looked at: facets without area have "nan" or anything
        if (word = words.next(); word.empty() || word == "outer") words.fail(word, "a number");
      words.expect("outer");
      words.expect("loop");
      for (Vec3& corner : triangle.corner) {
        words.expect("vertex");
        for (double& component : corner) component = scale * words.number();
      }
      words.expect("endloop");
      words.expect("endfacet");
      soup.triangles.push_back(triangle);
    }
    words.rest_of_line();
  }
  return soup;
}

} // namespace

FacetSoup parse_stl(std::string_view bytes, double scale) {
  // Binary files may begin with "solid", too: their length tells.
  const std::size_t told = bytes.size() < header ? 0 : header + record * std::size_t{count_at(bytes, 80)};
  std::string_view start = bytes.substr(0, 256);
  start.remove_prefix(std::min(start.find_first_not_of(" \t\r\n"), start.size()));
  FacetSoup soup;
  if (told != 0 && bytes.size() == told)
    soup = read_binary(bytes, scale);
  else if (start.starts_with("solid"))
    soup = read_text(bytes, scale);
  else
    throw InputError(
        fmt::format("found {} bytes that are no STL file, expected \"solid\" at its start or, in "
                    "binary, 84 bytes and 50 for each triangle{}",
                    bytes.size(), told == 0 ? "" : fmt::format(", {} for what it says it has", told)));
  if (soup.triangles.empty()) throw InputError("found no triangle in the STL file, expected some");
  return soup;
}

} // namespace cnem
