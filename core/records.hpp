#pragma once
// Records inside kernels: several numbers of a point side by side, from packs of as many points as a register
// holds.
#include "core/machine/simd.hpp"
#include "core/small_vector.hpp"

namespace cnem::CNEM_ISA {

/// Stores n numbers of each point, an even number, at the begin of its record.
template<int stride, int n> CNEM_INLINE void side_by_side(const double (&value)[n], double* record) {
  for (int c = 0; c < n; ++c) record[c] = value[c];
}
template<int stride, int n> CNEM_INLINE void side_by_side(const Pack<1> (&value)[n], double* record) {
  constexpr int width = Number<Pack<1>>::width;
  static_assert(n % 2 == 0);
  if constexpr (n % 4 == 0) {
    for (int c = 0; c < n; c += 4)
      store_fours<stride>(value[c].v[0], value[c + 1].v[0], value[c + 2].v[0], value[c + 3].v[0], record + c);
  } else {
    for (int c = 0; c < n; c += 2) {
      const auto even = even_pairs(value[c].v[0], value[c + 1].v[0]);
      const auto odd = odd_pairs(value[c].v[0], value[c + 1].v[0]);
      for (int lane = 0; lane < width; lane += 2) {
        Small<2>::of(even[lane], even[lane + 1]).store(record + stride * lane + c);
        Small<2>::of(odd[lane], odd[lane + 1]).store(record + stride * (lane + 1) + c);
      }
    }
  }
}

} // namespace cnem::CNEM_ISA
