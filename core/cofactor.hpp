#pragma once
// Cofactors of deformation gradients inside kernels.
#include "core/machine/simd.hpp"
#include "core/small_vector.hpp"

namespace cnem::CNEM_ISA {

/// det F · F⁻ᵀ as columns, from F as columns; returns det F.
CNEM_INLINE double cofactor(const Small<2> (&f)[2], Small<2> (&c)[2]) {
  c[0] = Small<2>::of(f[1][1], -f[1][0]);
  c[1] = Small<2>::of(-f[0][1], f[0][0]);
  return f[0][0] * f[1][1] - f[1][0] * f[0][1];
}
CNEM_INLINE double cofactor(const Small<3> (&f)[3], Small<3> (&c)[3]) {
  for (int k = 0; k < 3; ++k) c[k] = cross(f[(k + 1) % 3], f[(k + 2) % 3]);
  return f[0].dot(c[0]);
}

/// The same by components as in core/fields/state.hpp: in the plane xx, xy, yx, yy, zz.
template<class T> CNEM_INLINE T cofactor(const T (&f)[5], T (&c)[5]) {
  const T plane = f[0] * f[3] - f[1] * f[2];
  c[0] = f[3] * f[4];
  c[1] = -f[2] * f[4];
  c[2] = -f[1] * f[4];
  c[3] = f[0] * f[4];
  c[4] = plane;
  return plane * f[4];
}
template<class T> CNEM_INLINE T cofactor(const T (&f)[9], T (&c)[9]) {
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) {
      const int a = (i + 1) % 3, b = (i + 2) % 3, d = (k + 1) % 3, e = (k + 2) % 3;
      c[i * 3 + k] = f[a * 3 + d] * f[b * 3 + e] - f[a * 3 + e] * f[b * 3 + d];
    }
  return f[0] * c[0] + f[1] * c[1] + f[2] * c[2];
}

} // namespace cnem::CNEM_ISA
