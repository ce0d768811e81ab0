#include "machining/laws/table.hpp"

#include "core/error.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace cnem::machining {

namespace {

void check_increasing(const char* name, const NumberList& list) {
  for (int i = 1; i < list.size; ++i)
    if (!(list.value[i] > list.value[i - 1]))
      throw InputError(fmt::format("the numbers of {} must increase, found {:g} after {:g}, expected a "
                                   "larger one",
                                   name, list.value[i], list.value[i - 1]));
}

} // namespace

void TableLaw::complete() const {
  check_increasing("thickness", thickness);
  check_increasing("speed", speed);
  const int points = thickness.size * std::max(1, speed.size);
  for (const auto& [what, list] : {std::pair{"Ft", &Ft}, {"Fr", &Fr}, {"Fa", &Fa}})
    if (list->size != points && (list->size > 0 || list != &Fa))
      throw InputError(fmt::format("found {} numbers of {} for {} thicknesses and {} speeds, expected {}",
                                   list->size, what, thickness.size, std::max(1, speed.size), points));
}

LawPoint TableLaw::of_speed(int row, double h) const {
  const int n = thickness.size;
  const auto above = std::upper_bound(thickness.value, thickness.value + n, h) - thickness.value;
  const int last = std::min(static_cast<int>(above), n - 1); // below the first point: from the origin
  const double low = last > 0 ? thickness.value[last - 1] : 0.0, high = thickness.value[last];
  LawPoint point;
  for (const auto& [k, list] : {std::pair{0, &Ft}, {1, &Fr}, {2, &Fa}}) {
    if (list->size == 0) continue;
    const double* force = list->value + row * n;
    const double from = last > 0 ? force[last - 1] : 0.0;
    point.slope[k] = (force[last] - from) / (high - low);
    point.force[k] = from + point.slope[k] * (h - low);
  }
  return point;
}

LawPoint TableLaw::at(const Cut& cut) const {
  if (speed.size < 2) return of_speed(0, cut.thickness);
  const auto next = std::upper_bound(speed.value, speed.value + speed.size, cut.speed) - speed.value;
  const int high = std::clamp(static_cast<int>(next), 1, speed.size - 1), low = high - 1;
  const double share =
      std::clamp((cut.speed - speed.value[low]) / (speed.value[high] - speed.value[low]), 0.0, 1.0);
  const LawPoint slow = of_speed(low, cut.thickness), fast = of_speed(high, cut.thickness);
  return {(1.0 - share) * slow.force + share * fast.force, (1.0 - share) * slow.slope + share * fast.slope};
}

} // namespace cnem::machining
