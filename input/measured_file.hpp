#pragma once
// Measured curves in CSV files as machines and spreadsheets write them: separators, decimal commas, headers
// with units.
#include "input/schema/units.hpp"

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace cnem::input {

/// Which two columns of a file are read, and as what.
struct MeasuredColumns {
  std::vector<std::string> names;                   ///< of the header, or numbers from 1; empty: the only two
  std::array<std::optional<Unit>, 2> units{};       ///< none: as the header says
  std::array<std::vector<Dimension>, 2> expected{}; ///< dimensions that each may have
  std::array<std::string, 2> words{"a stroke or a time", "a force, also per length"}; ///< for messages
  std::array<std::string, 2> examples{"stroke[mm]", "force[kN]"};                     ///< of headers
};

struct MeasuredCurve {
  std::vector<double> x, y; ///< SI, in the order of the file
  std::array<Dimension, 2> dimension{};
};

/// Comments begin with #, % or !. Columns stand between `;`, tabs or else commas; beside the first two a
/// decimal comma is read as a point. The first line may name the columns, with units ("F[kN]", "F (kN)",
/// "F / kN", "F in kN"), or a second line has the units. Throws InputError with file, line and column for
/// whatever else it holds and for fewer than two points, IoError when it cannot be read.
MeasuredCurve read_measured(const std::string& path, const MeasuredColumns& columns);

/// Leaves the points of a curve whose x is beyond that of all before. Returns how many went.
std::size_t keep_growing(std::vector<double>& x, std::vector<double>& y);

/// The same, with what to tell of points that went; empty where none did. of: the file, say; what: x in a
/// word. Throws InputError where no two points are left.
std::string keep_growing(std::vector<double>& x, std::vector<double>& y, const std::string& of,
                         const std::string& what);

/// Means of a curve of increasing x over `parts` equal parts of it, where it has more points than that. Parts
/// without points have none.
void average_over_parts(std::vector<double>& x, std::vector<double>& y, std::size_t parts);

} // namespace cnem::input
