#pragma once
// A range of stress points as packs (core/machine/simd.hpp), for the kernels of return maps.
#include "core/machine/simd.hpp"
#include "plasticity/stress_points.hpp"

namespace cnem::plasticity::CNEM_ISA {

using namespace ::cnem::CNEM_ISA;

namespace { // each kernel file has its own, whose types nobody else sees

#ifdef CNEM_ISA_baseline
constexpr int registers = 1;
#else
constexpr int registers = 2;
#endif
/// Two registers at a time in the plane; the rotations of space need too many.
template<int dim> using Points = Pack<dim == 2 ? registers : 1>;
template<int dim> inline constexpr int width = Number<Points<dim>>::width;

/// Whole packs and tails must run the very same instructions, or their bits could differ.
template<int dim, class Parameters, class Kernel>
CNEM_ONE_COPY Mask<Points<dim>> pack_step(const Parameters& parameters, const Kernel& kernel,
                                          const StressPoints<dim>& points, std::ptrdiff_t i) {
  return return_map_step<dim, Points<dim>>(parameters, kernel, points, i);
}

template<class M> int first_lane(M mask, int lanes) {
  for (int k = 0; k < lanes; ++k)
    if (lane(mask, k)) return k;
  return lanes;
}

template<int dim, class Visit> void for_each_input(StressPoints<dim>& points, Visit visit) {
  for (const double*& field : points.deformation) visit(field);
  visit(points.temperature);
  visit(points.strength);
  if (points.earlier_deformation[0])
    for (const double*& field : points.earlier_deformation) visit(field);
}

template<int dim, class Visit> void for_each_output(StressPoints<dim>& points, Visit visit) {
  for (double*& field : points.inverse_plastic_cauchy_green) visit(field);
  for (double*& field : points.piola) visit(field);
  double** const scalars[] = {&points.plastic_strain, &points.plastic_rate, &points.equivalent_stress,
                              &points.plastic_work,   &points.pressure,     &points.stored_energy,
                              &points.dissipation,    &points.stress_free};
  for (double** field : scalars) visit(*field);
}

/// Fewer than `width` points, through buffers padded with the last of them.
template<int dim, class Parameters, class Kernel>
Mask<Points<dim>> tail_step(const Parameters& parameters, const Kernel& kernel,
                            const StressPoints<dim>& points, std::ptrdiff_t begin, int count) {
  constexpr int fields = StressPoints<dim>::general * 3 + StressPoints<dim>::symmetric + 10;
  double buffer[fields][width<dim>];
  StressPoints<dim> local = points, target = points;
  int used = 0;
  const auto copy = [&](auto& field) {
    for (int k = 0; k < width<dim>; ++k) buffer[used][k] = field[begin + (k < count ? k : count - 1)];
    field = buffer[used++];
  };
  for_each_input(local, copy);
  const int first_output = used;
  for_each_output(local, copy);

  const auto bad = pack_step(parameters, kernel, local, 0);

  used = first_output;
  for_each_output(target, [&](double* field) {
    for (int k = 0; k < count; ++k) field[begin + k] = buffer[used][k];
    ++used;
  });
  return bad;
}

/// return_map_step(parameters, kernel, points, i) for all points of a range: whichever belongs to the type of
/// the parameters. Returns the first point that means nothing, or −1.
template<int dim, class Parameters, class Kernel>
std::ptrdiff_t update(const Parameters& parameters, const Kernel& kernel, const StressPoints<dim>& points,
                      std::ptrdiff_t begin, std::ptrdiff_t end) {
  std::ptrdiff_t first_bad = -1;
  for (std::ptrdiff_t i = begin; i < end; i += width<dim>) {
    const int count = end - i < width<dim> ? static_cast<int>(end - i) : width<dim>;
    const auto bad = count == width<dim> ? pack_step(parameters, kernel, points, i)
                                         : tail_step(parameters, kernel, points, i, count);
    if (any(bad) && first_bad < 0 && first_lane(bad, count) < count) first_bad = i + first_lane(bad, count);
  }
  return first_bad;
}

} // namespace

} // namespace cnem::plasticity::CNEM_ISA
