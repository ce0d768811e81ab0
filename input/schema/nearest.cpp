#include "input/schema/nearest.hpp"

#include <algorithm>
#include <cctype>
#include <fmt/format.h>

namespace cnem::input {

int edit_distance(std::string_view a, std::string_view b) {
  const auto lower = [](char c) { return std::tolower(static_cast<unsigned char>(c)); };
  const auto equal = [&](char x, char y) { return lower(x) == lower(y); };
  // Rows i−2, i−1 and i of the table of distances between prefixes.
  std::vector<int> before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = static_cast<int>(j);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    before = last;
    last = row;
    row[0] = static_cast<int>(i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const bool same = equal(a[i - 1], b[j - 1]);
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (same ? 0 : 1)});
      if (i > 1 && j > 1 && equal(a[i - 1], b[j - 2]) && equal(a[i - 2], b[j - 1]))
        row[j] = std::min(row[j], before[j - 2] + 1);
    }
  }
  return row[b.size()];
}

std::optional<std::string> nearest(std::string_view word, const std::vector<std::string>& candidates) {
  std::optional<std::string> best;
  constexpr std::size_t longest = 100; // nobody meant a name with that
  if (word.size() > longest) return best;
  int least = 0;
  for (const std::string& candidate : candidates) {
    // "johnson" for "johnson-cook": a long common beginning is one edit.
    const bool begins = word.size() >= 4 && std::string_view(candidate).starts_with(word);
    const int distance = begins ? 1 : edit_distance(word, candidate);
    const int allowed = std::max<int>(1, static_cast<int>(std::max(word.size(), candidate.size()) + 1) / 3);
    if (distance > allowed || (best && distance >= least)) continue;
    best = candidate;
    least = distance;
  }
  return best;
}

std::string did_you_mean(std::string_view word, const std::vector<std::string>& candidates) {
  const std::optional<std::string> name = nearest(word, candidates);
  return name ? fmt::format(" (did you mean '{}'?)", *name) : "";
}

} // namespace cnem::input
