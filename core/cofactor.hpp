#pragma once
// Cofactors of deformation gradients inside kernels, by columns.
#include "core/small_vector.hpp"

namespace cnem::CNEM_ISA {

/// det F · F⁻ᵀ as columns, from F as columns; returns det F.
CNEM_INLINE double cofactor(const Small<2> (&f)[2], Small<2> (&c)[2]) {
  c[0] = Small<2>::of(f[1][1], -f[1][0]);
  c[1] = Small<2>::of(-f[0][1], f[0][0]);
  return f[0][0] * f[1][1] - f[1][0] * f[0][1];
}
CNEM_INLINE double cofactor(const Small<3> (&f)[3], Small<3> (&c)[3]) {
  for (int k = 0; k < 3; ++k) {
    const Small<3>&a = f[(k + 1) % 3], &b = f[(k + 2) % 3];
    for (int i = 0; i < 3; ++i) c[k].v[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
  }
  return f[0][0] * c[0][0] + f[0][1] * c[0][1] + f[0][2] * c[0][2];
}

} // namespace cnem::CNEM_ISA
