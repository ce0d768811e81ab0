#pragma once
// Boxes along the axes.
#include "core/vec.hpp"

#include <iterator>

namespace cnem {

template<int dim> struct Box {
  Vec<dim> low, high; ///< m
  bool contains(const Vec<dim>& x) const {
    return (x.array() >= low.array()).all() && (x.array() <= high.array()).all();
  }
};

/// Round points, of which there is at least one.
template<int dim, class Points> Box<dim> box_of(const Points& points) {
  Box<dim> box{*std::begin(points), *std::begin(points)};
  for (const Vec<dim>& x : points) {
    box.low = box.low.cwiseMin(x);
    box.high = box.high.cwiseMax(x);
  }
  return box;
}

/// Whether they have a point in common.
template<int dim> bool overlap(const Box<dim>& a, const Box<dim>& b) {
  return (a.low.array() <= b.high.array()).all() && (b.low.array() <= a.high.array()).all();
}

} // namespace cnem
