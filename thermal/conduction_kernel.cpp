#include "thermal/conduction_kernels.hpp"

#include "core/cofactor.hpp"
#include "core/operators/sparse_rows.hpp"

namespace cnem::CNEM_ISA {

template<int dim>
void conduction_flux(const OperatorRows<dim>& rows, std::ptrdiff_t unread, const double* hoop,
                     const double* position, const double* temperature, const double* conductivity,
                     double* flux, std::ptrdiff_t begin, std::ptrdiff_t end) {
  for (std::ptrdiff_t p = begin; p < end; ++p) {
    Small<dim> F[dim], cof[dim];
    double gradient[dim] = {}, stretch = hoop ? 0.0 : 1.0;
    for (int k = 0; k < dim; ++k) F[k] = Small<dim>::zero();
    for (std::int32_t e = rows.begin[p]; e < rows.begin[p + 1]; ++e) {
      const auto j = static_cast<std::ptrdiff_t>(rows.index[e]);
      const auto x = Small<dim>::load(position + beside<dim> * j);
      if (hoop) stretch += hoop[e] * x[0];
      for (int k = 0; k < dim; ++k) {
        F[k] += x * rows.weight[k][e - unread];
        gradient[k] += temperature[j] * rows.weight[k][e - unread];
      }
    }
    const double det = cofactor(F, cof);
    auto spatial = Small<dim>::zero(); // det F · F⁻ᵀ ∇_X T
    for (int k = 0; k < dim; ++k) spatial += cof[k] * gradient[k];
    double squares = 0.0;
    for (int k = 0; k < dim; ++k) squares += F[k].dot(F[k]);
    const double volume =
        conducting(det, dim == 2 ? least_of_square * squares : least_of_cube * squares * sqrt(squares));
    const double scale = conductivity[p] * stretch / volume;
    for (int k = 0; k < dim; ++k) flux[dim * (p - begin) + k] = scale * cof[k].dot(spatial);
  }
}

template<int dim>
void conduction_flow(const OperatorColumns<dim>& columns, const double* flux, double* flow,
                     std::ptrdiff_t begin, std::ptrdiff_t end) {
  for (std::ptrdiff_t j = begin; j < end; ++j) {
    double sum = 0.0;
    for (std::int32_t e = columns.begin[j]; e < columns.begin[j + 1]; ++e) {
      const double* q = flux + dim * static_cast<std::ptrdiff_t>(columns.index[e]);
      for (int k = 0; k < dim; ++k) sum += q[k] * columns.weight[k][e];
    }
    flow[j] -= sum;
  }
}

void conduction_triangles(const NodeIndex* node, const double* position, const double* temperature,
                          const double* conductivity, double* heat, std::ptrdiff_t begin,
                          std::ptrdiff_t end) {
  for (std::ptrdiff_t t = begin; t < end; ++t) {
    const auto a = static_cast<std::ptrdiff_t>(node[3 * t]), b = static_cast<std::ptrdiff_t>(node[3 * t + 1]),
               c = static_cast<std::ptrdiff_t>(node[3 * t + 2]);
    const auto A = Small<2>::load(position + 2 * a), B = Small<2>::load(position + 2 * b),
               C = Small<2>::load(position + 2 * c);
    const Small<2> opposite_a = C - B, opposite_b = A - C, opposite_c = B - A;
    const double twice_area = opposite_c[0] * opposite_a[1] - opposite_c[1] * opposite_a[0];
    const double squares =
        opposite_a.dot(opposite_a) + opposite_b.dot(opposite_b) + opposite_c.dot(opposite_c);
    const double carrying = conducting(twice_area, least_of_sides * squares);
    // ∇φ_a is opposite_a turned by 90° over twice the area: its products need no turning
    const Small<2> sum =
        opposite_a * temperature[a] + opposite_b * temperature[b] + opposite_c * temperature[c];
    const Small<2> flux = sum * (-0.5 * conductivity[t] / carrying);
    heat[3 * t] = opposite_a.dot(flux);
    heat[3 * t + 1] = opposite_b.dot(flux);
    heat[3 * t + 2] = opposite_c.dot(flux);
  }
}

void conduction_tetrahedra(const NodeIndex* node, const double* position, const double* temperature,
                           const double* conductivity, double* heat, std::ptrdiff_t begin,
                           std::ptrdiff_t end) {
  for (std::ptrdiff_t t = begin; t < end; ++t) {
    std::ptrdiff_t corner[4];
    for (int c = 0; c < 4; ++c) corner[c] = static_cast<std::ptrdiff_t>(node[4 * t + c]);
    const auto at = [&](int c) { return Small<3>::load(position + beside<3> * corner[c]); };
    const Small<3> a = at(0), x = at(1) - a, y = at(2) - a, z = at(3) - a;
    const Small<3> opposite[3] = {cross(y, z), cross(z, x), cross(x, y)}; // 6V ∇φ of the corners 1, 2, 3
    const Small<3> u = y - x, v = z - y, w = x - z;
    const double squares = component_sum(x * x + y * y + z * z + u * u + v * v + w * w);
    const double carrying = conducting(x.dot(opposite[0]), least_of_edges * squares * sqrt(squares));
    auto sum = Small<3>::zero();
    for (int c = 0; c < 3; ++c) sum += opposite[c] * (temperature[corner[c + 1]] - temperature[corner[0]]);
    const Small<3> flux = sum * (-conductivity[t] / (6.0 * carrying));
    double received = 0.0;
    for (int c = 0; c < 3; ++c) received += heat[4 * t + c + 1] = opposite[c].dot(flux);
    heat[4 * t] = -received;
  }
}

void conduction_corners(const std::int32_t* first, const std::int32_t* corner, const double* heat,
                        double* flow, std::ptrdiff_t begin, std::ptrdiff_t end) {
  for (std::ptrdiff_t j = begin; j < end; ++j) {
    double sum = 0.0;
    for (std::int32_t e = first[j]; e < first[j + 1]; ++e) sum += heat[corner[e]];
    flow[j] += sum;
  }
}

#define CNEM_INSTANTIATE(dim)                                                                                \
  template void conduction_flux<dim>(const OperatorRows<dim>&, std::ptrdiff_t, const double*, const double*, \
                                     const double*, const double*, double*, std::ptrdiff_t, std::ptrdiff_t); \
  template void conduction_flow<dim>(const OperatorColumns<dim>&, const double*, double*, std::ptrdiff_t,    \
                                     std::ptrdiff_t);
CNEM_INSTANTIATE(2)
CNEM_INSTANTIATE(3)
#undef CNEM_INSTANTIATE

} // namespace cnem::CNEM_ISA
