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
};

/// Range between two quantiles (0 ≤ low < high ≤ 1) of the finite values; of non-zero width always.
ColourRange quantile_range(std::span<const double> values, double low = 0.0, double high = 1.0);

/// Range symmetric about zero that holds the central fraction `high` of the magnitudes.
ColourRange symmetric_range(std::span<const double> values, double high = 1.0);

} // namespace cnem::report
