#pragma once
// Numbers as people read them: units of the trade with their prefixes, round tick marks.
#include <string>
#include <string_view>
#include <vector>

namespace cnem::results {

/// A unit that numbers are shown in: value in the SI unit = factor × value in `unit` + offset.
struct DisplayUnit {
  double factor = 1.0;
  std::string unit;
  double offset = 0.0; ///< only °C has one

  double shown(double value) const { return (value - offset) / factor; }
};

/// The unit in which people of forming read `magnitude` (in the SI unit `unit`), with a prefix that leaves
/// few digits: mm, N/mm (kN/mm), J/mm, MPa, mm², J/mm³, MPa √m, °, rpm; s, N, J, W and Hz in steps of a
/// thousand: (3e-6, "s") gives µs. Others ("", "K", "1/s") come back as they are, with raised exponents.
DisplayUnit display_unit(double magnitude, std::string_view unit);

/// A unit as it is printed: "J/mm³" of "J/mm^3" or "J/mm3", "°C" of "degC", "µm" of "um".
std::string printed_unit(std::string_view unit);

/// "12.5 µs" from (1.25e-5, "s"): `digits` significant digits, trailing zeros dropped.
std::string si_format(double value, std::string_view unit, int digits = 4);
/// The same in a unit that was chosen.
std::string format_in(const DisplayUnit& unit, double value, int digits = 4);

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
