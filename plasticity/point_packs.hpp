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

/// Fewer than `width` points, in buffers padded with the last of them. One copy for all laws: it takes longer
/// to compile than to run.
template<int dim> class PaddedPoints {
public:
  CNEM_ONE_COPY PaddedPoints(const StressPoints<dim>& points, std::ptrdiff_t begin, int count)
      : local_(points) {
    const auto copy = [&](auto& field) {
      for (int k = 0; k < width<dim>; ++k) buffer_[used_][k] = field[begin + (k < count ? k : count - 1)];
      field = buffer_[used_++];
    };
    for_each_input(local_, copy);
    first_output_ = used_;
    for_each_output(local_, copy);
  }

  const StressPoints<dim>& padded() const { return local_; }

  CNEM_ONE_COPY void write(StressPoints<dim> target, std::ptrdiff_t begin, int count) const {
    int used = first_output_;
    for_each_output(target, [&](double* field) {
      for (int k = 0; k < count; ++k) field[begin + k] = buffer_[used][k];
      ++used;
    });
  }

private:
  static constexpr int fields = StressPoints<dim>::general * 3 + StressPoints<dim>::symmetric + 10;
  double buffer_[fields][width<dim>];
  StressPoints<dim> local_;
  int used_ = 0, first_output_ = 0;
};

/// return_map_step(parameters, kernel, points, i) for all points of a range: whichever belongs to the type of
/// the parameters. Returns the first point that means nothing, or −1.
template<int dim, class Parameters, class Kernel>
std::ptrdiff_t update(const Parameters& parameters, const Kernel& kernel, const StressPoints<dim>& points,
                      std::ptrdiff_t begin, std::ptrdiff_t end) {
  std::ptrdiff_t first_bad = -1;
  for (std::ptrdiff_t i = begin; i < end; i += width<dim>) {
    const int count = end - i < width<dim> ? static_cast<int>(end - i) : width<dim>;
    Mask<Points<dim>> bad;
    if (count == width<dim>) {
      bad = pack_step(parameters, kernel, points, i);
    } else {
      const PaddedPoints<dim> tail(points, i, count);
      bad = pack_step(parameters, kernel, tail.padded(), 0);
      tail.write(points, i, count);
    }
    if (any(bad) && first_bad < 0 && first_lane(bad, count) < count) first_bad = i + first_lane(bad, count);
  }
  return first_bad;
}

} // namespace

} // namespace cnem::plasticity::CNEM_ISA
