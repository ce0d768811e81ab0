#pragma once
// Containers that know what they are counted by: their subscript is an index of that kind, or the counter of
// a loop, and no other kind.
#include "core/index.hpp"

#include <memory>
#include <span>
#include <type_traits>
#include <vector>

namespace cnem {

/// A list with one T for each index of a kind.
template<IndexKind Index, class T, class Allocator = std::allocator<T>>
class IndexedVector : public std::vector<T, Allocator> {
  using Base = std::vector<T, Allocator>;

public:
  using Base::Base;
  IndexedVector() = default;
  explicit IndexedVector(Base values) : Base(std::move(values)) {}

  decltype(auto) operator[](std::size_t i) { return Base::operator[](i); }
  decltype(auto) operator[](std::size_t i) const { return Base::operator[](i); }
  decltype(auto) operator[](Index i) { return Base::operator[](index_of(i)); }
  decltype(auto) operator[](Index i) const { return Base::operator[](index_of(i)); }

  IndexRange<Index> indices() const { return IndexRange<Index>(this->size()); }
  /// The index that the next element will have.
  Index next() const { return as<Index>(this->size()); }
};

/// A view of such a list.
template<IndexKind Index, class T> class IndexedSpan : public std::span<T> {
  using Base = std::span<T>;
  using Value = std::remove_const_t<T>;

public:
  IndexedSpan() = default;
  explicit IndexedSpan(Base values) : Base(values) {}
  template<class Allocator>
  requires(!std::is_const_v<T>) IndexedSpan(IndexedVector<Index, Value, Allocator>& values) : Base(values) {}
  template<class Allocator>
  requires std::is_const_v<T> IndexedSpan(const IndexedVector<Index, Value, Allocator>& values)
      : Base(values) {}

  T& operator[](std::size_t i) const { return Base::operator[](i); }
  T& operator[](Index i) const { return Base::operator[](index_of(i)); }

  IndexRange<Index> indices() const { return IndexRange<Index>(this->size()); }
};

} // namespace cnem
