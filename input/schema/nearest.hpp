#pragma once
// Suggestions for misspelt names.
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace cnem::input {

/// Edits between two words: insertions, deletions, substitutions and swaps of neighbours, upper and lower
/// case alike.
int edit_distance(std::string_view a, std::string_view b);

/// The candidate closest to the word, if it is close enough to be what was meant (about one edit in three
/// letters, or the word is its beginning). The first of equally close ones.
std::optional<std::string> nearest(std::string_view word, const std::vector<std::string>& candidates);

/// " (did you mean 'x'?)", or nothing when no candidate is near.
std::string did_you_mean(std::string_view word, const std::vector<std::string>& candidates);

} // namespace cnem::input
