#include "core/small_vector.hpp"
#include "mechanics/failing_links.hpp"
#include "mechanics/step_kernels.hpp"

namespace cnem::CNEM_ISA {

namespace {

/// Four numbers of an edge record in one register.
using Quad [[gnu::vector_size(32)]] = double;
using UnalignedQuad [[gnu::vector_size(32), gnu::aligned(8), gnu::may_alias]] = double;

CNEM_INLINE Quad load_quad(const double* p) { return *reinterpret_cast<const UnalignedQuad*>(p); }
CNEM_INLINE Small<2> low(Quad a) { return {__builtin_shufflevector(a, a, 0, 1)}; }
CNEM_INLINE Small<2> high(Quad a) { return {__builtin_shufflevector(a, a, 2, 3)}; }

CNEM_INLINE Small<2> smaller(Small<2> a, Small<2> b) { return {a.v < b.v ? a.v : b.v}; }

/// edge_defect in the plane, where a record is two registers and one cache line.
template<bool failing>
EdgeEnergy plane_edge_defect(const LinkRows& links, double alpha, const double* volume,
                             const double* position, const double* record, double* stress,
                             double* const* force, std::ptrdiff_t begin, std::ptrdiff_t end) {
  constexpr int stride = EdgeRecord<2>::size;
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
      const Small<2> moduli = failing ? smaller(low(load_quad(other + 4)), low(rest)) * 2.0 : low(sum);
      const Small<2> stiffness = moduli * links.weight[e];
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

/// edge_defect in space, where a record is four registers: ½F with the moduli, and X. Every link is seen from
/// both its ends, so that Σ w (μ̃_i + μ̃_j) |r|² over all of them is 2 Σ_i μ̃_i Σ_j w |r|².
EdgeEnergy space_edge_defect(const LinkRows& links, double alpha, const double* volume,
                             const double* position, const double* record, double* stress,
                             double* const* force, std::ptrdiff_t begin, std::ptrdiff_t end) {
  using Record = EdgeRecord<3>;
  using Vector = Small<3>;
  const double scale = 0.5 * alpha;
  double stored = 0.0, released = 0.0;
  for (std::ptrdiff_t i = begin; i < end; ++i) {
    const double* own = record + Record::size * i;
    const Vector x = Vector::load(position + 4 * i), X = Vector::load(own + Record::place);
    const Vector F0 = Vector::load(own), F1 = Vector::load(own + 4), F2 = Vector::load(own + 8);
    Vector pull = Vector::zero(), moment0 = pull, moment1 = pull, moment2 = pull, squares = pull;
    const std::int32_t last = links.begin[i + 1];
    for (std::int32_t e = links.begin[i]; e < last; ++e) {
      const auto j = static_cast<std::ptrdiff_t>(links.neighbour[e]);
      const double* other = record + Record::size * j;
      const Vector dX = Vector::load(other + Record::place) - X;
      const Vector dX0 = dX.all<0>(), dX1 = dX.all<1>(), dX2 = dX.all<2>();
      const Vector mean0 = Vector::load(other) + F0;
      Vector r = Vector::load(position + 4 * j) - x;
      r -= mean0 * dX0;
      r -= (Vector::load(other + 4) + F1) * dX1;
      r -= (Vector::load(other + 8) + F2) * dX2;
      const Vector weighted = r * links.weight[e];
      squares += weighted * r;
      const Vector tension = weighted * mean0.all<3>(); // times μ̃_i + μ̃_j
      pull += tension;
      moment0 += tension * dX0;
      moment1 += tension * dX1;
      moment2 += tension * dX2;
    }
    const double sum = squares[0] + squares[1] + squares[2];
    stored += own[Record::modulus] * sum;
    released += (own[Record::modulus_before] - own[Record::modulus]) * sum;
    for (int k = 0; k < 3; ++k) force[k][i] += pull[k] * scale;
    const double share = scale * (0.5 / volume[i]);
    double* P = stress + column_stress<3> * i;
    (Vector::load(P) - moment0 * share).store(P);
    (Vector::load(P + 4) - moment1 * share).store(P + 4);
    (Vector::load(P + 8) - moment2 * share).store(P + 8);
  }
  return {0.5 * scale * stored, 0.5 * scale * released};
}

} // namespace

template<int dim>
EdgeEnergy edge_defect(const LinkRows& links, double alpha, const double* volume, const double* position,
                       const double* record, double* stress, double* const* force, std::ptrdiff_t begin,
                       std::ptrdiff_t end) {
  if constexpr (dim == 2)
    return plane_edge_defect<false>(links, alpha, volume, position, record, stress, force, begin, end);
  else
    return space_edge_defect(links, alpha, volume, position, record, stress, force, begin, end);
}

EdgeEnergy failing_edge_defect(const LinkRows& links, double alpha, const double* volume,
                               const double* position, const double* record, double* stress,
                               double* const* force, std::ptrdiff_t begin, std::ptrdiff_t end) {
  return plane_edge_defect<true>(links, alpha, volume, position, record, stress, force, begin, end);
}

#define CNEM_INSTANTIATE(dim)                                                                                \
  template EdgeEnergy edge_defect<dim>(const LinkRows&, double, const double*, const double*, const double*, \
                                       double*, double* const*, std::ptrdiff_t, std::ptrdiff_t);
CNEM_INSTANTIATE(2)
CNEM_INSTANTIATE(3)
#undef CNEM_INSTANTIATE

} // namespace cnem::CNEM_ISA
