#pragma once
// Files of cutting laws: cutting.law = "law.toml" of milling cases.
#include "input/schema/document.hpp"

#include <filesystem>

namespace cnem::input {

/// Puts what a file of a law says in the place of cutting.law of a document, where it has one: the range and
/// the values of the law that is meant become keys of cutting.forces, which the document's own stand before.
/// That is the law that cutting.forces.law names, else the one that the file names. The file is seen from
/// `folder`. Nothing later knows of the file, and the resolved case stands alone; messages about what was
/// put there name its lines. Throws InputError for a file that is absent, no TOML or no law.
void take_law_from_file(Value& document, const std::filesystem::path& folder);

} // namespace cnem::input
