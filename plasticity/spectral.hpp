#pragma once
// Spectral forms of symmetric tensors and the maps between configurations, on a number type T
// (core/machine/simd.hpp).
#include "core/machine/simd.hpp"

namespace cnem::plasticity::CNEM_ISA {

using namespace ::cnem::CNEM_ISA;

/// Principal values of a symmetric positive definite tensor b, and isotropic functions of it.
template<int dim, class T> struct Spectrum;

/// In plane the directions enter through cos 2θ and sin 2θ alone.
template<class T> struct Spectrum<2, T> {
  T value[3];
  T cosine, sine;

  CNEM_INLINE explicit Spectrum(const T (&b)[4]) {
    const T mean = T(0.5) * (b[0] + b[1]), difference = T(0.5) * (b[0] - b[1]);
    const T radius = sqrt(difference * difference + b[3] * b[3]);
    value[0] = mean + radius;
    T inverse[2];
    reciprocals({max(radius, T(1e-150)), value[0]}, inverse);
    cosine = difference * inverse[0];
    sine = b[3] * inverse[0];
    value[1] = (b[0] * b[1] - b[3] * b[3]) * inverse[1];
    value[2] = b[2];
  }

  /// Σ v_i n_i ⊗ n_i.
  CNEM_INLINE void isotropic(const T (&v)[3], T (&a)[4]) const {
    const T mean = T(0.5) * (v[0] + v[1]), radius = T(0.5) * (v[0] - v[1]);
    a[0] = mean + radius * cosine;
    a[1] = mean - radius * cosine;
    a[2] = v[2];
    a[3] = radius * sine;
  }
};

/// Cyclic Jacobi rotations until every off-diagonal term is negligible. A lane that has converged is rotated
/// by exactly nothing while others go on.
template<class T> struct Spectrum<3, T> {
  T value[3];
  T axis[3][3]; ///< [i][component]

  CNEM_INLINE explicit Spectrum(const T (&b)[6]) {
    T a[3][3] = {{b[0], b[3], b[5]}, {b[3], b[1], b[4]}, {b[5], b[4], b[2]}};
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k) axis[i][k] = T(i == k ? 1.0 : 0.0);
    for (int sweep = 0; sweep < 12; ++sweep) {
      const bool first = rotate(a, 0, 1, 2), second = rotate(a, 0, 2, 1), third = rotate(a, 1, 2, 0);
      if (!(first || second || third)) break;
    }
    for (int i = 0; i < 3; ++i) value[i] = a[i][i];
  }

  CNEM_INLINE void isotropic(const T (&v)[3], T (&a)[6]) const {
    constexpr int row[6] = {0, 1, 2, 0, 1, 2}, column[6] = {0, 1, 2, 1, 2, 0};
    for (int c = 0; c < 6; ++c) {
      a[c] = v[0] * axis[0][row[c]] * axis[0][column[c]];
      for (int i = 1; i < 3; ++i) a[c] = a[c] + v[i] * axis[i][row[c]] * axis[i][column[c]];
    }
  }

private:
  CNEM_INLINE bool rotate(T (&a)[3][3], int p, int q, int r) {
    const T off = a[p][q];
    const Mask<T> active = off * off > T(0x1p-108) * abs(a[p][p] * a[q][q]);
    if (!any(active)) return false;
    const T theta = (a[q][q] - a[p][p]) / select(active, off + off, T(1.0));
    const T size = T(1.0) / (abs(theta) + sqrt(theta * theta + T(1.0)));
    const T t = select(active, select(theta < T(0.0), -size, size), T(0.0));
    const T c = T(1.0) / sqrt(t * t + T(1.0)), s = t * c;
    a[p][p] = a[p][p] - t * off;
    a[q][q] = a[q][q] + t * off;
    a[p][q] = a[q][p] = select(active, T(0.0), off);
    const T ap = a[p][r], aq = a[q][r];
    a[p][r] = a[r][p] = c * ap - s * aq;
    a[q][r] = a[r][q] = s * ap + c * aq;
    for (int k = 0; k < 3; ++k) {
      const T np = axis[p][k], nq = axis[q][k];
      axis[p][k] = c * np - s * nq;
      axis[q][k] = s * np + c * nq;
    }
    return true;
  }
};

/// A deformation gradient and the transport of tensors with it; components as in core/fields/state.hpp.
template<int dim, class T> struct Deformation;

template<class T> struct Deformation<2, T> {
  T xx, xy, yx, yy, zz;
  T plane; ///< determinant in the plane
  T determinant;

  CNEM_INLINE explicit Deformation(const T (&f)[5]) : xx(f[0]), xy(f[1]), yx(f[2]), yy(f[3]), zz(f[4]) {
    plane = xx * yy - xy * yx;
    determinant = plane * zz;
  }

  /// F C Fᵀ.
  CNEM_INLINE void push_forward(const T (&c)[4], T (&b)[4]) const {
    const T a_xx = xx * c[0] + xy * c[3], a_xy = xx * c[3] + xy * c[1];
    const T a_yx = yx * c[0] + yy * c[3], a_yy = yx * c[3] + yy * c[1];
    b[0] = a_xx * xx + a_xy * xy;
    b[1] = a_yx * yx + a_yy * yy;
    b[2] = zz * zz * c[2];
    b[3] = a_xx * yx + a_xy * yy;
  }

  /// F⁻¹ b F⁻ᵀ, given 1/det F.
  CNEM_INLINE void pull_back(const T (&b)[4], T inverse, T (&c)[4]) const {
    const T in_plane = zz * inverse, out_of_plane = plane * inverse;
    const T i_xx = yy * in_plane, i_xy = -xy * in_plane, i_yx = -yx * in_plane, i_yy = xx * in_plane;
    const T a_xx = i_xx * b[0] + i_xy * b[3], a_xy = i_xx * b[3] + i_xy * b[1];
    const T a_yx = i_yx * b[0] + i_yy * b[3], a_yy = i_yx * b[3] + i_yy * b[1];
    c[0] = a_xx * i_xx + a_xy * i_xy;
    c[1] = a_yx * i_yx + a_yy * i_yy;
    c[2] = b[2] * out_of_plane * out_of_plane;
    c[3] = a_xx * i_yx + a_xy * i_yy;
  }

  /// factor · τ · cof F = factor J τ F⁻ᵀ.
  CNEM_INLINE void piola(const T (&tau)[4], T factor, T (&p)[5]) const {
    const T in_plane = factor * zz;
    const T t_xx = tau[0] * in_plane, t_yy = tau[1] * in_plane, t_xy = tau[3] * in_plane;
    p[0] = t_xx * yy - t_xy * xy;
    p[1] = t_xy * xx - t_xx * yx;
    p[2] = t_xy * yy - t_yy * xy;
    p[3] = t_yy * xx - t_xy * yx;
    p[4] = tau[2] * factor * plane;
  }
};

template<class T> struct Deformation<3, T> {
  T f[3][3];
  T cofactor[3][3];
  T determinant;

  CNEM_INLINE explicit Deformation(const T (&components)[9]) {
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k) f[i][k] = components[3 * i + k];
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k) {
        const int i1 = (i + 1) % 3, i2 = (i + 2) % 3, k1 = (k + 1) % 3, k2 = (k + 2) % 3;
        cofactor[i][k] = f[i1][k1] * f[i2][k2] - f[i1][k2] * f[i2][k1];
      }
    determinant = f[0][0] * cofactor[0][0] + f[0][1] * cofactor[0][1] + f[0][2] * cofactor[0][2];
  }

  CNEM_INLINE void push_forward(const T (&c)[6], T (&b)[6]) const { congruence(f, c, b); }

  CNEM_INLINE void pull_back(const T (&b)[6], T inverse, T (&c)[6]) const {
    T m[3][3];
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k) m[i][k] = cofactor[k][i] * inverse;
    congruence(m, b, c);
  }

  CNEM_INLINE void piola(const T (&tau)[6], T factor, T (&p)[9]) const {
    const T t[3][3] = {{tau[0], tau[3], tau[5]}, {tau[3], tau[1], tau[4]}, {tau[5], tau[4], tau[2]}};
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k)
        p[3 * i + k] =
            factor * (t[i][0] * cofactor[0][k] + t[i][1] * cofactor[1][k] + t[i][2] * cofactor[2][k]);
  }

  /// m a mᵀ.
  CNEM_INLINE static void congruence(const T (&m)[3][3], const T (&a)[6], T (&result)[6]) {
    const T s[3][3] = {{a[0], a[3], a[5]}, {a[3], a[1], a[4]}, {a[5], a[4], a[2]}};
    T half[3][3];
    for (int i = 0; i < 3; ++i)
      for (int k = 0; k < 3; ++k) half[i][k] = m[i][0] * s[0][k] + m[i][1] * s[1][k] + m[i][2] * s[2][k];
    constexpr int row[6] = {0, 1, 2, 0, 1, 2}, column[6] = {0, 1, 2, 1, 2, 0};
    for (int c = 0; c < 6; ++c)
      result[c] = half[row[c]][0] * m[column[c]][0] + half[row[c]][1] * m[column[c]][1] +
                  half[row[c]][2] * m[column[c]][2];
  }
};

} // namespace cnem::plasticity::CNEM_ISA
