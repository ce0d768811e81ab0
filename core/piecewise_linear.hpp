#pragma once
// Tables of constants over something that is measured with them: temperature, speed.
#include "core/parameter.hpp"

namespace cnem {

/// Linear between the points (at, value), constant before the first and beyond the last; 1 without points.
/// As many values as points.
double piecewise_linear(const NumberList& at, const NumberList& value, double x);

/// Throws InputError unless there are as many values as points, and these increase. The names are those of
/// keys: "speed", "coefficient_over_speed".
void check_points(const char* at_name, const NumberList& at, const char* value_name, const NumberList& value);

} // namespace cnem
