#include "mechanics/stable_step.hpp"

#include "core/parallel.hpp"
#include "core/vec.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

namespace cnem {

namespace {

/// F⁻¹ of point p, and det F including the out-of-plane component.
template<int dim> Mat<dim> inverse(const Fields<tensor_size<dim>>& deformation, std::size_t p, double& det) {
  Mat<dim> f;
  for (int i = 0; i < dim; ++i)
    for (int k = 0; k < dim; ++k) f(i, k) = deformation[static_cast<std::size_t>(i * dim + k)][p];
  det = f.determinant();
  const Mat<dim> inv = f.inverse();
  if constexpr (dim == 2) det *= deformation[4][p];
  return inv;
}

/// Norm of what a node does to a point: |b|, of revolution with the hoop entry h.
template<int dim> double block_norm(Vec<dim> b, double h) {
  const double squares = b.squaredNorm() + h * h;
  b[0] += h;
  return std::sqrt(std::max(b.squaredNorm(), squares));
}

} // namespace

template<int dim>
typename SpectralBound<dim>::Result SpectralBound<dim>::evaluate(const DiscreteOperators<dim>& operators,
                                                                 const Fields<tensor_size<dim>>& deformation,
                                                                 const Field& modulus, const Field& weight) {
  const auto nodes = static_cast<std::size_t>(operators.nodes),
             points = static_cast<std::size_t>(operators.points);
  const auto hoop = [&](const Field& entries, std::size_t e, std::size_t p) {
    return operators.of_revolution() ? entries[e] / deformation[4][p] : 0.0;
  };
  transfer_.resize(nodes);
  for_each_block(nodes, [&](std::size_t begin, std::size_t end) {
    for (std::size_t j = begin; j < end; ++j) {
      double sum = 0.0;
      for (auto e = static_cast<std::size_t>(operators.col_begin[j]);
           e < static_cast<std::size_t>(operators.col_begin[j + 1]); ++e) {
        double det;
        const Mat<dim> inv = inverse<dim>(deformation, static_cast<std::size_t>(operators.point[e]), det);
        Vec<dim> vb;
        for (int k = 0; k < dim; ++k) vb[k] = operators.weighted_gradient[static_cast<std::size_t>(k)][e];
        const double vh = hoop(operators.weighted_hoop, e, static_cast<std::size_t>(operators.point[e]));
        sum += det * block_norm<dim>(inv.transpose() * vb, vh);
      }
      transfer_[j] = sum / weight[j];
    }
  });
  const BlockMaximum worst = max_blocks(points, [&](std::size_t begin, std::size_t end) {
    BlockMaximum best{0.0, begin};
    for (std::size_t p = begin; p < end; ++p) {
      double det, sum = 0.0;
      const Mat<dim> inv = inverse<dim>(deformation, p, det);
      for (auto e = static_cast<std::size_t>(operators.row_begin[p]);
           e < static_cast<std::size_t>(operators.row_begin[p + 1]); ++e) {
        Vec<dim> b;
        for (int k = 0; k < dim; ++k) b[k] = operators.gradient[static_cast<std::size_t>(k)][e];
        sum += block_norm<dim>(inv.transpose() * b, hoop(operators.hoop, e, p)) *
               transfer_[static_cast<std::size_t>(operators.node[e])];
      }
      const double value = modulus[p] * sum;
      if (!(value <= best.value)) best = {value, p};
      if (std::isnan(value)) break;
    }
    return best;
  });
  return {worst.value, worst.index};
}

template<int dim>
StableStep stable_mechanical_step(SpectralBound<dim>& bound, const DiscreteOperators<dim>& operators,
                                  const Fields<tensor_size<dim>>& deformation, const Field& wave_modulus,
                                  const Field& mass, double stabilisation, double viscosity_ratio) {
  const auto worst = bound.evaluate(operators, deformation, wave_modulus, mass);
  const double omega2 = worst.value * (1.0 + stabilisation);
  if (omega2 == 0.0) return {std::numeric_limits<double>::infinity(), worst.point};
  const double damped = std::sqrt(1.0 + viscosity_ratio * viscosity_ratio) - viscosity_ratio;
  return {2.0 / std::sqrt(omega2) * damped, worst.point};
}

template class SpectralBound<2>;
template class SpectralBound<3>;
template StableStep stable_mechanical_step<2>(SpectralBound<2>&, const DiscreteOperators<2>&,
                                              const Fields<5>&, const Field&, const Field&, double, double);
template StableStep stable_mechanical_step<3>(SpectralBound<3>&, const DiscreteOperators<3>&,
                                              const Fields<9>&, const Field&, const Field&, double, double);

} // namespace cnem
