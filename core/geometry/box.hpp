#pragma once
// Boxes along the axes.
#include "core/vec.hpp"

namespace cnem {

template<int dim> struct Box {
  Vec<dim> low, high; ///< m
  bool contains(const Vec<dim>& x) const {
    return (x.array() >= low.array()).all() && (x.array() <= high.array()).all();
  }
};

/// Whether they have a point in common.
template<int dim> bool overlap(const Box<dim>& a, const Box<dim>& b) {
  return (a.low.array() <= b.high.array()).all() && (b.low.array() <= a.high.array()).all();
}

} // namespace cnem
