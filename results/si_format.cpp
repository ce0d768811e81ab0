#include "results/si_format.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace cnem::results {
namespace {

/// One of the units that a quantity is shown in.
struct Step {
  double from;   ///< in the SI unit: it serves sizes from here on
  double factor; ///< in the SI unit
  const char* unit;
};

/// The units of a quantity, by size; zero has that of `usual`.
struct Scale {
  std::string_view si;
  std::vector<Step> steps;
  std::size_t usual;
};

const std::vector<Scale>& scales() {
  static const std::vector<Scale> all{
      {"m", {{0, 1e-9, "nm"}, {1e-7, 1e-6, "µm"}, {1e-5, 1e-3, "mm"}, {10, 1, "m"}}, 2},
      {"m/s", {{0, 1e-6, "µm/s"}, {1e-3, 1e-3, "mm/s"}, {0.1, 1, "m/s"}}, 2},
      {"m^2", {{0, 1e-6, "mm²"}, {1, 1, "m²"}}, 0},
      {"m^3", {{0, 1e-9, "mm³"}, {1, 1, "m³"}}, 0},
      {"N/m", {{0, 1, "N/m"}, {10, 1e3, "N/mm"}, {1e7, 1e6, "kN/mm"}}, 1},
      {"J/m", {{0, 1, "mJ/mm"}, {100, 1e3, "J/mm"}, {1e7, 1e6, "kJ/mm"}}, 1},
      {"W/m", {{0, 1, "W/m"}, {1e3, 1e3, "W/mm"}, {1e7, 1e6, "kW/mm"}}, 0},
      {"Pa", {{0, 1, "Pa"}, {1e3, 1e3, "kPa"}, {1e5, 1e6, "MPa"}, {1e10, 1e9, "GPa"}}, 2},
      {"Pa m^0.5", {{0, 1, "Pa √m"}, {1e4, 1e6, "MPa √m"}}, 1},
      {"J/m^3", {{0, 1, "J/m³"}, {1e6, 1e9, "J/mm³"}}, 1},
      {"m^3/s", {{0, 1e-6 / 60.0, "cm³/min"}}, 0},
      {"rad/s", {{0, std::numbers::pi / 30.0, "rpm"}}, 0},
      {"rad", {{0, std::numbers::pi / 180.0, "°"}}, 0}};
  return all;
}

struct Prefix {
  int exponent;
  const char* symbol;
};
constexpr std::array<Prefix, 9> prefixes{
    {{-12, "p"}, {-9, "n"}, {-6, "µ"}, {-3, "m"}, {0, ""}, {3, "k"}, {6, "M"}, {9, "G"}, {12, "T"}}};

bool takes_prefix(std::string_view unit) {
  for (const char* base : {"s", "N", "J", "W", "Hz"})
    if (unit == base) return true;
  return false;
}

// Slightly generous, so that 0.99999 of a unit does not fall to the one below.
constexpr double generous = 1.0 + 1e-6;

} // namespace

DisplayUnit display_unit(double magnitude, std::string_view unit) {
  const double size = std::isfinite(magnitude) ? std::abs(magnitude) : 0.0;
  for (const Scale& scale : scales()) {
    if (scale.si != unit) continue;
    const Step* step = &scale.steps[scale.usual];
    if (size > 0.0)
      for (const Step& larger : scale.steps)
        if (size * generous >= larger.from) step = &larger;
    return {step->factor, step->unit};
  }
  if (!takes_prefix(unit) || !(size > 0.0)) return {1.0, printed_unit(unit)};
  const int exponent = 3 * static_cast<int>(std::floor(std::log10(size * generous) / 3.0));
  const int clamped = std::clamp(exponent, prefixes.front().exponent, prefixes.back().exponent);
  for (const Prefix& prefix : prefixes)
    if (prefix.exponent == clamped)
      return {std::pow(10.0, prefix.exponent), prefix.symbol + std::string(unit)};
  return {1.0, std::string(unit)};
}

std::string printed_unit(std::string_view unit) {
  std::string text(unit);
  const auto replace = [&](std::string_view from, std::string_view to) {
    for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
      text.replace(at, from.size(), to);
  };
  replace("degC", "°C");
  replace("deg", "°");
  replace("m^0.5", "√m");
  replace("^2", "²");
  replace("^3", "³");
  replace("*", "·");
  replace("m2", "m²");
  replace("m3", "m³");
  for (const char* micro : {"um", "us", "uN", "uJ"})
    if (const std::size_t at = text.find(micro); at != std::string::npos) text.replace(at, 1, "µ");
  return text;
}

std::string number_format(double value, int digits) {
  if (std::isnan(value)) return "not a number";
  if (std::isinf(value)) return value > 0 ? "∞" : "−∞";
  std::string text = fmt::format("{:.{}g}", value, digits);
  const std::size_t e = text.find('e');
  if (e != std::string::npos) {
    const int exponent = std::stoi(text.substr(e + 1));
    std::string power = std::to_string(exponent);
    for (const auto& [digit, raised] : std::array<std::pair<char, const char*>, 11>{{{'-', "⁻"},
                                                                                     {'0', "⁰"},
                                                                                     {'1', "¹"},
                                                                                     {'2', "²"},
                                                                                     {'3', "³"},
                                                                                     {'4', "⁴"},
                                                                                     {'5', "⁵"},
                                                                                     {'6', "⁶"},
                                                                                     {'7', "⁷"},
                                                                                     {'8', "⁸"},
                                                                                     {'9', "⁹"}}})
      for (std::size_t at = power.find(digit); at != std::string::npos; at = power.find(digit))
        power.replace(at, 1, raised);
    const std::string mantissa = text.substr(0, e);
    text = mantissa == "1" ? "10" + power : mantissa == "-1" ? "-10" + power : mantissa + "·10" + power;
  }
  if (text.front() == '-') text.replace(0, 1, "−");
  return text;
}

std::string si_format(double value, std::string_view unit, int digits) {
  return format_in(display_unit(value, unit), value, digits);
}

std::string format_in(const DisplayUnit& unit, double value, int digits) {
  const std::string number = number_format(unit.shown(value), digits);
  if (unit.unit.empty()) return number;
  return unit.unit == "°" ? number + unit.unit : number + " " + unit.unit;
}

std::string duration_format(double seconds) {
  if (!std::isfinite(seconds)) return "unknown";
  seconds = std::max(seconds, 0.0);
  if (seconds < 9.95) return fmt::format("{:.1f} s", seconds);
  const auto whole = static_cast<long long>(std::llround(seconds));
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
  return fmt::format("{} h {:02} min", whole / 3600, whole % 3600 / 60);
}

std::string bytes_format(double bytes) {
  constexpr std::array<const char*, 5> units{"B", "KiB", "MiB", "GiB", "TiB"};
  std::size_t k = 0;
  while (bytes >= 1024.0 && k + 1 < units.size()) {
    bytes /= 1024.0;
    ++k;
  }
  return number_format(bytes, bytes >= 100.0 ? 4 : 3) + " " + units[k];
}

Ticks round_ticks(double low, double high, int count) {
  Ticks ticks;
  if (!(low < high) || !std::isfinite(low) || !std::isfinite(high) || count < 1) return ticks;
  const double raw = (high - low) / count;
  const double power = std::pow(10.0, std::floor(std::log10(raw)));
  const double mantissa = raw / power;
  const double step = power * (mantissa < 1.5 ? 1.0 : mantissa < 3.5 ? 2.0 : mantissa < 7.5 ? 5.0 : 10.0);
  const int decimals = std::clamp(static_cast<int>(std::ceil(-std::log10(step) - 1e-9)), 0, 12);
  const double largest = std::max(std::abs(low), std::abs(high));
  const bool scientific = largest >= 1e6 || step < 1e-5;
  const double slack = 1e-9 * step;
  for (double n = std::ceil((low - slack) / step); n * step <= high + slack; n += 1.0) {
    const double value = n == 0.0 ? 0.0 : n * step;
    ticks.value.push_back(value);
    std::string label = scientific ? number_format(value, 6) : fmt::format("{:.{}f}", value, decimals);
    if (label.front() == '-') label.replace(0, 1, "−");
    ticks.label.push_back(std::move(label));
  }
  return ticks;
}

} // namespace cnem::results
