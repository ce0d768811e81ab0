#pragma once
// Closed curves from the outline of a domain, a hole or a tool as written in a case.
#include "core/geometry/curve.hpp"
#include "input/schema/settings.hpp"

#include <stdexcept>
#include <string>

namespace cnem::input {

/// What is wrong with an outline, and the key below its table that says so ("path[2].fillet"; may be empty).
struct OutlineError : std::runtime_error {
  OutlineError(std::string key_, const std::string& message)
      : std::runtime_error(message), key(std::move(key_)) {}
  std::string key;
};

/// Names of pieces that were given none.
struct OutlineNames {
  std::string curve;               ///< of pieces of a path, circles
  bool sides_of_rectangle = false; ///< rectangles have bottom, right, top, left; else the curve's name
};

/// What is wrong with a name that a piece of the boundary is given; "" when it is good.
std::string fault_of_piece_name(const std::string& name);

/// The counter-clockwise curve of a table with `start` and `path`, or `rectangle`, or `circle`. Arcs longer
/// than half a turn are split in two of the same name. Throws OutlineError: several or no forms given,
/// pieces without length, arcs whose ends are not on a circle, fillets that do not fit, a curve that crosses
/// itself, names that are empty or "all".
Curve make_outline(const Setting& table, const OutlineNames& names);

/// The pieces of a table with `start` and `path` alone, which need not close. Throws OutlineError as above.
std::vector<CurvePiece> pieces_of_path(const Setting& table);

/// The same curve with arcs of at most half a turn: longer ones become two of their name.
Curve split_long_arcs(const Curve& curve);

} // namespace cnem::input
