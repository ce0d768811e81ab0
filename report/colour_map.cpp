#include "report/colour_map.hpp"

#include "core/index.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace cnem::report {
namespace {

struct Lab {
  double l, a, b;
};

// Björn Ottosson's OKLab (2020): a colour space in which equal distances look equally large.
Lab to_lab(const Colour& colour) {
  const auto linear = [](double c) { return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4); };
  const double r = linear(colour.red), g = linear(colour.green), b = linear(colour.blue);
  const double l = std::cbrt(0.4122214708 * r + 0.5363325363 * g + 0.0514459929 * b);
  const double m = std::cbrt(0.2119034982 * r + 0.6806995451 * g + 0.1073969566 * b);
  const double s = std::cbrt(0.0883024619 * r + 0.2817188376 * g + 0.6299787005 * b);
  return {0.2104542553 * l + 0.7936177850 * m - 0.0040720468 * s,
          1.9779984951 * l - 2.4285922050 * m + 0.4505937099 * s,
          0.0259040371 * l + 0.7827717662 * m - 0.8086757660 * s};
}

Colour to_colour(const Lab& lab) {
  const auto cube = [](double x) { return x * x * x; };
  const double l = cube(lab.l + 0.3963377774 * lab.a + 0.2158037573 * lab.b);
  const double m = cube(lab.l - 0.1055613458 * lab.a - 0.0638541728 * lab.b);
  const double s = cube(lab.l - 0.0894841775 * lab.a - 1.2914855480 * lab.b);
  const auto encode = [](double c) {
    c = std::clamp(c, 0.0, 1.0);
    return c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1.0 / 2.4) - 0.055;
  };
  return {encode(4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s),
          encode(-1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s),
          encode(-0.0041960863 * l - 0.7034186147 * m + 1.7076147010 * s)};
}

struct Stop {
  double lightness, chroma, hue; ///< hue in degrees
};

Lab operator+(const Lab& p, const Lab& q) { return {p.l + q.l, p.a + q.a, p.b + q.b}; }
Lab operator*(double s, const Lab& p) { return {s * p.l, s * p.a, s * p.b}; }
double distance(const Lab& p, const Lab& q) { return std::hypot(p.l - q.l, p.a - q.a, p.b - q.b); }

constexpr std::size_t entries = 257;
using Table = std::array<Colour, entries>;

// A smooth curve through the stops, walked at constant speed in OKLab.
Table make_table(const std::vector<Stop>& stops) {
  std::vector<Lab> knot;
  for (const Stop& stop : stops) {
    const double hue = stop.hue * std::numbers::pi / 180.0;
    knot.push_back({stop.lightness, stop.chroma * std::cos(hue), stop.chroma * std::sin(hue)});
  }
  const std::size_t last = knot.size() - 1;
  const auto curve = [&](double s) { // Catmull-Rom
    const std::size_t k = std::min(static_cast<std::size_t>(s), last - 1);
    const double t = s - static_cast<double>(k);
    const Lab& p1 = knot[k];
    const Lab& p2 = knot[k + 1];
    const Lab p0 = k > 0 ? knot[k - 1] : 2.0 * p1 + -1.0 * p2;
    const Lab p3 = k + 2 <= last ? knot[k + 2] : 2.0 * p2 + -1.0 * p1;
    const Lab a = 0.5 * (p2 + -1.0 * p0);
    const Lab b = p0 + -2.5 * p1 + 2.0 * p2 + -0.5 * p3;
    const Lab c = 0.5 * (3.0 * p1 + -1.0 * p0 + -3.0 * p2 + p3);
    return p1 + t * (a + t * (b + t * c));
  };
  constexpr std::size_t fine = 4096;
  std::vector<Lab> point(fine + 1);
  std::vector<double> length(fine + 1, 0.0);
  for (std::size_t i = 0; i <= fine; ++i) {
    // Through sRGB and back, so that the length is that of the colours a screen can show.
    point[i] = to_lab(to_colour(curve(static_cast<double>(i * last) / fine)));
    if (i > 0) length[i] = length[i - 1] + distance(point[i - 1], point[i]);
  }
  Table table;
  for (std::size_t k = 0, i = 1; k < entries; ++k) {
    const double target = length[fine] * static_cast<double>(k) / (entries - 1);
    while (i < fine && length[i] < target) ++i;
    const double t = std::clamp((target - length[i - 1]) / (length[i] - length[i - 1]), 0.0, 1.0);
    table[k] = to_colour((1.0 - t) * point[i - 1] + t * point[i]);
  }
  return table;
}

const Table& table_of(ColourMap map) {
  static const Table strain = make_table(
      {{0.27, 0.105, 296}, {0.42, 0.115, 268}, {0.57, 0.095, 215}, {0.73, 0.140, 158}, {0.93, 0.175, 106}});
  static const Table heat = make_table(
      {{0.25, 0.055, 285}, {0.42, 0.145, 322}, {0.59, 0.180, 15}, {0.76, 0.155, 58}, {0.96, 0.095, 102}});
  static const Table diverging = make_table(
      {{0.36, 0.130, 262}, {0.64, 0.115, 250}, {0.955, 0.004, 100}, {0.66, 0.135, 40}, {0.40, 0.135, 24}});
  return map == ColourMap::strain ? strain : map == ColourMap::heat ? heat : diverging;
}

std::vector<double> finite_values(std::span<const double> values) {
  std::vector<double> finite;
  finite.reserve(values.size());
  for (const double value : values)
    if (std::isfinite(value)) finite.push_back(value);
  return finite;
}

double quantile(std::vector<double>& values, double fraction) {
  const auto at = index_of(std::llround(fraction * static_cast<double>(values.size() - 1)));
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(at), values.end());
  return values[at];
}

} // namespace

Colour map_colour(ColourMap map, double s) {
  if (std::isnan(s)) return invalid_colour;
  const Table& table = table_of(map);
  const double at = std::clamp(s, 0.0, 1.0) * (entries - 1);
  const std::size_t k = std::min(static_cast<std::size_t>(at), entries - 2);
  const double t = at - static_cast<double>(k);
  return {(1 - t) * table[k].red + t * table[k + 1].red, (1 - t) * table[k].green + t * table[k + 1].green,
          (1 - t) * table[k].blue + t * table[k + 1].blue};
}

double lightness(const Colour& colour) { return to_lab(colour).l; }

double colour_distance(const Colour& one, const Colour& other) {
  return distance(to_lab(one), to_lab(other));
}

ColourRange value_span(ColourMap map, std::span<const double> values, double percentile) {
  std::vector<double> finite = finite_values(values);
  if (finite.empty()) return {0.0, 0.0};
  if (map != ColourMap::diverging) {
    const double low = quantile(finite, 0.0), high = quantile(finite, 0.01 * percentile);
    return {low, high > low ? high : quantile(finite, 1.0)}; // where that share is at rest, all of it
  }
  for (double& value : finite) value = std::abs(value);
  const double limit = quantile(finite, 0.01 * percentile);
  return {-limit, limit};
}

double usual_percentile(ColourMap map) { return map == ColourMap::diverging ? 99.9 : 100.0; }

ColourRange joined(const ColourRange& one, const ColourRange& other) {
  return {std::min(one.low, other.low), std::max(one.high, other.high)};
}

ColourRange widened(ColourMap map, const ColourRange& span) {
  const double least = std::max(1e-9 * std::max(std::abs(span.low), std::abs(span.high)), 1e-300);
  if (span.high - span.low > least) return span;
  if (map == ColourMap::diverging) return {-1.0, 1.0};
  return {span.low, span.low + (span.low == 0.0 ? 1.0 : std::abs(span.low))};
}

} // namespace cnem::report
