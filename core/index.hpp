#pragma once
// From indices of a kind and whole numbers to subscripts of containers, and back.
#include "core/index_kinds.hpp"

#include <cassert>
#include <concepts>
#include <cstddef>
#include <limits>
#include <type_traits>
#include <utility>

namespace cnem {

/// A kind of index (core/index_kinds.hpp).
template<class I>
concept IndexKind = std::same_as<std::underlying_type_t<I>, std::int32_t> && requires {
  I::none;
};

/// Whether there is one.
template<IndexKind Index> constexpr bool exists(Index index) { return index != Index::none; }

/// The unsigned index of a node, point, facet or entry. Asserts that there is one: −1 stands for none.
template<std::integral Number> constexpr std::size_t index_of(Number number) {
  if constexpr (std::signed_integral<Number>) assert(number >= 0);
  return static_cast<std::size_t>(number);
}
template<IndexKind Index> constexpr std::size_t index_of(Index index) {
  return index_of(static_cast<std::int32_t>(index));
}

/// A number as an index of a kind, −1 as none, or as another type of number. Asserts that it fits.
template<class To, std::integral Number> constexpr To as(Number number) {
  if constexpr (std::integral<To>)
    assert(std::in_range<To>(number));
  else
    assert(std::in_range<std::int32_t>(number) && std::cmp_greater_equal(number, -1));
  return static_cast<To>(number);
}
/// The number of an index, −1 for none: for files and messages.
template<std::signed_integral To, IndexKind Index> constexpr To as(Index index) {
  return static_cast<To>(index);
}

/// All indices of one kind below a number, for loops.
template<IndexKind Index> class IndexRange {
public:
  explicit constexpr IndexRange(std::size_t size) : end_(as<std::int32_t>(size)) {}

  struct Iterator {
    std::int32_t at;
    constexpr Index operator*() const { return Index{at}; }
    constexpr Iterator& operator++() { return ++at, *this; }
    constexpr bool operator==(const Iterator&) const = default;
  };
  constexpr Iterator begin() const { return {0}; }
  constexpr Iterator end() const { return {end_}; }

private:
  std::int32_t end_;
};

} // namespace cnem
