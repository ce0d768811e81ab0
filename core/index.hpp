#pragma once
// Numbers of nodes, points, facets and entries as indices of containers.
#include <cassert>
#include <concepts>
#include <cstddef>

namespace cnem {

/// The unsigned index of a node, point, facet or entry. Asserts that there is one: −1 stands for none.
template<std::integral Number> constexpr std::size_t index_of(Number number) {
  if constexpr (std::signed_integral<Number>) assert(number >= 0);
  return static_cast<std::size_t>(number);
}

} // namespace cnem
