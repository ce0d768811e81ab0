#pragma once
// Places in messages.
#include "core/vec.hpp"

#include <fmt/format.h>
#include <string>

namespace cnem {

/// "(0.01, -0.002)", with all components.
template<class Vector> std::string place_text(const Vector& x, int digits = 6) {
  std::string text;
  for (const double component : x)
    text += fmt::format("{}{:.{}g}", text.empty() ? "(" : ", ", component, digits);
  return text + ")";
}

} // namespace cnem
