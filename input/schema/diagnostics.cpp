#include "input/schema/diagnostics.hpp"

#include <fmt/format.h>

namespace cnem::input {
namespace {

constexpr std::size_t shown_per_kind = 3;

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
  case Mistake::promise:
    return "things that the method does not promise";
  }
  return "mistakes";
}

} // namespace

bool Diagnostics::tells(Mistake kind) const {
  const auto found = counts_.find(kind);
  return found == counts_.end() || found->second < shown_per_kind;
}

void Diagnostics::add(Mistake kind, const Location& where, const std::string& key,
                      const std::string& message) {
  if (following_.contains(where.text())) return;
  if (tells(kind)) told_.push_back(fmt::format("{}: key '{}': {}", where.text(), key, message));
  count(kind);
}

void Diagnostics::throw_if_any() const {
  if (empty()) return;
  std::string text;
  for (const std::string& line : told_) text += (text.empty() ? "" : "\n") + line;
  for (const auto& [kind, n] : counts_)
    if (n > shown_per_kind) text += fmt::format("\nand {} more {}", n - shown_per_kind, plural(kind));
  if (counts_.size() == 1 && counts_.contains(Mistake::promise)) throw MethodRefusal(text);
  throw InputError(text);
}

} // namespace cnem::input
