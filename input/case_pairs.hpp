#pragma once
// What cannot be asked for together, for the docs.
#include <string>

namespace cnem::input {

/// The table of pairs of features that are refused, with the reason of each, in Markdown.
std::string pairs_table();

} // namespace cnem::input
