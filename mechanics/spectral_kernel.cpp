#include "core/cofactor.hpp"
#include "core/records.hpp"
#include "mechanics/step_kernels.hpp"

namespace cnem::CNEM_ISA {

namespace {

/// Norm of what an entry does to its point: |F⁻ᵀ b|, of revolution with the hoop entry h
/// (mechanics/stable_step.hpp).
template<class Index>
CNEM_INLINE double block_norm(const double* inverse, const SparseRows<2, Index>& rows, const double* hoop,
                              std::int32_t e) {
  auto b = Small<2>::load(inverse) * rows.weight[0][e];
  b += Small<2>::load(inverse + 2) * rows.weight[1][e];
  if (!hoop) return sqrt(b.dot(b));
  const double h = hoop[e] * inverse[5], apart = b.dot(b) + h * h;
  return sqrt(max(apart + 2.0 * h * b[0], apart));
}

/// |F⁻ᵀ b| of the entries e and e + 1 in the plane, whose points have these inverses.
CNEM_INLINE Small<2> two_norms(const double* first, const double* second, const OperatorColumns<2>& rows,
                               std::int32_t e) {
  const auto image = [&](const double* inverse, std::int32_t entry) {
    return Small<2>::load(inverse) * rows.weight[0][entry] +
           Small<2>::load(inverse + 2) * rows.weight[1][entry];
  };
  const Small<2> a = image(first, e), b = image(second, e + 1);
  return square_roots(sums(a * a, b * b));
}

/// |F⁻ᵀ b| of as many entries of a point in the plane as a register holds.
CNEM_INLINE Pack<1> row_norms(const double* inverse, const OperatorRows<2>& rows, std::int32_t e) {
  const auto w0 = load<Pack<1>>(rows.weight[0] + e), w1 = load<Pack<1>>(rows.weight[1] + e);
  const Pack<1> x = Pack<1>(inverse[0]) * w0 + Pack<1>(inverse[2]) * w1;
  const Pack<1> y = Pack<1>(inverse[1]) * w0 + Pack<1>(inverse[3]) * w1;
  return sqrt(x * x + y * y);
}

/// Of an entry in space the squares of the components of det F · F⁻ᵀ b.
template<class Index>
CNEM_INLINE Small<3> squares(const double* cofactor, const SparseRows<3, Index>& rows, std::int32_t e) {
  auto b = Small<3>::load(cofactor) * rows.weight[0][e];
  for (int k = 1; k < 3; ++k) b += Small<3>::load(cofactor + 4 * k) * rows.weight[k][e];
  return b * b;
}

/// |det F · F⁻ᵀ b| of as many entries of a point in space as a register holds.
CNEM_INLINE Pack<1> row_norms(const double* cofactor, const OperatorRows<3>& rows, std::int32_t e) {
  Pack<1> squares = Pack<1>(0.0);
  for (int i = 0; i < 3; ++i) {
    Pack<1> b = Pack<1>(cofactor[i]) * load<Pack<1>>(rows.weight[0] + e);
    for (int k = 1; k < 3; ++k) b = b + Pack<1>(cofactor[4 * k + i]) * load<Pack<1>>(rows.weight[k] + e);
    squares = squares + b * b;
  }
  return sqrt(squares);
}

/// The points p … p + width − 1.
template<class T>
CNEM_INLINE void invert_in_space(const double* const* deformation, double* record, std::ptrdiff_t p) {
  T f[9], cof[9], columns[12];
  for (int c = 0; c < 9; ++c) f[c] = load<T>(deformation[c] + p);
  columns[3] = T(1.0) / cofactor(f, cof);
  columns[7] = columns[11] = T(0.0);
  for (int k = 0; k < 3; ++k)
    for (int i = 0; i < 3; ++i) columns[4 * k + i] = cof[3 * i + k];
  constexpr int stride = SpectralView<3>::stride;
  side_by_side<stride>(columns, record + stride * p);
}

} // namespace

template<int dim>
void invert(const double* const* deformation, const SpectralView<dim>& view, std::ptrdiff_t begin,
            std::ptrdiff_t end) {
  std::ptrdiff_t p = begin;
  if constexpr (dim == 3) {
    constexpr int width = Number<Pack<1>>::width;
    for (; p + width <= end; p += width) invert_in_space<Pack<1>>(deformation, view.inverse, p);
    for (; p < end; ++p) invert_in_space<double>(deformation, view.inverse, p);
  } else {
    for (; p < end; ++p) {
      Small<2> F[2], cof[2];
      for (int k = 0; k < 2; ++k) F[k] = Small<2>::of(deformation[k][p], deformation[2 + k][p]);
      const double det = cofactor(F, cof), out_of_plane = deformation[4][p];
      double* own = view.inverse + SpectralView<2>::stride * p;
      for (int k = 0; k < 2; ++k) (cof[k] * (1.0 / det)).store(own + k * 2);
      own[4] = det * out_of_plane;
      own[5] = 1.0 / out_of_plane;
    }
  }
}

template<int dim>
void spectral_transfer(const SpectralView<dim>& view, std::ptrdiff_t begin, std::ptrdiff_t end) {
  constexpr int stride = SpectralView<dim>::stride;
  for (std::ptrdiff_t j = begin; j < end; ++j) {
    double sum = 0.0;
    std::int32_t e = view.columns.begin[j];
    const std::int32_t last = view.columns.begin[j + 1];
    const auto point = [&](std::int32_t entry) {
      return static_cast<std::ptrdiff_t>(view.columns.index[entry]);
    };
    if constexpr (dim == 3) {
      for (; e + 1 < last; e += 2) {
        const std::ptrdiff_t p = point(e), q = point(e + 1);
        const Small<3> a = squares(view.inverse + stride * p, view.columns, e),
                       b = squares(view.inverse + stride * q, view.columns, e + 1);
        const Small<2> norms = square_roots(component_sums(a, b));
        sum += view.share[p] * norms[0] + view.share[q] * norms[1];
      }
      if (e < last) {
        const Small<3> a = squares(view.inverse + stride * point(e), view.columns, e);
        sum += view.share[point(e)] * sqrt(component_sum(a));
      }
    } else {
      if (!view.weighted_hoop) {
        auto two = Small<2>::zero();
        for (; e + 1 < last; e += 2) {
          const std::ptrdiff_t p = point(e), q = point(e + 1);
          const double *first = view.inverse + stride * p, *second = view.inverse + stride * q;
          two += two_norms(first, second, view.columns, e) *
                 Small<2>::of(view.share[p] * first[4], view.share[q] * second[4]);
        }
        sum = two[0] + two[1];
      }
      for (; e < last; ++e) {
        const std::ptrdiff_t p = point(e);
        const double* inverse = view.inverse + stride * p;
        sum += view.share[p] * (inverse[4] * block_norm(inverse, view.columns, view.weighted_hoop, e));
      }
    }
    view.transfer[j] = sum / view.weight[j];
  }
}

template<int dim>
void spectral_rows(const SpectralView<dim>& view, std::ptrdiff_t begin, std::ptrdiff_t end) {
  constexpr int width = Number<Pack<1>>::width;
  for (std::ptrdiff_t p = begin; p < end; ++p) {
    const double* inverse = view.inverse + SpectralView<dim>::stride * p;
    double sum = 0.0;
    std::int32_t e = view.rows.begin[p];
    const std::int32_t last = view.rows.begin[p + 1];
    if (dim == 3 || !view.hoop)
      for (; e + width <= last; e += width) {
        double norm[width];
        store(norm, row_norms(inverse, view.rows, e));
        for (int k = 0; k < width; ++k)
          sum += norm[k] * view.transfer[static_cast<std::ptrdiff_t>(view.rows.index[e + k])];
      }
    for (; e < last; ++e) {
      double norm;
      if constexpr (dim == 3)
        norm = sqrt(component_sum(squares(inverse, view.rows, e)));
      else
        norm = block_norm(inverse, view.rows, view.hoop, e);
      sum += norm * view.transfer[static_cast<std::ptrdiff_t>(view.rows.index[e])];
    }
    const double scale = dim == 3 ? view.modulus[p] * inverse[3] : view.modulus[p];
    view.image[p] = scale * sum;
  }
}

#define CNEM_INSTANTIATE(dim)                                                                                \
  template void invert<dim>(const double* const*, const SpectralView<dim>&, std::ptrdiff_t, std::ptrdiff_t); \
  template void spectral_transfer<dim>(const SpectralView<dim>&, std::ptrdiff_t, std::ptrdiff_t);            \
  template void spectral_rows<dim>(const SpectralView<dim>&, std::ptrdiff_t, std::ptrdiff_t);
CNEM_INSTANTIATE(2)
CNEM_INSTANTIATE(3)
#undef CNEM_INSTANTIATE

} // namespace cnem::CNEM_ISA
