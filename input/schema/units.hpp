#pragma once
// Quantities with units as users write them ("11 m/s", "5.86 W/(m K)", "0 10 mm"), converted to SI.
#include <array>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace cnem::input {

/// Powers of m, kg, s, K and rad, in halves, because effusivities carry s^½. Angles count as a dimension of
/// their own so that "30" is not taken for 30 rad, nor 1/s for rad/s.
struct Dimension {
  std::array<int, 5> halves{};

  static constexpr Dimension of(int m, int kg, int s, int K = 0, int rad = 0) {
    return {{2 * m, 2 * kg, 2 * s, 2 * K, 2 * rad}};
  }
  constexpr bool operator==(const Dimension&) const = default;
  constexpr bool dimensionless() const { return *this == Dimension{}; }
};

namespace dimension {
inline constexpr Dimension none{};
inline constexpr Dimension length = Dimension::of(1, 0, 0);
inline constexpr Dimension time = Dimension::of(0, 0, 1);
inline constexpr Dimension temperature = Dimension::of(0, 0, 0, 1);
inline constexpr Dimension angle = Dimension::of(0, 0, 0, 0, 1);
inline constexpr Dimension velocity = Dimension::of(1, 0, -1);
inline constexpr Dimension acceleration = Dimension::of(1, 0, -2);
inline constexpr Dimension angular_velocity = Dimension::of(0, 0, -1, 0, 1);
inline constexpr Dimension rate = Dimension::of(0, 0, -1);
inline constexpr Dimension density = Dimension::of(-3, 1, 0);
inline constexpr Dimension surface_energy = Dimension::of(0, 1, -2);
inline constexpr Dimension pressure = Dimension::of(-1, 1, -2);
inline constexpr Dimension heat_flux = Dimension::of(0, 1, -3);
inline constexpr Dimension heat_transfer = Dimension::of(0, 1, -3, -1);
inline constexpr Dimension conductivity = Dimension::of(1, 1, -3, -1);
inline constexpr Dimension specific_heat = Dimension::of(2, 0, -2, -1);
inline constexpr Dimension expansion = Dimension::of(0, 0, 0, -1);
inline constexpr Dimension mass = Dimension::of(0, 1, 0);
inline constexpr Dimension mass_per_length = Dimension::of(-1, 1, 0);
inline constexpr Dimension force = Dimension::of(1, 1, -2);
inline constexpr Dimension force_per_length = Dimension::of(0, 1, -2);
inline constexpr Dimension force_per_volume = Dimension::of(-2, 1, -2);
inline constexpr Dimension compliance = Dimension::of(0, -1, 2);
inline constexpr Dimension effusivity{{0, 2, -5, -2, 0}};
} // namespace dimension

/// What a user calls a dimension, with its SI unit and an example of a value.
struct DimensionText {
  std::string name;    ///< with its article: "a velocity"
  std::string si_unit; ///< "m/s"
  std::string example; ///< "11 m/s"
};

/// For dimensions that no case uses the name is "a quantity in …".
DimensionText describe(const Dimension& dimension);
/// Of a dimension that has two names, N/m and J/m2, or Hz and 1/s, the one whose unit stands in a value.
DimensionText describe(const Dimension& dimension, std::string_view value);

/// A unit such as "W/(m K)": SI value = value · factor · 10^power + offset. Powers of ten stay apart so that
/// "5.1 mm" and "0.0051 m" are the same bits. Only degC has an offset.
struct Unit {
  int power = 0;
  double factor = 1.0;
  double offset = 0.0;
  Dimension dimension;

  /// Infinite when the result is beyond what a double can hold.
  double to_si(double value) const;
};

/// What is wrong with a quantity; the caller knows where. The message says what was found and expected.
struct UnitError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Parses products, quotients and powers of units: "kg/m3", "W/(m K)", "mm/us", "1/s", "N*m", "s^0.5".
/// Throws UnitError for unknown units, malformed expressions, and products after a slash without
/// parentheses, which people read both ways.
Unit parse_unit(std::string_view text);

/// Throws UnitError, which says how it is written, where a comma stands in a number: "0,5 mm".
void refuse_decimal_comma(std::string_view text);

/// Parses one or more numbers that share one unit ("0 10 mm") and returns them in SI.
/// Throws UnitError when the unit is missing, unknown or of another dimension, or a number is not finite.
std::vector<double> parse_quantities(std::string_view text, const Dimension& expected);
/// The same for a key that has an example of its own, as TOML text.
std::vector<double> parse_quantities(std::string_view text, const Dimension& expected,
                                     std::string_view example);

/// One number with its unit. Throws UnitError as above, or when there are several numbers.
double parse_quantity(std::string_view text, const Dimension& expected);

/// The shortest decimal that reads back to the same number.
std::string format_number(double value);

} // namespace cnem::input
