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

/// Four numbers of an edge record in one register.
using Quad [[gnu::vector_size(32)]] = double;
using UnalignedQuad [[gnu::vector_size(32), gnu::aligned(8), gnu::may_alias]] = double;

CNEM_INLINE Quad load_quad(const double* p) { return *reinterpret_cast<const UnalignedQuad*>(p); }
CNEM_INLINE Small<2> low(Quad a) { return {__builtin_shufflevector(a, a, 0, 1)}; }
CNEM_INLINE Small<2> high(Quad a) { return {__builtin_shufflevector(a, a, 2, 3)}; }

/// edge_defect in the plane, where a record is two registers and one cache line.
EdgeEnergy plane_edge_defect(const LinkRows& links, double alpha, const double* volume,
                             const double* position, const double* record, double* stress,
                             double* const* force, std::ptrdiff_t begin, std::ptrdiff_t end) {
  constexpr int stride = 8;
  auto energies = Small<2>::zero(); // now, before
  for (std::ptrdiff_t i = begin; i < end; ++i) {
    const double* own = record + stride * i;
    const Small<2> x = Small<2>::load(position + 2 * i);
    const Quad F = load_quad(own), rest = load_quad(own + 4) * Quad{1.0, 1.0, -1.0, -1.0};
    auto pull = Small<2>::zero();
    Quad moment = {};
    const std::int32_t last = links.begin[i + 1];
    for (std::int32_t e = links.begin[i]; e < last; ++e) {
      const auto j = static_cast<std::ptrdiff_t>(links.neighbour[e]);
      const double* other = record + stride * j;
      const Quad sum = load_quad(other + 4) + rest; // moduli, X_ij
      const Quad dX = __builtin_shufflevector(sum, sum, 2, 2, 3, 3);
      const Quad mean = (load_quad(other) + F) * dX;
      const Small<2> r = (Small<2>::load(position + 2 * j) - x) - (low(mean) + high(mean)) * 0.5;
      const Small<2> stiffness = low(sum) * links.weight[e];
      const Small<2> square = r * r;
      energies += stiffness * (square + swapped(square));
      const Small<2> tension = r * first(stiffness);
      pull += tension;
      moment += __builtin_shufflevector(tension.v, tension.v, 0, 1, 0, 1) * dX;
    }
    const double scale = 0.5 * alpha;
    const Quad share = moment * (Quad{scale, scale, scale, scale} * (0.5 / volume[i]));
    force[0][i] += pull[0] * scale;
    force[1][i] += pull[1] * scale;
    double* P = stress + 4 * i;
    (Small<2>::load(P) - low(share)).store(P);
    (Small<2>::load(P + 2) - high(share)).store(P + 2);
  }
  const Small<2> sum = energies * (0.5 * alpha);
  return {0.25 * sum[0], 0.25 * (sum[1] - sum[0])}; // ½ of ½ Σ k|r|²: every link is seen from both its ends
}

} // namespace

template<int dim>
EdgeEnergy edge_defect(const LinkRows& links, double alpha, const double* volume, const double* position,
                       const double* record, double* stress, double* const* force, std::ptrdiff_t begin,
                       std::ptrdiff_t end) {
  if constexpr (dim == 2)
    return plane_edge_defect(links, alpha, volume, position, record, stress, force, begin, end);
  constexpr int stride = edge_record<dim>, place = dim * dim + 2;
  double stored = 0.0, released = 0.0;
  for (std::ptrdiff_t i = begin; i < end; ++i) {
    const double* own = record + stride * i;
    const auto X = Small<dim>::load(own + place), x = Small<dim>::load(position + dim * i);
    Small<dim> F[dim], moment[dim];
    for (int k = 0; k < dim; ++k) {
      F[k] = Small<dim>::load(own + k * dim);
      moment[k] = Small<dim>::zero();
    }
    auto pull = Small<dim>::zero();
    for (std::int32_t e = links.begin[i]; e < links.begin[i + 1]; ++e) {
      const auto j = static_cast<std::ptrdiff_t>(links.neighbour[e]);
      const double* other = record + stride * j;
      const auto dX = Small<dim>::load(other + place) - X;
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

/// Stores n numbers of each point at the begin of its record.
template<int stride, int n> CNEM_INLINE void side_by_side(const double (&value)[n], double* record) {
  for (int c = 0; c < n; ++c) record[c] = value[c];
}
template<int stride, int n> CNEM_INLINE void side_by_side(const Pack<1> (&value)[n], double* record) {
  constexpr int width = Number<Pack<1>>::width;
  for (int c = 0; c + 1 < n; c += 2) {
    const auto even = even_pairs(value[c].v[0], value[c + 1].v[0]);
    const auto odd = odd_pairs(value[c].v[0], value[c + 1].v[0]);
    for (int lane = 0; lane < width; lane += 2) {
      Small<2>::of(even[lane], even[lane + 1]).store(record + stride * lane + c);
      Small<2>::of(odd[lane], odd[lane + 1]).store(record + stride * (lane + 1) + c);
    }
  }
  if constexpr (n % 2 == 1)
    for (int lane = 0; lane < width; ++lane) record[stride * lane + n - 1] = value[n - 1].v[0][lane];
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
    // ρ l c and l/c of the length l, in the plane √(V J) or of revolution √(V J/(2πr F_θθ)), and the speed
    // c = √(M/ρ), ρ = ρ0/J
    T mass = load<T>(points.density + p) * volume, impedance;
    if constexpr (dim == 2) {
      if (points.radius) mass = mass / (T(two_pi) * load<T>(points.radius + p) * f[general - 1]);
      impedance = sqrt(mass * modulus);
    } else {
      const T extent = volume * J;
      const T length = exp(log(extent) * T(1.0 / 3.0));
      impedance = length * sqrt(mass * modulus / extent);
    }
    const T share = T(linear) - T(quadratic) * rate * impedance * inverse[1];
    q = select(closing, -rate * impedance * share, T(0.0));
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

  if (!edge.record) return;
  const T last = load<T>(edge.modulus + p);
  const T secant = select(strained, mu * flow * inverse[2], last);
  store(edge.modulus_before + p, last);
  store(edge.modulus + p, secant);
  T record[dim * dim + 2];
  for (int i = 0; i < dim; ++i)
    for (int k = 0; k < dim; ++k) record[k * dim + i] = f[i * dim + k];
  record[dim * dim] = secant;
  record[dim * dim + 1] = last;
  side_by_side<edge_record<dim>>(record, edge.record + edge_record<dim> * p);
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
                                       double*, double* const*, std::ptrdiff_t, std::ptrdiff_t);             \
  template ViscousSums viscous_stress<dim>(const ViscousPoints<dim>&, double, double, double,                \
                                           std::ptrdiff_t, std::ptrdiff_t);
CNEM_INSTANTIATE(2)
CNEM_INSTANTIATE(3)
#undef CNEM_INSTANTIATE

} // namespace cnem::CNEM_ISA
