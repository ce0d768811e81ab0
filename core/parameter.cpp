#include "core/parameter.hpp"

namespace cnem {

bool Range::contains(double value) const {
  return (low_open ? value > low : value >= low) && (high_open ? value < high : value <= high);
}

bool Range::bounded() const { return low != anything.low || high != anything.high; }

} // namespace cnem
