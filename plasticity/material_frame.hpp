#pragma once
// The axes of a material that turn with it, on a number type T (core/machine/simd.hpp).
#include "plasticity/spectral.hpp"

namespace cnem::plasticity::CNEM_ISA {

using namespace ::cnem::CNEM_ISA;

/// The rotation R of the polar decomposition F F₀ = R U of the whole deformation since the start, F₀ that of
/// the present reference: an axis that was e at the start is R e (Green and Naghdi 1965).
template<int dim, class T> struct MaterialFrame;

/// In plane R enters through the cosine and sine of twice its angle alone, and F F₀ need not be decomposed:
/// the angle is that of (xx + yy, yx − xy), whose length is the sum of the principal stretches.
template<class T> struct MaterialFrame<2, T> {
  T cosine, sine;

  CNEM_INLINE MaterialFrame(const T (&f)[5], const T (&earlier)[5]) {
    const T xx = f[0] * earlier[0] + f[1] * earlier[2], xy = f[0] * earlier[1] + f[1] * earlier[3];
    const T yx = f[2] * earlier[0] + f[3] * earlier[2], yy = f[2] * earlier[1] + f[3] * earlier[3];
    const T c = xx + yy, s = yx - xy;
    const T by_square = T(1.0) / max(c * c + s * s, T(1e-300));
    cosine = (c * c - s * s) * by_square;
    sine = T(2.0) * c * s * by_square;
  }

  /// Rᵀ a R.
  CNEM_INLINE void enter(const T (&a)[4], T (&result)[4]) const { turn(a, sine, result); }
  /// R a Rᵀ.
  CNEM_INLINE void leave(const T (&a)[4], T (&result)[4]) const { turn(a, -sine, result); }

private:
  CNEM_INLINE void turn(const T (&a)[4], T by, T (&result)[4]) const {
    const T mean = T(0.5) * (a[0] + a[1]), difference = T(0.5) * (a[0] - a[1]);
    const T turned = difference * cosine + a[3] * by;
    result[0] = mean + turned;
    result[1] = mean - turned;
    result[2] = a[2];
    result[3] = a[3] * cosine - difference * by;
  }
};

template<class T> struct MaterialFrame<3, T> {
  T rotation[3][3];

  CNEM_INLINE MaterialFrame(const T (&f)[9], const T (&earlier)[9]) {
    T total[3][3], stretch[6], inverse[6];
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k)
        total[i][k] = f[3 * i] * earlier[k] + f[3 * i + 1] * earlier[3 + k] + f[3 * i + 2] * earlier[6 + k];
    constexpr int row[6] = {0, 1, 2, 0, 1, 2}, column[6] = {0, 1, 2, 1, 2, 0};
    for (int c = 0; c < 6; ++c)
      stretch[c] = total[0][row[c]] * total[0][column[c]] + total[1][row[c]] * total[1][column[c]] +
                   total[2][row[c]] * total[2][column[c]];
    const Spectrum<3, T> spectrum(stretch);
    T by_stretch[3];
    for (int k = 0; k < 3; ++k) by_stretch[k] = T(1.0) / sqrt(spectrum.value[k]);
    spectrum.isotropic(by_stretch, inverse);
    const T u[3][3] = {{inverse[0], inverse[3], inverse[5]},
                       {inverse[3], inverse[1], inverse[4]},
                       {inverse[5], inverse[4], inverse[2]}};
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k)
        rotation[i][k] = total[i][0] * u[0][k] + total[i][1] * u[1][k] + total[i][2] * u[2][k];
  }

  CNEM_INLINE void enter(const T (&a)[6], T (&result)[6]) const {
    T transposed[3][3];
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k) transposed[i][k] = rotation[k][i];
    Deformation<3, T>::congruence(transposed, a, result);
  }
  CNEM_INLINE void leave(const T (&a)[6], T (&result)[6]) const {
    Deformation<3, T>::congruence(rotation, a, result);
  }
};

} // namespace cnem::plasticity::CNEM_ISA
