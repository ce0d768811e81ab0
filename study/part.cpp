#include "study/part.hpp"

#include "core/error.hpp"

#include <charconv>
#include <fmt/format.h>

namespace cnem::study {

Part read_part(const std::string& text) {
  Part part;
  const char* end = text.data() + text.size();
  const auto [slash, first] = std::from_chars(text.data(), end, part.number);
  if (first == std::errc{} && slash != end && *slash == '/') {
    const auto [rest, second] = std::from_chars(slash + 1, end, part.count);
    if (second == std::errc{} && rest == end && part.number >= 1 && part.number <= part.count) return part;
  }
  throw InputError(fmt::format(
      "--only: found '{}', expected the number of a part and how many there are, 1/4 to 4/4", text));
}

} // namespace cnem::study
