#pragma once
// Numbers in files of drawings.
#include "input/schema/document.hpp"

#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>

namespace cnem::input {

/// A finite number that is the whole text, blanks around it aside; nothing otherwise.
inline std::optional<double> number_in(std::string_view text) {
  text = trimmed(text);
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0.0;
  const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || rest != text.data() + text.size() || !std::isfinite(value)) return {};
  return value;
}

} // namespace cnem::input
