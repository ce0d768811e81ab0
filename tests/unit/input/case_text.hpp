#pragma once
// A small valid case to start from, and helpers to look at messages.
#include "input/case_reader.hpp"

#include <gtest/gtest.h>
#include <string>
#include <vector>

namespace cnem::input {

inline const std::string small_case = R"([time]
end = "20 us"

[domain]
material = "steel"
outer.rectangle = { from = "0 0 mm", to = "10 5 mm" }

[cloud]
spacing = "0.25 mm"

[materials.steel]
density = "7850 kg/m3"
elastic = { young = "210 GPa", poisson = 0.3 }
)";

inline Case read_small(const std::string& more = "", const std::vector<std::string>& overrides = {}) {
  return read_case_text(small_case + more, "case.toml", overrides);
}

/// The message with which a text is refused; "accepted" when it is not.
inline std::string refusal_of(const std::string& text, const std::vector<std::string>& overrides = {}) {
  try {
    read_case_text(text, "case.toml", overrides);
  } catch (const InputError& error) { return error.what(); }
  return "accepted";
}

/// The same for lines appended to the small case; its line 14 is the first of them.
inline std::string refusal(const std::string& more, const std::vector<std::string>& overrides = {}) {
  return refusal_of(small_case + more, overrides);
}

inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

inline void expect_parts(const std::string& message, const std::vector<std::string>& parts) {
  for (const std::string& part : parts)
    EXPECT_NE(message.find(part), std::string::npos) << "no '" << part << "' in:\n" << message;
}

} // namespace cnem::input
