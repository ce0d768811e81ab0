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

template<int dim> void transfer(const SpectralView<dim>& view, std::ptrdiff_t begin, std::ptrdiff_t end) {
  CNEM_ON_ACTIVE_ISA(spectral_transfer(view, begin, end));
}

template<int dim> void rows(const SpectralView<dim>& view, std::ptrdiff_t begin, std::ptrdiff_t end) {
  CNEM_ON_ACTIVE_ISA(spectral_rows(view, begin, end));
}

constexpr int first_iterations = 6, further_iterations = 3;
constexpr double grown = 1.05, jumped = 2.0; ///< times the bound when x was found
constexpr double least_share = 1e-200;       ///< of points that carry nothing, so that quotients exist

} // namespace

template<int dim>
SpectralView<dim> SpectralBound<dim>::prepare(const DiscreteOperators<dim>& operators,
                                              const Fields<tensor_size<dim>>& deformation,
                                              const Field& modulus, const Field& weight, const Field& share) {
  const auto nodes = index_of(operators.nodes), points = index_of(operators.points);
  inverse_.resize(SpectralView<dim>::stride * points);
  transfer_.resize(nodes);
  image_.resize(points);
  const bool round = operators.of_revolution();
  const SpectralView<dim> view{
      .rows = sparse_rows<dim>(operators.row_begin, operators.node, operators.gradient),
      .columns = sparse_rows<dim>(operators.col_begin, operators.point, operators.weighted_gradient),
      .hoop = round ? operators.hoop.data() : nullptr,
      .weighted_hoop = round ? operators.weighted_hoop.data() : nullptr,
      .modulus = modulus.data(),
      .weight = weight.data(),
      .share = share.data(),
      .inverse = inverse_.data(),
      .transfer = transfer_.data(),
      .image = image_.data()};
  for_each_block(points, [&](std::size_t begin, std::size_t end) {
    invert_all(pointers(deformation).data(), view, static_cast<std::ptrdiff_t>(begin),
               static_cast<std::ptrdiff_t>(end));
  });
  return view;
}

/// A x.
template<int dim>
void SpectralBound<dim>::map(const SpectralView<dim>& view, const Field& weight, const Ties<dim>& ties) {
  for_each_block(transfer_.size(), [&](std::size_t begin, std::size_t end) {
    transfer(view, static_cast<std::ptrdiff_t>(begin), static_cast<std::ptrdiff_t>(end));
  });
  ties.share(weight, transfer_);
  for_each_block(image_.size(), [&](std::size_t begin, std::size_t end) {
    rows(view, static_cast<std::ptrdiff_t>(begin), static_cast<std::ptrdiff_t>(end));
  });
}

template<int dim>
std::vector<typename SpectralBound<dim>::Result>
SpectralBound<dim>::of_ranges(const DiscreteOperators<dim>& operators,
                              const Fields<tensor_size<dim>>& deformation, const Field& modulus,
                              const Field& weight, std::size_t width, const Ties<dim>& ties) {
  const auto points = index_of(operators.points);
  const Field ones(points, 1.0);
  map(prepare(operators, deformation, modulus, weight, ones), weight, ties);
  std::vector<Result> ranges((points + width - 1) / width);
  for (std::size_t r = 0; r < ranges.size(); ++r) {
    ranges[r] = {0.0, r * width};
    for (std::size_t p = r * width; p < std::min((r + 1) * width, points); ++p) {
      if (!(image_[p] <= ranges[r].value)) ranges[r] = {image_[p], p};
      if (std::isnan(image_[p])) break; // whoever asked must see it
    }
  }
  return ranges;
}

template<int dim> typename SpectralBound<dim>::Result SpectralBound<dim>::largest_quotient() const {
  double value = 0.0;
  std::size_t point = 0;
  for (std::size_t p = 0; p < image_.size(); ++p) {
    if (std::isnan(image_[p])) return {image_[p], p}; // whoever asked must see it
    value = std::max(value, image_[p] / share_[p]);
    if (image_[p] > image_[point]) point = p;
  }
  return {value, point};
}

template<int dim>
typename SpectralBound<dim>::Result SpectralBound<dim>::of_all(const DiscreteOperators<dim>& operators,
                                                               const Fields<tensor_size<dim>>& deformation,
                                                               const Field& modulus, const Field& weight,
                                                               const Ties<dim>& ties) {
  const auto points = index_of(operators.points);
  const bool found = !share_.empty();
  if (!found) share_.assign(points, 1.0);
  const SpectralView<dim> view = prepare(operators, deformation, modulus, weight, share_);
  map(view, weight, ties);
  Result bound = largest_quotient();
  if (found && bound.value <= grown * settled_) return bound;
  const bool near = found && bound.value <= jumped * settled_;
  if (found && !near) {
    share_.assign(points, 1.0);
    map(view, weight, ties);
    bound = largest_quotient();
  }
  for (int iteration = 0; iteration < (near ? further_iterations : first_iterations); ++iteration) {
    const double scale = image_[bound.point];
    if (!(scale > 0.0)) break; // no stiffness at all, or no number
    for (std::size_t p = 0; p < points; ++p) share_[p] = std::max(image_[p] / scale, least_share);
    map(view, weight, ties);
    bound = largest_quotient();
  }
  settled_ = bound.value;
  return bound;
}

template<int dim> void SpectralBound<dim>::archive(Archive& archive) {
  std::size_t points = share_.size();
  archive.integer("solver/stable_step/points", points);
  share_.resize(points);
  archive.field("solver/stable_step/share", "1", share_);
  archive.number("solver/stable_step/bound", "1/s^2", settled_);
}

double damped_step(double damping) { return std::sqrt(1.0 + damping * damping) - damping; }
double damping_of_step(double share) { return 0.5 * (1.0 / share - share); }

double stable_wave_step(double bound, double stabilisation, double viscosity_ratio) {
  const double omega2 = bound * (1.0 + stabilisation);
  if (omega2 == 0.0) return std::numeric_limits<double>::infinity();
  return 2.0 / std::sqrt(omega2) * damped_step(viscosity_ratio);
}

template class SpectralBound<2>;
template class SpectralBound<3>;

} // namespace cnem
