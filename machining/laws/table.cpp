#include "machining/laws/table.hpp"

#include "core/error.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <utility>

namespace cnem::machining {

namespace {

void check_increasing(const char* name, const NumberList& list) {
  for (int i = 1; i < list.size; ++i)
    if (!(list.value[i] > list.value[i - 1]))
      throw InputError(fmt::format("the numbers of {} must increase, found {:g} after {:g}, expected a "
                                   "larger one",
                                   name, list.value[i], list.value[i - 1]));
}

/// The place of a number in an increasing list: after which one, and how far towards the next; at the ends of
/// the list where it is beyond them.
std::pair<int, double> between(const NumberList& list, double x) {
  if (list.size < 2) return {0, 0.0};
  const auto next = std::upper_bound(list.value, list.value + list.size, x) - list.value;
  const int low = std::clamp(static_cast<int>(next), 1, list.size - 1) - 1;
  return {low, std::clamp((x - list.value[low]) / (list.value[low + 1] - list.value[low]), 0.0, 1.0)};
}

} // namespace

void TableLaw::complete() const {
  check_increasing("thickness", thickness);
  check_increasing("speed", speed);
  check_increasing("rakes", rakes);
  const int points = thickness.size * std::max(1, speed.size) * std::max(1, rakes.size);
  for (const auto& [what, list] : {std::pair{"Ft", &Ft}, {"Fr", &Fr}, {"Fa", &Fa}})
    if (list->size != points && (list->size > 0 || list != &Fa))
      throw InputError(fmt::format("found {} numbers of {} for {} thicknesses and {} speeds{}, expected {}",
                                   list->size, what, thickness.size, std::max(1, speed.size),
                                   rakes.size > 0 ? fmt::format(" and {} rakes", rakes.size) : "", points));
}

TableLaw TableLaw::of_rake(double rake) const {
  if (rakes.size == 0) return *this;
  const auto [low, share] = between(rakes, rake);
  const int high = std::min(low + 1, rakes.size - 1), points = thickness.size * std::max(1, speed.size);
  TableLaw one = *this;
  one.rakes = {};
  for (NumberList TableLaw::*force : {&TableLaw::Ft, &TableLaw::Fr, &TableLaw::Fa}) {
    const NumberList& all = this->*force;
    NumberList& of_one = one.*force;
    of_one.size = std::min(points, all.size);
    for (int k = 0; k < of_one.size; ++k)
      of_one.value[k] = (1.0 - share) * all.value[low * points + k] + share * all.value[high * points + k];
  }
  return one;
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
  const auto [low, share] = between(speed, cut.speed);
  const LawPoint slow = of_speed(low, cut.thickness), fast = of_speed(low + 1, cut.thickness);
  return {(1.0 - share) * slow.force + share * fast.force, (1.0 - share) * slow.slope + share * fast.slope};
}

} // namespace cnem::machining
