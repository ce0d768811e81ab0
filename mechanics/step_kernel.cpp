#include "mechanics/step_kernels.hpp"

#include "core/cofactor.hpp"
#include "core/machine/simd.hpp"
#include "core/operators/sparse_rows.hpp"
#include "core/small_vector.hpp"

namespace cnem::CNEM_ISA {

template<int dim>
void deformation_rows(const OperatorRows<dim>& rows, const double* position, double* const* deformation,
                      std::ptrdiff_t begin, std::ptrdiff_t end) {
  for (std::ptrdiff_t p = begin; p < end; ++p) {
    Small<dim> column[dim];
    for (int k = 0; k < dim; ++k) column[k] = Small<dim>::zero();
    for (std::int32_t e = rows.begin[p]; e < rows.begin[p + 1]; ++e) {
      const auto x = Small<dim>::load(position + dim * static_cast<std::ptrdiff_t>(rows.index[e]));
      for (int k = 0; k < dim; ++k) column[k] += x * rows.weight[k][e];
    }
    for (int i = 0; i < dim; ++i)
      for (int k = 0; k < dim; ++k) deformation[i * dim + k][p] = column[k][i];
  }
}

template<int dim>
void force_columns(const OperatorColumns<dim>& columns, const double* stress, double* const* force,
                   std::ptrdiff_t begin, std::ptrdiff_t end) {
  for (std::ptrdiff_t j = begin; j < end; ++j) {
    auto f = Small<dim>::zero();
    for (std::int32_t e = columns.begin[j]; e < columns.begin[j + 1]; ++e) {
      const double* P = stress + dim * dim * static_cast<std::ptrdiff_t>(columns.index[e]);
      for (int k = 0; k < dim; ++k) f += Small<dim>::load(P + k * dim) * columns.weight[k][e];
    }
    for (int i = 0; i < dim; ++i) force[i][j] -= f[i];
  }
}

namespace {

/// Two vectors of the plane in one register.
using Pair [[gnu::vector_size(32)]] = double;

CNEM_INLINE Pair pair_of(Small<2> a, Small<2> b) { return __builtin_shufflevector(a.v, b.v, 0, 1, 2, 3); }
CNEM_INLINE Pair twice(Small<2> a) { return pair_of(a, a); }
CNEM_INLINE Pair load_pair(const double* a, const double* b) {
  return pair_of(Small<2>::load(a), Small<2>::load(b));
}
CNEM_INLINE Pair first_of_each(Pair a) { return __builtin_shufflevector(a, a, 0, 0, 2, 2); }
CNEM_INLINE Pair second_of_each(Pair a) { return __builtin_shufflevector(a, a, 1, 1, 3, 3); }
CNEM_INLINE Small<2> fold(Pair a) { return Small<2>::of(a[0] + a[2], a[1] + a[3]); }

/// edge_defect in the plane: two links at a time; a last single one is paired with a link of a node to
/// itself, which is nothing.
EdgeEnergy plane_edge_defect(const LinkRows& links, double alpha, const double* volume,
                             const double* reference, const double* position, const double* record,
                             double* stress, double* const* force, std::ptrdiff_t begin, std::ptrdiff_t end) {
  constexpr int stride = 6;
  const Pair halves = {0.5, 0.5, 0.5, 0.5};
  Pair energies = {}; // now, before, now, before
  for (std::ptrdiff_t i = begin; i < end; ++i) {
    const double* own = record + stride * i;
    const Pair X = twice(Small<2>::load(reference + 2 * i)), x = twice(Small<2>::load(position + 2 * i));
    const Pair F0 = twice(Small<2>::load(own)), F1 = twice(Small<2>::load(own + 2)),
               moduli = twice(Small<2>::load(own + 4));
    Pair pull = {}, moment0 = {}, moment1 = {};
    const std::int32_t last = links.begin[i + 1];
    for (std::int32_t e = links.begin[i]; e < last; e += 2) {
      const bool single = e + 1 == last;
      const auto a = static_cast<std::ptrdiff_t>(links.neighbour[e]);
      const auto b = single ? i : static_cast<std::ptrdiff_t>(links.neighbour[e + 1]);
      const double *other_a = record + stride * a, *other_b = record + stride * b;
      const Pair dX = load_pair(reference + 2 * a, reference + 2 * b) - X;
      const Pair dX0 = first_of_each(dX), dX1 = second_of_each(dX);
      const Pair mean =
          (F0 + load_pair(other_a, other_b)) * dX0 + (F1 + load_pair(other_a + 2, other_b + 2)) * dX1;
      const Pair r = load_pair(position + 2 * a, position + 2 * b) - x - halves * mean;
      const double wa = links.weight[e], wb = single ? 0.0 : links.weight[e + 1];
      const Pair stiffness = Pair{wa, wa, wb, wb} * (moduli + load_pair(other_a + 4, other_b + 4));
      const Pair square = r * r;
      energies += stiffness * (first_of_each(square) + second_of_each(square));
      const Pair tension = first_of_each(stiffness) * r;
      pull += tension;
      moment0 += tension * dX0;
      moment1 += tension * dX1;
    }
    const double scale = 0.5 * alpha, half_inverse_volume = 0.5 / volume[i];
    const Small<2> f = fold(pull) * scale;
    force[0][i] += f[0];
    force[1][i] += f[1];
    double* P = stress + 4 * i;
    (Small<2>::load(P) - fold(moment0) * (scale * half_inverse_volume)).store(P);
    (Small<2>::load(P + 2) - fold(moment1) * (scale * half_inverse_volume)).store(P + 2);
  }
  const Small<2> sum = fold(energies) * (0.5 * alpha);
  return {0.25 * sum[0], 0.25 * (sum[1] - sum[0])}; // ½ of ½ Σ k|r|²: every link is seen from both its ends
}

} // namespace

template<int dim>
EdgeEnergy edge_defect(const LinkRows& links, double alpha, const double* volume, const double* reference,
                       const double* position, const double* record, double* stress, double* const* force,
                       std::ptrdiff_t begin, std::ptrdiff_t end) {
  if constexpr (dim == 2)
    return plane_edge_defect(links, alpha, volume, reference, position, record, stress, force, begin, end);
  constexpr int stride = dim * dim + 2;
  double stored = 0.0, released = 0.0;
  for (std::ptrdiff_t i = begin; i < end; ++i) {
    const auto X = Small<dim>::load(reference + dim * i), x = Small<dim>::load(position + dim * i);
    const double* own = record + stride * i;
    Small<dim> F[dim], moment[dim];
    for (int k = 0; k < dim; ++k) {
      F[k] = Small<dim>::load(own + k * dim);
      moment[k] = Small<dim>::zero();
    }
    auto pull = Small<dim>::zero();
    for (std::int32_t e = links.begin[i]; e < links.begin[i + 1]; ++e) {
      const auto j = static_cast<std::ptrdiff_t>(links.neighbour[e]);
      const double* other = record + stride * j;
      const auto dX = Small<dim>::load(reference + dim * j) - X;
      auto r = Small<dim>::load(position + dim * j) - x;
      for (int k = 0; k < dim; ++k) r -= (F[k] + Small<dim>::load(other + k * dim)) * (0.5 * dX[k]);
      const double scale = 0.5 * alpha * links.weight[e], r2 = r.dot(r);
      const double stiffness = scale * (own[dim * dim] + other[dim * dim]);
      stored += stiffness * r2;
      released += (scale * (own[dim * dim + 1] + other[dim * dim + 1]) - stiffness) * r2;
      const auto tension = r * stiffness;
      pull += tension;
      for (int k = 0; k < dim; ++k) moment[k] += tension * dX[k];
    }
    const double half_inverse_volume = 0.5 / volume[i];
    for (int k = 0; k < dim; ++k) {
      double* P = stress + dim * dim * i + dim * k;
      (Small<dim>::load(P) - moment[k] * half_inverse_volume).store(P);
      force[k][i] += pull[k];
    }
  }
  return {0.25 * stored, 0.25 * released}; // ½ of ½ Σ k|r|²: every link is seen from both its ends
}

namespace {

inline constexpr double two_pi = 6.283185307179586;

template<class T> CNEM_INLINE T root_of_volume(T volume, bool plane) {
  return plane ? sqrt(volume) : exp(log(volume) * T(1.0 / 3.0));
}

/// Stores n numbers of each point as one record a point.
template<int n, class T> CNEM_INLINE void side_by_side(const T (&value)[n], double* record) {
  constexpr int width = Number<T>::width;
  double rows[n][width];
  for (int c = 0; c < n; ++c) store(rows[c], value[c]);
  for (int lane = 0; lane < width; ++lane)
    for (int c = 0; c < n; ++c) record[n * lane + c] = rows[c][lane];
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
  const T volume = load<T>(points.volume + p);
  const Mask<T> closing = change < T(0.0);
  T q = T(0.0);
  if (any(closing)) {
    const T rate = T(2.0 * by_dt) * change / (J + before);
    const T rho = load<T>(points.density + p) / J;
    T extent = volume * J;
    if (dim == 2 && points.radius)
      extent = extent / (T(two_pi) * load<T>(points.radius + p) * f[general - 1]);
    const T length = root_of_volume(extent, dim == 2);
    const T speed = sqrt(load<T>(points.wave_modulus + p) / rho);
    const T share = T(linear) - T(quadratic) * length * rate / speed;
    q = select(closing, -rho * length * rate * speed * share, T(0.0));
    damping = max(damping, select(closing, share, T(0.0)));
  }
  for (int c = 0; c < general; ++c) stress[c] = stress[c] - q * cof[c];
  dissipated = dissipated - T(0.5) * (load<T>(points.pressure + p) + q) * volume * change;
  store(points.pressure + p, q);
  store(points.jacobian + p, J);
  if constexpr (dim == 2) store(points.out_of_plane + p, stress[4]);
  T columns[dim * dim];
  for (int i = 0; i < dim; ++i)
    for (int k = 0; k < dim; ++k) columns[k * dim + i] = stress[i * dim + k];
  side_by_side<dim * dim>(columns, points.columns + dim * dim * p);

  const T flow = select(load<T>(points.plastic_rate + p) > T(0.0), load<T>(points.equivalent_stress + p),
                        load<T>(points.flow_stress + p));
  store(points.flow_stress + p, flow);
  const EdgePoints& edge = points.edge;
  if (!edge.record) return;
  // μ̃ = μ e/(e + ε̄p) with the elastic limit e = σ_y/3μ
  const T mu = load<T>(edge.shear_modulus + p), strain = load<T>(edge.plastic_strain + p);
  const T last = load<T>(edge.modulus + p);
  const T secant = select(strain > T(0.0), mu * flow / (flow + T(3.0) * mu * strain), last);
  store(edge.modulus_before + p, last);
  store(edge.modulus + p, secant);
  T record[dim * dim + 2];
  for (int i = 0; i < dim; ++i)
    for (int k = 0; k < dim; ++k) record[k * dim + i] = f[i * dim + k];
  record[dim * dim] = secant;
  record[dim * dim + 1] = last;
  side_by_side<dim * dim + 2>(record, edge.record + (dim * dim + 2) * p);
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
  template EdgeEnergy edge_defect<dim>(const LinkRows&, double, const double*, const double*, const double*, \
                                       const double*, double*, double* const*, std::ptrdiff_t,               \
                                       std::ptrdiff_t);                                                      \
  template ViscousSums viscous_stress<dim>(const ViscousPoints<dim>&, double, double, double,                \
                                           std::ptrdiff_t, std::ptrdiff_t);
CNEM_INSTANTIATE(2)
CNEM_INSTANTIATE(3)
#undef CNEM_INSTANTIATE

} // namespace cnem::CNEM_ISA
