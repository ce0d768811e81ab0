#pragma once
// Files that a case takes tables from: include = ["materials.toml"].
#include "input/schema/document.hpp"

#include <filesystem>

namespace cnem::input {

/// The document with the files merged into it that it includes, and those that these include, seen from the
/// folder of the file that names them. Tables are merged; of a key that stands in several files the later
/// file's value holds, and the including file's above all. `folder` is that of the document. Throws
/// InputError for files that are absent, no TOML, or that include each other.
Value with_included(Value document, const std::filesystem::path& folder);

} // namespace cnem::input
