#pragma once
// Colour maps of even perceived steps, computed in the OKLab colour space.
#include "results/fields.hpp"

#include <span>

namespace cnem::report {

/// sRGB components in [0, 1].
struct Colour {
  double red = 0, green = 0, blue = 0;
};

/// Colour at the fraction s in [0, 1] (clamped). Not-a-number is drawn in `invalid_colour`.
Colour map_colour(ColourMap map, double s);
inline constexpr Colour invalid_colour{1.0, 0.0, 1.0};

/// Lightness of a colour in OKLab, 0 to 1.
double lightness(const Colour& colour);

/// Distance of two colours in OKLab: equal distances look equally large.
double colour_distance(const Colour& one, const Colour& other);

/// Interval of a field that its colours span.
struct ColourRange {
  double low = 0, high = 1;

  bool operator==(const ColourRange&) const = default;
};

/// What a field's values span, which may be a point: from the least to the `percentile` (%) of the finite
/// ones; where zero is in the middle, that percentile of the magnitudes to both sides. Without finite values
/// [0, 0].
ColourRange value_span(ColourMap map, std::span<const double> values, double percentile);
/// What all of them see of `map` unless a case says otherwise, %.
double usual_percentile(ColourMap map);

/// The least interval that holds both.
ColourRange joined(const ColourRange& one, const ColourRange& other);

/// The interval, or one of non-zero width about it: a field that is constant to rounding would show nothing
/// but noise.
ColourRange widened(ColourMap map, const ColourRange& span);

} // namespace cnem::report
