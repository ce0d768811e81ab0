#pragma once
// A surface between periodic planes goes on at its own images.
#include "core/indexed.hpp"
#include "core/vec.hpp"

#include <span>
#include <vector>

namespace cnem::contact {

/// What of a boundary repeats. Empty: nothing does.
template<int dim> struct Repetition {
  std::vector<Vec<dim>> period;  ///< m, independent of each other
  std::vector<PieceIndex> sides; ///< the periodic pieces, through which matter goes on

  bool empty() const { return period.empty(); }
};

/// Sums of multiples of periods (m) by which a box of this extent (m), shifted, comes within `margin` (m) of
/// where it was: first none at all, then each with its opposite after it.
std::vector<Vec3> images(std::span<const Vec3> period, const Vec3& extent, double margin);

} // namespace cnem::contact
