#pragma once
// The library of materials for people: `cnem materials` and docs/materials.md.
#include "input/library.hpp"
#include "report/report.hpp"

#include <string>

namespace cnem::report {

/// One line a material: name, law, what else it has, measured range, description.
std::string materials_list();

/// All constants of a material with units, sources and ranges, as text for a terminal.
std::string material_text(const input::LibraryMaterial& material);

/// The same as a page, with flow curves.
ReportData material_report(const input::LibraryMaterial& material, const std::string& version);

/// docs/materials.md: every material with its constants and where they come from.
std::string materials_reference();

} // namespace cnem::report
