#pragma once
// Parts of reading a calibration, between its translation units.
#include "study/calibration.hpp"
#include "study/study_parts.hpp"

namespace cnem::study {

/// A number of a table with its unit: 0.3, "250 MPa".
struct WrittenNumber {
  double si = 0.0;
  input::Unit unit;
  std::string unit_text;
};

/// A number at a key; none where it is absent or, which is told, something else.
std::optional<WrittenNumber> read_number(TableReader& reader, const input::Value& table,
                                         const std::string& path, const std::string& key,
                                         std::optional<input::Dimension> dimension,
                                         input::Diagnostics& diagnostics);

/// What was measured of a cut; none where nothing was.
std::optional<CutTarget> read_cut(TableReader& reader, const input::Value& table, const std::string& path,
                                  bool closed_form, input::Diagnostics& diagnostics);

} // namespace cnem::study
