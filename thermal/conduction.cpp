#include "thermal/conduction.hpp"

#include "core/parallel.hpp"
#include "core/vec.hpp"

#include <Eigen/LU>
#include <algorithm>

namespace cnem {

namespace {

template<int dim> struct Row {
  Mat<dim> deformation = Mat<dim>::Zero();
  Vec<dim> gradient = Vec<dim>::Zero(); ///< ∇_X T
  double hoop = 1.0;                    ///< r/R of revolution
};

template<int dim>
Row<dim> row_of(const DiscreteOperators<dim>& operators, const Fields<dim>& position,
                const double* temperature, std::size_t p) {
  Row<dim> row;
  if (operators.of_revolution()) row.hoop = 0.0;
  for (auto e = static_cast<std::size_t>(operators.row_begin[p]);
       e < static_cast<std::size_t>(operators.row_begin[p + 1]); ++e) {
    const auto j = static_cast<std::size_t>(operators.node[e]);
    if (operators.of_revolution()) row.hoop += operators.hoop[e] * position[0][j];
    for (int k = 0; k < dim; ++k) {
      const double b = operators.gradient[static_cast<std::size_t>(k)][e];
      if (temperature) row.gradient[k] += temperature[j] * b;
      for (int i = 0; i < dim; ++i) row.deformation(i, k) += position[static_cast<std::size_t>(i)][j] * b;
    }
  }
  return row;
}

} // namespace

template<int dim>
void Conduction<dim>::set_operators(const DiscreteOperators<dim>& operators, Field conductivity) {
  operators_ = &operators;
  conductivity_ = std::move(conductivity);
  resize_all(flux_, static_cast<std::size_t>(operators.points));
}

template<int dim>
void Conduction<dim>::add_flow(const Fields<dim>& position, const Field& temperature, Field& flow) {
  const DiscreteOperators<dim>& op = *operators_;
  for_each_block(static_cast<std::size_t>(op.points), [&](std::size_t begin, std::size_t end) {
    for (std::size_t p = begin; p < end; ++p) {
      const Row<dim> row = row_of<dim>(op, position, temperature.data(), p);
      const double det = row.deformation.determinant() * row.hoop;
      const Mat<dim> inverse = row.deformation.inverse();
      const Vec<dim> q = conductivity_[p] * det * (inverse * (inverse.transpose() * row.gradient));
      for (int k = 0; k < dim; ++k) flux_[static_cast<std::size_t>(k)][p] = q[k];
    }
  });
  for_each_block(static_cast<std::size_t>(op.nodes), [&](std::size_t begin, std::size_t end) {
    for (std::size_t j = begin; j < end; ++j) {
      double sum = 0.0;
      for (auto e = static_cast<std::size_t>(op.col_begin[j]);
           e < static_cast<std::size_t>(op.col_begin[j + 1]); ++e)
        for (std::size_t k = 0; k < dim; ++k)
          sum += flux_[k][static_cast<std::size_t>(op.point[e])] * op.weighted_gradient[k][e];
      flow[j] -= sum;
    }
  });
}

template<int dim>
double Conduction<dim>::fastest_decay(const Fields<dim>& position, const Field& heat_capacity) {
  const DiscreteOperators<dim>& op = *operators_;
  const auto points = static_cast<std::size_t>(op.points);
  transfer_.assign(static_cast<std::size_t>(op.nodes), 0.0);
  // The same Gershgorin bound as for waves, with b = F⁻ᵀ b_r and V = V_r det F (mechanics/stable_step.hpp).
  std::vector<double> norm(op.node.size());
  for (std::size_t p = 0; p < points; ++p) {
    const Row<dim> row = row_of<dim>(op, position, nullptr, p);
    const Mat<dim> inverse_transpose = row.deformation.inverse().transpose();
    const double volume = op.volume[p] * row.deformation.determinant() * row.hoop;
    for (auto e = static_cast<std::size_t>(op.row_begin[p]);
         e < static_cast<std::size_t>(op.row_begin[p + 1]); ++e) {
      Vec<dim> b;
      for (int k = 0; k < dim; ++k) b[k] = op.gradient[static_cast<std::size_t>(k)][e];
      norm[e] = (inverse_transpose * b).norm();
      transfer_[static_cast<std::size_t>(op.node[e])] += volume * conductivity_[p] * norm[e];
    }
  }
  double worst = 0.0;
  for (std::size_t p = 0; p < points; ++p) {
    double sum = 0.0;
    for (auto e = static_cast<std::size_t>(op.row_begin[p]);
         e < static_cast<std::size_t>(op.row_begin[p + 1]); ++e) {
      const auto j = static_cast<std::size_t>(op.node[e]);
      sum += norm[e] * transfer_[j] / heat_capacity[j];
    }
    worst = std::max(worst, sum);
  }
  return worst;
}

template class Conduction<2>;
template class Conduction<3>;

} // namespace cnem
