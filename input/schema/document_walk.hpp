#pragma once
// Values of a document at the keys of a pattern.
#include "input/schema/document.hpp"

#include <algorithm>
#include <string>
#include <string_view>

namespace cnem::input {

/// f(value, path) for each value of the document at a key with this pattern, "boundary.*.temperature".
template<class F>
void for_each_at(Value& value, std::string_view pattern, const std::string& path, const F& f) {
  if (pattern.empty()) return f(value, path);
  const auto dot = std::min(pattern.find('.'), pattern.size());
  const std::string_view step = pattern.substr(0, dot),
                         rest = pattern.substr(std::min(dot + 1, pattern.size()));
  for (Member& member : value.members)
    if (step == "*" || member.key == step)
      for_each_at(member.value, rest, path.empty() ? member.key : path + "." + member.key, f);
}

} // namespace cnem::input
