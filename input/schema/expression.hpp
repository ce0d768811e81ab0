#pragma once
// Expressions over quantities as users write them ("0.08 * sheet", "max(gap, 0.1 mm)"), with their
// dimensions.
#include "input/schema/units.hpp"

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace cnem::input {

/// A number in SI with its dimension.
struct Quantity {
  double value = 0.0;
  Dimension dimension;
};

/// A dimension in words, with its SI unit: "a length (m)".
std::string named_dimension(const Dimension& dimension);

/// The quantity as a text that reads back to the same: "0.0002 m", "0.08".
std::string quantity_text(const Quantity& quantity);

/// What a name stands for. Throws UnitError with a clause that says why it is none, "which names …".
using Lookup = std::function<Quantity(std::string_view name)>;

/// sum := product {(+|-) product}, product := sign {(*|/) sign}, sign := [+|-] power, power := value [^ sign]
/// value := number [unit] | unit | name | pi | (sum) | abs, sqrt, sin, cos, tan of a sum | min, max of
/// several
///
/// A number takes all of the unit behind it: "1 / 2 mm/s" divides by a velocity. What was calculated
/// is rounded to 15 digits, so that "0.08 * 2 mm" has the bits of "0.16 mm". Throws UnitError with a clause
/// that says what is wrong and where, "which adds a length (m) and a time (s) at character 7, expected …".
Quantity evaluate(std::string_view text, const Lookup& lookup);

/// Whether the text is one or more numbers with at most one unit, and nothing to calculate.
bool is_plain(std::string_view text);

/// Names in a text that are neither units nor functions.
std::vector<std::string> names_in(std::string_view text);

/// Whether a text that is not plain calculates something, whatever its names mean: "2 mm + 3 mm", "sin(1)".
bool calculates(std::string_view text);

/// Why a variable cannot be named so, in a clause "which …, expected …"; "" when it can.
std::string refusal_of_name(std::string_view name);

/// The parts of a text between commas that stand in no parentheses.
std::vector<std::string> split_at_commas(std::string_view text);

} // namespace cnem::input
