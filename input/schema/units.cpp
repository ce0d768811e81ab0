#include "input/schema/units.hpp"
#include "core/index.hpp"
#include "core/rpm.hpp"

#include "input/schema/document.hpp"
#include "input/schema/nearest.hpp"

#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <utility>

namespace cnem::input {
namespace {

struct BaseUnit {
  int power;
  double factor;
  Dimension dimension;
  bool prefixes = true;
};

const std::map<std::string, BaseUnit, std::less<>>& base_units() {
  namespace d = dimension;
  static const std::map<std::string, BaseUnit, std::less<>> units{
      {"m", {0, 1.0, d::length}},
      {"g", {-3, 1.0, Dimension::of(0, 1, 0)}},
      {"t", {3, 1.0, Dimension::of(0, 1, 0), false}},
      {"s", {0, 1.0, d::time}},
      {"min", {0, 60.0, d::time, false}},
      {"h", {0, 3600.0, d::time, false}},
      {"K", {0, 1.0, d::temperature}},
      {"N", {0, 1.0, Dimension::of(1, 1, -2)}},
      {"Pa", {0, 1.0, d::pressure}},
      {"bar", {5, 1.0, d::pressure}},
      {"J", {0, 1.0, Dimension::of(2, 1, -2)}},
      {"W", {0, 1.0, Dimension::of(2, 1, -3)}},
      {"Hz", {0, 1.0, d::rate}},
      {"rad", {0, 1.0, d::angle}},
      {"deg", {0, std::numbers::pi / 180.0, d::angle, false}},
      {"rev", {0, 2.0 * std::numbers::pi, d::angle, false}},
      {"rpm", {0, rpm, d::angular_velocity, false}},
      {"%", {-2, 1.0, d::none, false}},
  };
  return units;
}

struct Prefix {
  std::string_view symbol;
  int power;
};

const Prefix prefixes[] = {{"n", -9}, {"u", -6}, {"µ", -6}, {"μ", -6}, {"m", -3},
                           {"c", -2}, {"d", -1}, {"k", 3},  {"M", 6},  {"G", 9}};

struct DimensionName {
  Dimension dimension;
  std::string_view name, si_unit, example;
};

const DimensionName named_dimensions[] = {
    {dimension::none, "a plain number", "1", "0.3"},
    {dimension::length, "a length", "m", "0.2 mm"},
    {dimension::time, "a time", "s", "12 us"},
    {dimension::temperature, "a temperature", "K", "296 K"},
    {dimension::angle, "an angle", "rad", "30 deg"},
    {dimension::velocity, "a velocity", "m/s", "11 m/s"},
    {dimension::acceleration, "an acceleration", "m/s2", "9.81 m/s2"},
    {dimension::angular_velocity, "an angular velocity", "rad/s", "100 rad/s"},
    {dimension::rate, "a rate", "1/s", "1 /s"},
    {dimension::rate, "a frequency", "Hz", "922 Hz"},
    {dimension::density, "a density", "kg/m3", "7850 kg/m3"},
    {dimension::surface_energy, "an energy per area", "J/m2", "20 kJ/m2"},
    {dimension::pressure, "a stress or pressure", "Pa", "253 MPa"},
    {dimension::heat_flux, "a heat flux", "W/m2", "10 kW/m2"},
    {dimension::heat_transfer, "a heat transfer coefficient", "W/(m2 K)", "5000 W/(m2 K)"},
    {dimension::conductivity, "a conductivity", "W/(m K)", "5.86 W/(m K)"},
    {dimension::specific_heat, "a specific heat", "J/(kg K)", "500 J/(kg K)"},
    {dimension::expansion, "a number per temperature", "1/K", "1.7e-5 1/K"},
    {dimension::effusivity, "an effusivity", "W s^0.5/(m2 K)", "14000 W s^0.5/(m2 K)"},
    {dimension::force, "a force", "N", "10 N"},
    {dimension::force_per_length, "a force per length", "N/m", "10 N/m"},
    {dimension::force_per_volume, "a force per volume", "N/m3", "40 kN/mm^3"},
    {dimension::compliance, "a compliance", "m/N", "0.01 mm/kN"},
    {dimension::mass, "a mass", "kg", "1 kg"},
    {dimension::mass_per_length, "a mass per length", "kg/m", "1 kg/m"},
    {Dimension::of(2, 0, 0), "an area", "m2", "1 mm2"},
    {Dimension::of(2, 1, -2), "an energy", "J", "1 J"},
    {Dimension::of(2, 1, -3), "a power", "W", "1 W"},
};

std::string replace_all(std::string text, std::string_view from, std::string_view to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
  return text;
}

/// Recursive descent over: product := factor { ('/' | '*' | '·' | ' ') factor }.
class UnitParser {
public:
  explicit UnitParser(std::string_view text) : whole_(text), text_(text) {
    for (const auto& [symbol, plain] :
         {std::pair{"⁻", "^-"}, {"¹", "1"}, {"²", "2"}, {"³", "3"}, {"·", "*"}, {"°C", "degC"}, {"°", "deg"}})
      text_ = replace_all(text_, symbol, plain);
  }

  Unit parse() {
    skip_spaces();
    if (at_end()) fail("it is empty");
    if (trimmed() == "degC") return {0, 1.0, 273.15, dimension::temperature};
    const Unit unit = product();
    if (!at_end()) fail(fmt::format("'{}' has no opening parenthesis", text_[at_]));
    return unit;
  }

private:
  [[noreturn]] void fail(const std::string& reason) const {
    throw UnitError(fmt::format("cannot read the unit '{}': {}", shortened(whole_), reason));
  }
  bool at_end() const { return at_ >= text_.size(); }
  char next() const { return at_end() ? '\0' : text_[at_]; }
  void skip_spaces() {
    while (next() == ' ' || next() == '\t') ++at_;
  }
  std::string_view trimmed() const {
    std::string_view rest = std::string_view(text_).substr(at_);
    while (!rest.empty() && (rest.back() == ' ' || rest.back() == '\t')) rest.remove_suffix(1);
    return rest;
  }

  Unit product() {
    if (++depth_ > 20) fail("too many parentheses");
    Unit result;
    bool divided = false, first = true;
    for (skip_spaces(); !at_end() && next() != ')'; skip_spaces(), first = false) {
      const char op = next();
      const bool divide = op == '/';
      if (divide || op == '*') {
        ++at_;
        skip_spaces();
        if (first && !divide) fail("it starts with '*'");
        if (at_end() || next() == ')') fail(fmt::format("nothing follows '{}'", op));
      }
      if (!divide && divided)
        fail("a product after '/' is ambiguous, write W/(m K) or W/m/K instead of W/m K");
      divided = divided || divide;
      multiply(result, power(), divide ? -1 : 1);
    }
    --depth_;
    return result;
  }

  static void multiply(Unit& result, const Unit& unit, int sign) {
    result.power += sign * unit.power;
    result.factor = sign > 0 ? result.factor * unit.factor : result.factor / unit.factor;
    for (std::size_t k = 0; k < result.dimension.halves.size(); ++k)
      result.dimension.halves[k] += sign * unit.dimension.halves[k];
  }

  Unit power() {
    Unit unit = primary();
    const std::optional<double> exponent = read_exponent();
    if (!exponent) return unit;
    const double power = unit.power * *exponent;
    unit.power = static_cast<int>(std::floor(power));
    unit.factor = std::pow(unit.factor, *exponent) * std::pow(10.0, power - unit.power);
    for (int& half : unit.dimension.halves) half = static_cast<int>(std::lround(half * *exponent));
    return unit;
  }

  std::optional<double> read_exponent() {
    const bool caret = next() == '^';
    if (caret) ++at_;
    const bool digit = next() >= '0' && next() <= '9';
    const bool sign = next() == '-' || next() == '+';
    if (!caret && !digit && !sign) return std::nullopt;
    if (next() == '+') ++at_;
    double value = 0.0;
    const auto [end, error] =
        std::from_chars(text_.data() + at_, text_.data() + text_.size(), value, std::chars_format::fixed);
    if (error != std::errc{}) fail("a number must follow '^', as in m^2 or s^0.5");
    at_ = index_of(end - text_.data());
    if (std::abs(value) > 9.0 || 2.0 * value != std::round(2.0 * value))
      fail("powers are whole or half numbers up to 9");
    return value;
  }

  Unit primary() {
    if (next() == '(') {
      ++at_;
      const Unit inner = product();
      if (next() != ')') fail("a parenthesis is not closed");
      ++at_;
      return inner;
    }
    if (next() == '1') {
      ++at_;
      return {};
    }
    std::size_t end = at_;
    while (end < text_.size() &&
           std::string_view(" \t*/()^+-0123456789").find(text_[end]) == std::string::npos)
      ++end;
    if (end == at_) fail(fmt::format("'{}' is not a unit", next()));
    const std::string_view symbol = std::string_view(text_).substr(at_, end - at_);
    at_ = end;
    return lookup(symbol);
  }

  Unit lookup(std::string_view symbol) const {
    if (symbol == "degC") fail("degC has an offset and cannot be part of another unit, use K");
    const auto whole = base_units().find(symbol);
    if (whole != base_units().end())
      return {whole->second.power, whole->second.factor, 0.0, whole->second.dimension};
    for (const Prefix& prefix : prefixes) {
      if (!symbol.starts_with(prefix.symbol)) continue;
      const auto found = base_units().find(symbol.substr(prefix.symbol.size()));
      if (found == base_units().end() || !found->second.prefixes) continue;
      const BaseUnit& unit = found->second;
      return {prefix.power + unit.power, unit.factor, 0.0, unit.dimension};
    }
    if (symbol == "C" || symbol == "Celsius")
      throw UnitError(fmt::format("unknown unit '{}' (did you mean 'degC'?)", symbol));
    static const std::vector<std::string> common{"mm", "m",   "um",  "s",   "ms",  "us",  "ns", "K",  "degC",
                                                 "Pa", "kPa", "MPa", "GPa", "N",   "kN",  "J",  "kJ", "W",
                                                 "kW", "kg",  "g",   "deg", "rad", "rpm", "min"};
    throw UnitError(fmt::format("unknown unit '{}'{}{}", shortened(symbol),
                                symbol == whole_ ? "" : fmt::format(" in '{}'", shortened(whole_)),
                                did_you_mean(symbol, common)));
  }

  std::string_view whole_;
  std::string text_;
  std::size_t at_ = 0;
  int depth_ = 0;
};

/// The unit, with what was expected in what is wrong with it.
Unit unit_of(std::string_view text, const std::string& expectation) {
  try {
    return parse_unit(text);
  } catch (const UnitError& error) { throw UnitError(fmt::format("{}, {}", error.what(), expectation)); }
}

bool is_digit(std::string_view text, std::size_t at) {
  return at < text.size() && text[at] >= '0' && text[at] <= '9';
}

/// Throws UnitError where a comma follows a number: there is none in numbers and between them.
void refuse_comma(std::string_view text, std::string_view rest) {
  if (!rest.starts_with(',')) return;
  std::string expected =
      fmt::format("spaces between numbers: '{}'",
                  shortened(replace_all(replace_all(std::string(text), ",", " "), "  ", " ")));
  if (is_digit(rest, 1)) {
    // "7,850" is a thousandth of 7850 to some.
    const bool thousands = is_digit(rest, 2) && is_digit(rest, 3) && !is_digit(rest, 4);
    expected =
        thousands || text.find(',') != text.rfind(',')
            ? "a point in a number and nothing between thousands"
            : fmt::format("a point in a number: '{}'", shortened(replace_all(std::string(text), ",", ".")));
  }
  throw UnitError(fmt::format("found '{}' with a comma, expected {}", shortened(text), expected));
}

/// The number that begins the text and how many characters it takes; 0 when there is none.
std::pair<double, std::size_t> leading_number(std::string_view text) {
  const std::size_t plus = text.starts_with('+') ? 1 : 0;
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data() + plus, text.data() + text.size(), value);
  if (error == std::errc::result_out_of_range)
    throw UnitError(
        fmt::format("found '{}', which is beyond what a number can hold, expected 0 or 1e-307 to 1e308",
                    shortened(text)));
  if (error != std::errc{}) return {0.0, 0};
  if (!std::isfinite(value))
    throw UnitError(fmt::format("found '{}', expected a finite number", shortened(text)));
  return {value, index_of(end - text.data())};
}

} // namespace

double Unit::to_si(double value) const {
  if (power == 0) return value * factor + offset;
  // Shifting the decimal exponent rounds once, multiplying by 0.001 twice.
  const std::string decimal = fmt::format("{}", value * factor);
  const auto e = decimal.find('e');
  int exponent = power;
  if (e != std::string::npos) exponent += std::stoi(decimal.substr(e + 1));
  const std::string shifted = fmt::format("{}e{}", decimal.substr(0, e), exponent);
  double result = 0.0;
  const auto [end, error] = std::from_chars(shifted.data(), shifted.data() + shifted.size(), result);
  if (error == std::errc::result_out_of_range && exponent > 0) return std::numeric_limits<double>::infinity();
  return result + offset;
}

DimensionText describe(const Dimension& dimension) { return describe(dimension, ""); }

DimensionText describe(const Dimension& dimension, std::string_view value) {
  const DimensionName* found = nullptr;
  for (const DimensionName& known : named_dimensions) {
    if (known.dimension != dimension) continue;
    const std::string_view symbol = known.si_unit.substr(0, known.si_unit.find('/'));
    if (!found || (!symbol.empty() && symbol != "1" && value.find(symbol) != std::string_view::npos))
      found = &known;
  }
  if (found) return {std::string(found->name), std::string(found->si_unit), std::string(found->example)};
  std::string unit;
  const char* symbol[] = {"m", "kg", "s", "K", "rad"};
  for (std::size_t k = 0; k < dimension.halves.size(); ++k)
    if (const int half = dimension.halves[k]; half != 0)
      unit += fmt::format("{}{}{}", unit.empty() ? "" : " ", symbol[k],
                          half == 2 ? "" : fmt::format("^{}", 0.5 * half));
  return {"a quantity in " + unit, unit, "1 " + unit};
}

void refuse_decimal_comma(std::string_view text) {
  if (text.find('(') != std::string_view::npos) return; // min(2, 3)
  const std::size_t comma = text.find(',');
  if (comma == std::string_view::npos || comma == 0 || !is_digit(text, comma - 1)) return;
  if (is_digit(text, comma + 1)) refuse_comma(text, text.substr(comma));
}

Unit parse_unit(std::string_view text) { return UnitParser(text).parse(); }

std::vector<double> parse_quantities(std::string_view text, const Dimension& expected) {
  return parse_quantities(text, expected, fmt::format("\"{}\"", describe(expected).example));
}

std::vector<double> parse_quantities(std::string_view text, const Dimension& expected,
                                     std::string_view example) {
  std::vector<double> values;
  std::string_view rest = text;
  const auto skip_spaces = [&] {
    while (!rest.empty() && (rest.front() == ' ' || rest.front() == '\t')) rest.remove_prefix(1);
  };
  const std::string expectation =
      fmt::format("expected {} such as {}", describe(expected, example).name, example);
  for (skip_spaces(); !rest.empty(); skip_spaces()) {
    const auto [value, length] = leading_number(rest);
    if (length > 0) refuse_comma(text, rest.substr(length));
    const bool whole_word = length == rest.size() || rest[length] == ' ' || rest[length] == '\t';
    // "11m/s" is a number and a unit, but in "1 1/s" the second 1 belongs to the unit.
    if (length == 0 || (!whole_word && !values.empty())) break;
    values.push_back(value);
    rest.remove_prefix(length);
    if (!whole_word) break;
  }
  if (values.empty()) throw UnitError(fmt::format("found '{}', {}", shortened(text), expectation));
  Unit unit;
  skip_spaces();
  if (!rest.empty())
    unit = unit_of(rest, expectation);
  else if (!expected.dimensionless())
    throw UnitError(fmt::format("found '{}' without a unit, {}", shortened(text), expectation));
  if (unit.dimension != expected)
    throw UnitError(fmt::format("found '{}', which is {}, {}", shortened(text),
                                describe(unit.dimension, rest).name, expectation));
  for (double& value : values) {
    value = unit.to_si(value);
    if (!std::isfinite(value))
      throw UnitError(fmt::format("found '{}', which is beyond what a number can hold, {}", shortened(text),
                                  expectation));
  }
  return values;
}

double parse_quantity(std::string_view text, const Dimension& expected) {
  const std::vector<double> values = parse_quantities(text, expected);
  if (values.size() == 1) return values.front();
  const DimensionText wanted = describe(expected);
  throw UnitError(fmt::format("found {} numbers in '{}', expected one: {} such as \"{}\"", values.size(),
                              text, wanted.name, wanted.example));
}

std::string format_number(double value) { return fmt::format("{}", value); }

} // namespace cnem::input
