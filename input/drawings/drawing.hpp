#pragma once
// What a file of drawings holds, whatever its format: curves on layers, where each was read, and the unit.
#include "core/geometry/curve.hpp"

#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace cnem::input {

/// What is wrong with a drawing, with file and line or with coordinates.
struct DrawingError : std::runtime_error {
  using std::runtime_error::runtime_error;
  DrawingError(const std::string& file, std::size_t line, const std::string& message);
};

/// A unit as cases write it, and how many of it the unit of the drawing is: an inch is 25.4 mm.
struct DrawingUnit {
  std::string name;     ///< of the drawing: "in"
  std::string written;  ///< in cases: "mm"
  double factor = 1.0;  ///< 25.4
  double metres = 1e-3; ///< of the drawing's unit
};

/// Throws DrawingError for what is no unit of length. Knows "in" besides the units of cases.
DrawingUnit drawing_unit(const std::string& name);

/// A curve of the drawing, in its units; `piece.name` is the layer.
struct DrawnCurve {
  CurvePiece piece;
  std::size_t line = 0;         ///< of the file
  bool ends_calculated = false; ///< from a centre and angles, so that neighbours know the corners better
};

/// What stands in a drawing and makes no outline here.
struct UnreadEntity {
  std::string what; ///< "an ELLIPSE", with what to do about it
  std::string layer;
  std::size_t line = 0;
};

struct DrawnFile {
  std::string file;
  std::optional<DrawingUnit> unit;
  std::vector<DrawnCurve> curves;
  std::vector<UnreadEntity> unread;
  std::vector<std::string> layers; ///< in the order of the file, empty ones too
  std::vector<std::string> hidden; ///< of them those that are off, frozen or never plotted
  bool of_a_mesh = false;          ///< straight sides are made of many curves

  void add_layer(const std::string& name);
  /// Throws DrawingError where coordinates are no numbers to calculate with.
  void add(DrawnCurve curve);
};

/// Drawings by what their names end in: .dxf, .geo, .msh. All throw DrawingError. `file` is for messages.
DrawnFile read_dxf(std::string_view text, const std::string& file);
/// Points, lines, circular arcs, loops, plane surfaces and physical curves, with variables and arithmetic.
DrawnFile read_geo(std::string_view text, const std::string& file);
/// Versions 2.2 and 4.1 in text; the boundary of the triangles where the file has no lines.
DrawnFile read_msh(std::string_view text, const std::string& file);

/// Reads a file by what its name ends in. Throws DrawingError, IoError when
/// it cannot be read.
DrawnFile read_drawing(const std::string& path);

/// The point at an angle (degrees) on a circle; exact for multiples of 90.
Vec2 on_circle(const Vec2& centre, double radius, double degrees);

} // namespace cnem::input
