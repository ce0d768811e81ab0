#include "core/piecewise_linear.hpp"

#include "core/error.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace cnem {

double piecewise_linear(const NumberList& at, const NumberList& value, double x) {
  if (at.size == 0) return 1.0;
  const double *const end = at.value + at.size, *const next = std::upper_bound(at.value, end, x);
  if (next == at.value) return value.value[0];
  if (next == end) return value.value[at.size - 1];
  const auto i = next - at.value;
  return std::lerp(value.value[i - 1], value.value[i],
                   (x - at.value[i - 1]) / (at.value[i] - at.value[i - 1]));
}

void check_points(const char* at_name, const NumberList& at, const char* value_name,
                  const NumberList& value) {
  if (at.size != value.size)
    throw InputError(fmt::format("found {} numbers of {} and {} of {}, expected as many", at.size, at_name,
                                 value.size, value_name));
  for (int i = 1; i < at.size; ++i)
    if (!(at.value[i] > at.value[i - 1]))
      throw InputError(
          fmt::format("the numbers of {} must increase, found {:g} after {:g}, expected a larger "
                      "one",
                      at_name, at.value[i], at.value[i - 1]));
}

} // namespace cnem
