#include "mechanics/step_kernels.hpp"

#include "core/cofactor.hpp"
#include "core/machine/simd.hpp"
#include "core/operators/sparse_rows.hpp"
#include "core/records.hpp"
#include "core/small_vector.hpp"

namespace cnem::CNEM_ISA {

namespace {

/// The columns of F at a point.
template<int dim>
CNEM_INLINE void deformation_row(const OperatorRows<dim>& rows, const double* position, std::ptrdiff_t p,
                                 Small<dim> (&column)[dim]) {
  for (int k = 0; k < dim; ++k) column[k] = Small<dim>::zero();
  for (std::int32_t e = rows.begin[p]; e < rows.begin[p + 1]; ++e) {
    const auto x = Small<dim>::load(position + beside<dim> * static_cast<std::ptrdiff_t>(rows.index[e]));
    for (int k = 0; k < dim; ++k) column[k] += x * rows.weight[k][e];
  }
}

/// Minus what the stresses do to a node. In space each column of a stress has a sum of its own: one for all
/// would wait for itself.
CNEM_INLINE Small<2> internal_force(const OperatorColumns<2>& columns, const double* stress,
                                    std::ptrdiff_t j) {
  auto f = Small<2>::zero();
  for (std::int32_t e = columns.begin[j]; e < columns.begin[j + 1]; ++e) {
    const double* P = stress + 4 * static_cast<std::ptrdiff_t>(columns.index[e]);
    for (int k = 0; k < 2; ++k) f += Small<2>::load(P + k * 2) * columns.weight[k][e];
  }
  return f;
}
CNEM_INLINE Small<3> internal_force(const OperatorColumns<3>& columns, const double* stress,
                                    std::ptrdiff_t j) {
  auto f0 = Small<3>::zero(), f1 = f0, f2 = f0;
  for (std::int32_t e = columns.begin[j]; e < columns.begin[j + 1]; ++e) {
    const double* P = stress + column_stress<3> * static_cast<std::ptrdiff_t>(columns.index[e]);
    f0 += Small<3>::load(P) * columns.weight[0][e];
    f1 += Small<3>::load(P + 4) * columns.weight[1][e];
    f2 += Small<3>::load(P + 8) * columns.weight[2][e];
  }
  return f0 + f1 + f2;
}

} // namespace

template<int dim>
void deformation_rows(const OperatorRows<dim>& rows, const double* position, double* const* deformation,
                      std::ptrdiff_t begin, std::ptrdiff_t end) {
  std::ptrdiff_t p = begin;
  if constexpr (dim == 3)
    for (; p + 4 <= end; p += 4) {
      Small<3> column[4][3];
      for (int n = 0; n < 4; ++n) deformation_row(rows, position, p + n, column[n]);
      for (int k = 0; k < 3; ++k) {
        Small<3> component[3];
        components(column[0][k], column[1][k], column[2][k], column[3][k], component);
        for (int i = 0; i < 3; ++i) component[i].store(deformation[i * 3 + k] + p);
      }
    }
  for (; p < end; ++p) {
    Small<dim> column[dim];
    deformation_row(rows, position, p, column);
    for (int i = 0; i < dim; ++i)
      for (int k = 0; k < dim; ++k) deformation[i * dim + k][p] = column[k][i];
  }
}

template<int dim>
void force_columns(const OperatorColumns<dim>& columns, const double* stress, double* const* force,
                   std::ptrdiff_t begin, std::ptrdiff_t end) {
  for (std::ptrdiff_t j = begin; j < end; ++j) {
    const Small<dim> f = internal_force(columns, stress, j);
    for (int i = 0; i < dim; ++i) force[i][j] -= f[i];
  }
}

namespace {

inline constexpr double two_pi = 6.283185307179586;

/// The columns of a tensor side by side, times `share`.
template<int dim, class T, int general, int n>
CNEM_INLINE void columns_of(const T (&tensor)[general], double share, T (&columns)[n]) {
  for (int k = 0; k < dim; ++k) {
    for (int i = 0; i < dim; ++i) {
      const T& component = tensor[i * dim + k];
      columns[k * beside<dim> + i] = dim == 2 ? component : component * T(share);
    }
    if constexpr (dim == 3) columns[k * beside<dim> + dim] = T(0.0);
  }
}

/// The points p … p + width − 1.
template<int dim, class T>
CNEM_INLINE void viscous_step(const ViscousPoints<dim>& points, double quadratic, double linear, double by_dt,
                              std::ptrdiff_t p, T& dissipated, T& damping) {
  constexpr int general = ViscousPoints<dim>::general;
  T f[general], stress[general], cof[general];
  for (int c = 0; c < general; ++c) {
    f[c] = load<T>(points.deformation[c] + p);
    stress[c] = load<T>(points.piola[c] + p);
  }
  const T J = cofactor(f, cof);
  const T before = load<T>(points.jacobian + p), change = J - before;
  const T volume = load<T>(points.volume + p), modulus = load<T>(points.wave_modulus + p);
  const T flow = select(load<T>(points.plastic_rate + p) > T(0.0), load<T>(points.equivalent_stress + p),
                        load<T>(points.flow_stress + p));
  store(points.flow_stress + p, flow);
  // μ̃ = μ e/(e + ε̄p) = μ σ_y/(σ_y + 3μ ε̄p) with the elastic limit e = σ_y/3μ
  const EdgePoints& edge = points.edge;
  T mu = T(0.0), softened = T(1.0);
  Mask<T> strained = softened < mu;
  if (edge.record) {
    mu = load<T>(edge.shear_modulus + p);
    const T strain = load<T>(edge.plastic_strain + p);
    strained = strain > T(0.0);
    softened = select(strained, flow + T(3.0) * mu * strain, T(1.0));
  }
  T inverse[3];
  reciprocals({J + before, modulus, softened}, inverse);
  const Mask<T> closing = change < T(0.0);
  T q = T(0.0);
  if (any(closing)) {
    const T rate = T(2.0 * by_dt) * change * inverse[0];
    // ρ l c and l/c of the length l = s √(V J) in the plane or s √(V J/(2πr F_θθ)) of revolution, and the
    // speed c = √(M/ρ), ρ = ρ0/J
    T mass = load<T>(points.density + p) * volume, impedance;
    if constexpr (dim == 2) {
      if (points.radius) mass = mass / (T(two_pi) * load<T>(points.radius + p) * f[general - 1]);
      impedance = sqrt(mass * modulus);
    } else {
      const T extent = volume * J;
      const T length = exp(log(extent) * T(1.0 / 3.0));
      impedance = length * sqrt(mass * modulus / extent);
    }
    impedance = impedance * load<T>(points.length_share + p);
    const T share = T(linear) - T(quadratic) * rate * impedance * inverse[1];
    q = select(closing, -rate * impedance * share, T(0.0));
    damping = max(damping, select(closing, share, T(0.0)));
  }
  for (int c = 0; c < general; ++c) stress[c] = stress[c] - q * cof[c];
  dissipated = dissipated - T(0.5) * (load<T>(points.pressure + p) + q) * volume * change;
  store(points.pressure + p, q);
  store(points.jacobian + p, J);
  if constexpr (dim == 2) store(points.out_of_plane + p, stress[4]);
  constexpr int stride = column_stress<dim>;
  T columns[stride];
  columns_of<dim>(stress, 1.0, columns);
  side_by_side<stride>(columns, points.columns + stride * p);

  if (!edge.record) return;
  const T last = load<T>(edge.modulus + p);
  const T secant = select(strained, mu * flow * inverse[2], last);
  store(edge.modulus_before + p, last);
  store(edge.modulus + p, secant);
  T record[EdgeRecord<dim>::place]; // places in the reference stay
  columns_of<dim>(f, EdgeRecord<dim>::share, record);
  record[EdgeRecord<dim>::modulus] = secant;
  record[EdgeRecord<dim>::modulus_before] = last;
  side_by_side<EdgeRecord<dim>::size>(record, edge.record + EdgeRecord<dim>::size * p);
}

} // namespace

template<int dim>
ViscousSums viscous_stress(const ViscousPoints<dim>& points, double quadratic, double linear, double dt,
                           std::ptrdiff_t begin, std::ptrdiff_t end) {
  using Packed = Pack<1>;
  constexpr int width = Number<Packed>::width;
  Packed dissipated = Packed(0.0), damping = Packed(0.0);
  double rest_dissipated = 0.0, rest_damping = 0.0;
  std::ptrdiff_t p = begin;
  for (; p + width <= end; p += width)
    viscous_step<dim>(points, quadratic, linear, 1.0 / dt, p, dissipated, damping);
  for (; p < end; ++p)
    viscous_step<dim>(points, quadratic, linear, 1.0 / dt, p, rest_dissipated, rest_damping);
  double lanes[width];
  store(lanes, dissipated);
  for (const double lane : lanes) rest_dissipated += lane;
  store(lanes, damping);
  for (const double lane : lanes) rest_damping = max(rest_damping, lane);
  return {rest_dissipated, rest_damping};
}

#define CNEM_INSTANTIATE(dim)                                                                                \
  template void deformation_rows<dim>(const OperatorRows<dim>&, const double*, double* const*,               \
                                      std::ptrdiff_t, std::ptrdiff_t);                                       \
  template void force_columns<dim>(const OperatorColumns<dim>&, const double*, double* const*,               \
                                   std::ptrdiff_t, std::ptrdiff_t);                                          \
  template ViscousSums viscous_stress<dim>(const ViscousPoints<dim>&, double, double, double,                \
                                           std::ptrdiff_t, std::ptrdiff_t);
CNEM_INSTANTIATE(2)
CNEM_INSTANTIATE(3)
#undef CNEM_INSTANTIATE

} // namespace cnem::CNEM_ISA
