#pragma once
// Numbers as people read them: SI prefixes, round tick marks.
#include <string>
#include <string_view>
#include <vector>

namespace cnem::results {

/// A unit with its SI prefix: value in the base unit = factor × value in `unit`.
struct DisplayUnit {
  double factor = 1.0;
  std::string unit;
};

/// Prefixed unit in which `magnitude` (in `unit`) has one to three digits before the point: (3e-6, "s") gives
/// µs. Units that take no prefix ("", "K", "m^2", "1/s") come back as they are.
DisplayUnit display_unit(double magnitude, std::string_view unit);

/// "12.5 µs" from (1.25e-5, "s"): `digits` significant digits, trailing zeros dropped.
std::string si_format(double value, std::string_view unit, int digits = 4);

/// `value` with `digits` significant digits, trailing zeros dropped; "not a number" and "∞" for such values.
std::string number_format(double value, int digits = 4);

/// "1 min 23 s", "2.4 s", "3 h 05 min".
std::string duration_format(double seconds);

/// "12.3 MiB"
std::string bytes_format(double bytes);

/// Round tick marks (1, 2 or 5 × 10^n apart) inside [low, high], about `count` of them; empty unless low <
/// high and both are finite.
struct Ticks {
  std::vector<double> value;
  std::vector<std::string> label; ///< all with the same number of decimals
};
Ticks round_ticks(double low, double high, int count);

} // namespace cnem::results
