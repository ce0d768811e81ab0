#include "machining/slices.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace cnem::machining {

namespace {

constexpr double same_height = 1e-9; ///< of the thickness

void add_slices(std::vector<Slice>& all, double low, double high, double most) {
  const double count = std::max(1.0, std::ceil((high - low) / most - same_height));
  const double thickness = (high - low) / count;
  for (double k = 0.0; k < count; k += 1.0) all.push_back({low + k * thickness, thickness});
}

} // namespace

std::vector<Slice> slices(double height, double most, std::vector<double> between) {
  assert(height > 0.0 && most > 0.0);
  std::vector<Slice> all;
  add_slices(all, 0.0, height, most);
  const double thickness = all.front().thickness;
  if (std::all_of(between.begin(), between.end(), [&](double z) {
        return std::abs(z / thickness - std::round(z / thickness)) < same_height;
      }))
    return all;
  const Slice whole{0.0, height};
  return divided({&whole, 1}, most, std::move(between));
}

std::vector<Slice> divided(std::span<const Slice> slices, double most, std::vector<double> between) {
  std::sort(between.begin(), between.end());
  std::vector<Slice> all;
  for (const Slice& slice : slices) {
    const double rounding = same_height * std::min(most, slice.thickness), high = slice.low + slice.thickness;
    double low = slice.low;
    for (const double z : between) {
      if (z - low <= rounding || high - z <= rounding) continue;
      add_slices(all, low, z, most);
      low = z;
    }
    if (low == slice.low && slice.thickness <= (1.0 + same_height) * most)
      all.push_back(slice);
    else
      add_slices(all, low, high, most);
  }
  return all;
}

} // namespace cnem::machining
