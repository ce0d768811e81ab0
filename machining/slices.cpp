#include "machining/slices.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace cnem::machining {

namespace {

constexpr double same = 1e-9; ///< of the thickness

void add_slices(std::vector<Slice>& all, double low, double high, double most) {
  const double count = std::max(1.0, std::ceil((high - low) / most - same));
  const double thickness = (high - low) / count;
  for (double k = 0.0; k < count; k += 1.0) all.push_back({low + k * thickness, thickness});
}

} // namespace

std::vector<Slice> slices(double height, double most, std::vector<double> between) {
  assert(height > 0.0 && most > 0.0);
  std::vector<Slice> all;
  add_slices(all, 0.0, height, most);
  const double thickness = all.front().thickness;
  if (std::all_of(between.begin(), between.end(),
                  [&](double z) { return std::abs(z / thickness - std::round(z / thickness)) < same; }))
    return all;
  all.clear();
  between.push_back(height);
  std::sort(between.begin(), between.end());
  double low = 0.0;
  for (const double z : between) {
    if (z - low <= same * most) continue;
    add_slices(all, low, z, most);
    low = z;
  }
  return all;
}

} // namespace cnem::machining
