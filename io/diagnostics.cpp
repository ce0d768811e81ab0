#include "io/diagnostics.hpp"

#include "core/error.hpp"

#include <fmt/format.h>
#include <map>

namespace cnem::io {
namespace {

constexpr int shown_per_kind = 3;

const char* plural(Mistake kind) {
  switch (kind) {
  case Mistake::unknown_key:
    return "unknown keys";
  case Mistake::missing_key:
    return "missing keys";
  case Mistake::type:
    return "values of the wrong type";
  case Mistake::unit:
    return "wrong quantities";
  case Mistake::range:
    return "values out of range";
  case Mistake::reference:
    return "unknown names";
  case Mistake::conflict:
    return "conflicts";
  case Mistake::geometry:
    return "geometric mistakes";
  }
  return "mistakes";
}

} // namespace

void Diagnostics::add(Mistake kind, const Location& where, const std::string& key,
                      const std::string& message) {
  entries_.push_back({kind, fmt::format("{}: key '{}': {}", where.text(), key, message)});
}

void Diagnostics::throw_if_any() const {
  if (entries_.empty()) return;
  std::string text;
  std::map<Mistake, int> count;
  for (const Entry& entry : entries_)
    if (++count[entry.kind] <= shown_per_kind) text += (text.empty() ? "" : "\n") + entry.text;
  for (const auto& [kind, n] : count)
    if (n > shown_per_kind) text += fmt::format("\nand {} more {}", n - shown_per_kind, plural(kind));
  throw InputError(text);
}

} // namespace cnem::io
