#pragma once
// Storage for fields: 64-byte aligned, so that a kernel may load whole cache lines and vectors.
#include <array>
#include <cstddef>
#include <new>
#include <vector>

namespace cnem {

template<class T> struct AlignedAllocator {
  using value_type = T;
  static constexpr std::align_val_t alignment{64};

  AlignedAllocator() = default;
  template<class U> AlignedAllocator(const AlignedAllocator<U>&) {}

  T* allocate(std::size_t n) { return static_cast<T*>(::operator new(n * sizeof(T), alignment)); }
  void deallocate(T* p, std::size_t) { ::operator delete(p, alignment); }
  template<class U> bool operator==(const AlignedAllocator<U>&) const { return true; }
};

template<class T> using AlignedVector = std::vector<T, AlignedAllocator<T>>;

/// One scalar per node or stress point.
using Field = AlignedVector<double>;

/// n scalars per node or stress point, structure of arrays: field[component][index].
template<int n> using Fields = std::array<Field, n>;

template<std::size_t n> void resize_all(std::array<Field, n>& fields, std::size_t size, double value = 0.0) {
  for (Field& f : fields) f.assign(size, value);
}

template<std::size_t n> std::array<double*, n> pointers(std::array<Field, n>& fields) {
  std::array<double*, n> p;
  for (std::size_t k = 0; k < n; ++k) p[k] = fields[k].data();
  return p;
}

template<std::size_t n> std::array<const double*, n> pointers(const std::array<Field, n>& fields) {
  std::array<const double*, n> p;
  for (std::size_t k = 0; k < n; ++k) p[k] = fields[k].data();
  return p;
}

} // namespace cnem
