#pragma once
// Numbers in files that other programs have written.
#include "input/schema/document.hpp"
#include "input/schema/units.hpp"

#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>

namespace cnem::input {

/// A finite number that is the whole text, blanks around it aside; nothing otherwise. It may begin with one
/// sign, a plus too.
inline std::optional<double> finite_number(std::string_view text) {
  text = trimmed(text);
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  double value = 0.0;
  const char* end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc{} || rest != end || !std::isfinite(value)) return {};
  return value;
}

/// The same in a unit, as SI; nothing where that is not finite.
inline std::optional<double> finite_number(std::string_view text, const Unit& unit) {
  const std::optional<double> value = finite_number(text);
  if (!value || !std::isfinite(unit.to_si(*value))) return {};
  return unit.to_si(*value);
}

} // namespace cnem::input
