#include "mechanics/stable_step.hpp"

#include "core/index.hpp"
#include "core/machine/isa.hpp"
#include "core/machine/parallel.hpp"
#include "core/operators/side_by_side.hpp"
#include "mechanics/step_kernels.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cnem {

namespace {

template<int dim>
void invert_all(const double* const* deformation, const SpectralView<dim>& view, std::ptrdiff_t begin,
                std::ptrdiff_t end) {
  CNEM_ON_ACTIVE_ISA(invert(deformation, view, begin, end));
}

template<int dim>
void transfer(const SpectralView<dim>& view, const double* weight, std::ptrdiff_t begin, std::ptrdiff_t end) {
  CNEM_ON_ACTIVE_ISA(spectral_transfer(view, weight, begin, end));
}

template<int dim>
SpectralMaximum largest(const SpectralView<dim>& view, const double* modulus, std::ptrdiff_t begin,
                        std::ptrdiff_t end) {
  CNEM_ON_ACTIVE_ISA(spectral_rows(view, modulus, begin, end));
}

} // namespace

namespace {

template<int dim>
SpectralView<dim> view_of(const DiscreteOperators<dim>& operators, Field& inverse, Field& transfer) {
  const bool round = operators.of_revolution();
  return {.rows = sparse_rows<dim>(operators.row_begin, operators.node, operators.gradient),
          .columns = sparse_rows<dim>(operators.col_begin, operators.point, operators.weighted_gradient),
          .hoop = round ? operators.hoop.data() : nullptr,
          .weighted_hoop = round ? operators.weighted_hoop.data() : nullptr,
          .inverse = inverse.data(),
          .transfer = transfer.data()};
}

} // namespace

template<int dim>
void SpectralBound<dim>::prepare(const DiscreteOperators<dim>& operators,
                                 const Fields<tensor_size<dim>>& deformation, const Field& weight) {
  const auto nodes = index_of(operators.nodes), points = index_of(operators.points);
  inverse_.resize(SpectralView<dim>::stride * points);
  transfer_.resize(nodes);
  const SpectralView<dim> view = view_of(operators, inverse_, transfer_);
  for_each_block(points, [&](std::size_t begin, std::size_t end) {
    invert_all(pointers(deformation).data(), view, static_cast<std::ptrdiff_t>(begin),
               static_cast<std::ptrdiff_t>(end));
  });
  for_each_block(nodes, [&](std::size_t begin, std::size_t end) {
    transfer(view, weight.data(), static_cast<std::ptrdiff_t>(begin), static_cast<std::ptrdiff_t>(end));
  });
}

template<int dim>
std::vector<typename SpectralBound<dim>::Result>
SpectralBound<dim>::evaluate(const DiscreteOperators<dim>& operators,
                             const Fields<tensor_size<dim>>& deformation, const Field& modulus,
                             const Field& weight, std::size_t width) {
  prepare(operators, deformation, weight);
  const SpectralView<dim> view = view_of(operators, inverse_, transfer_);
  const auto points = index_of(operators.points);
  std::vector<Result> ranges((points + width - 1) / width);
  for_each_block(points, [&](std::size_t first, std::size_t last) {
    for (std::size_t begin = first; begin < last; begin += width) {
      const SpectralMaximum most = largest(view, modulus.data(), static_cast<std::ptrdiff_t>(begin),
                                           static_cast<std::ptrdiff_t>(std::min(begin + width, last)));
      ranges[begin / width] = {most.value, index_of(most.point)};
    }
  });
  return ranges;
}

double stable_wave_step(double bound, double stabilisation, double viscosity_ratio) {
  const double omega2 = bound * (1.0 + stabilisation);
  if (omega2 == 0.0) return std::numeric_limits<double>::infinity();
  const double damped = std::sqrt(1.0 + viscosity_ratio * viscosity_ratio) - viscosity_ratio;
  return 2.0 / std::sqrt(omega2) * damped;
}

template class SpectralBound<2>;
template class SpectralBound<3>;

} // namespace cnem
