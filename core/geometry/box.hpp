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

/// Round the places of things, of which there is at least one.
template<int dim, class Things, class Place> Box<dim> box_of(const Things& things, Place&& place) {
  Box<dim> box{place(*std::begin(things)), place(*std::begin(things))};
  for (const auto& thing : things) {
    const Vec<dim>& x = place(thing);
    box.low = box.low.cwiseMin(x);
    box.high = box.high.cwiseMax(x);
  }
  return box;
}
/// Round points.
template<int dim, class Points> Box<dim> box_of(const Points& points) {
  return box_of<dim>(points, [](const Vec<dim>& x) -> const Vec<dim>& { return x; });
}

/// Whether they have a point in common.
template<int dim> bool overlap(const Box<dim>& a, const Box<dim>& b) {
  return (a.low.array() <= b.high.array()).all() && (b.low.array() <= a.high.array()).all();
}

} // namespace cnem
