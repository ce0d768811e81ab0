#pragma once
// The library of materials: the files of materials/, which the program carries in itself, so that it finds
// them wherever it is and a version of it means one set of constants. A file holds the keys of one
// materials.NAME of a case, and is named NAME.toml.
#include "input/schema/settings.hpp"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace cnem::input {

struct LibraryFile {
  std::string_view name; ///< of the material
  std::string_view text;
};

/// In the order of names. cmake/library.cmake writes them into a source file when the program is built.
std::span<const LibraryFile> library_files();

std::vector<std::string> library_names();

/// A material of the library, read as a case would read it.
struct LibraryMaterial {
  std::string name;
  Setting settings; ///< of materials.NAME, in SI, defaults included
  plasticity::Material material;
};

/// Throws InputError with the nearest name when the library has none of this name.
LibraryMaterial library_material(std::string_view name);

/// " (did you mean 'lib:NAME'?)" where the library has a material of nearly that name, else nothing.
std::string did_you_mean_library(std::string_view name);

/// Puts the materials of the library that a document names ("lib:NAME" where a material is named, or as the
/// `base` of one of its own) into its table `materials`, with what the document says otherwise, and a text of
/// where they come from. After that no key names the library any more: the document stands alone.
void take_from_library(Value& document, Diagnostics& diagnostics);

} // namespace cnem::input
