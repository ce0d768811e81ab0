#include "core/cofactor.hpp"
#include "mechanics/step_kernels.hpp"

namespace cnem::CNEM_ISA {

namespace {

/// Norm of what an entry does to its point: |F⁻ᵀ b|, of revolution with the hoop entry h
/// (mechanics/stable_step.hpp).
template<int dim, class Index>
CNEM_INLINE double block_norm(const double* inverse, const SparseRows<dim, Index>& rows, const double* hoop,
                              std::int32_t e) {
  auto b = Small<dim>::load(inverse) * rows.weight[0][e];
  for (int k = 1; k < dim; ++k) b += Small<dim>::load(inverse + k * dim) * rows.weight[k][e];
  if (!hoop) return sqrt(b.dot(b));
  const double h = hoop[e] * inverse[dim * dim + 1], apart = b.dot(b) + h * h;
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

} // namespace

template<int dim>
void invert(const double* const* deformation, const SpectralView<dim>& view, std::ptrdiff_t begin,
            std::ptrdiff_t end) {
  for (std::ptrdiff_t p = begin; p < end; ++p) {
    Small<dim> F[dim], cof[dim];
    for (int k = 0; k < dim; ++k) {
      double column[dim];
      for (int i = 0; i < dim; ++i) column[i] = deformation[i * dim + k][p];
      F[k] = Small<dim>::load(column);
    }
    const double det = cofactor(F, cof), out_of_plane = dim == 2 ? deformation[dim * dim][p] : 1.0;
    double* own = view.inverse + SpectralView<dim>::stride * p;
    for (int k = 0; k < dim; ++k) (cof[k] * (1.0 / det)).store(own + k * dim);
    own[dim * dim] = det * out_of_plane;
    own[dim * dim + 1] = 1.0 / out_of_plane;
  }
}

template<int dim>
void spectral_transfer(const SpectralView<dim>& view, std::ptrdiff_t begin, std::ptrdiff_t end) {
  for (std::ptrdiff_t j = begin; j < end; ++j) {
    double sum = 0.0;
    std::int32_t e = view.columns.begin[j];
    const std::int32_t last = view.columns.begin[j + 1];
    if constexpr (dim == 2)
      if (!view.weighted_hoop) {
        auto two = Small<2>::zero();
        for (; e + 1 < last; e += 2) {
          const auto p = static_cast<std::ptrdiff_t>(view.columns.index[e]),
                     q = static_cast<std::ptrdiff_t>(view.columns.index[e + 1]);
          const double *first = view.inverse + SpectralView<dim>::stride * p,
                       *second = view.inverse + SpectralView<dim>::stride * q;
          two += two_norms(first, second, view.columns, e) *
                 Small<2>::of(view.share[p] * first[dim * dim], view.share[q] * second[dim * dim]);
        }
        sum = two[0] + two[1];
      }
    for (; e < last; ++e) {
      const auto p = static_cast<std::ptrdiff_t>(view.columns.index[e]);
      const double* inverse = view.inverse + SpectralView<dim>::stride * p;
      sum += view.share[p] *
             (inverse[dim * dim] * block_norm<dim>(inverse, view.columns, view.weighted_hoop, e));
    }
    view.transfer[j] = sum / view.weight[j];
  }
}

template<int dim>
void spectral_rows(const SpectralView<dim>& view, std::ptrdiff_t begin, std::ptrdiff_t end) {
  for (std::ptrdiff_t p = begin; p < end; ++p) {
    const double* inverse = view.inverse + SpectralView<dim>::stride * p;
    double sum = 0.0;
    std::int32_t e = view.rows.begin[p];
    const std::int32_t last = view.rows.begin[p + 1];
    if constexpr (dim == 2)
      if (!view.hoop) {
        constexpr int width = Number<Pack<1>>::width;
        for (; e + width <= last; e += width) {
          double norm[width];
          store(norm, row_norms(inverse, view.rows, e));
          for (int k = 0; k < width; ++k)
            sum += norm[k] * view.transfer[static_cast<std::ptrdiff_t>(view.rows.index[e + k])];
        }
      }
    for (; e < last; ++e)
      sum += block_norm<dim>(inverse, view.rows, view.hoop, e) *
             view.transfer[static_cast<std::ptrdiff_t>(view.rows.index[e])];
    view.image[p] = view.modulus[p] * sum;
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
