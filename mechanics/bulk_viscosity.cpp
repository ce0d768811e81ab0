#include "mechanics/bulk_viscosity.hpp"

#include "core/vec.hpp"
#include "mechanics/kinematics.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace cnem {

template<int dim>
ViscousBlock add_bulk_viscosity(const BulkViscosity& viscosity, const DiscreteOperators<dim>& operators,
                                const Fields<tensor_size<dim>>& deformation, const Field& density,
                                const Field& wave_modulus, double dt, Field& jacobian_before, Field& pressure,
                                Fields<tensor_size<dim>>& total, std::size_t begin, std::size_t end) {
  ViscousBlock block;
  for (std::size_t p = begin; p < end; ++p) {
    const double J = jacobian<dim>(deformation, p), J0 = jacobian_before[p];
    const double rate = 2.0 * (J - J0) / ((J + J0) * dt);
    double q = 0.0;
    if (rate < 0.0) {
      const double rho = density[p] / J;
      double volume = operators.volume[p] * J;
      if (operators.of_revolution())
        volume /= 2.0 * std::numbers::pi * operators.radius[p] * deformation[4][p];
      const double length = dim == 2 ? std::sqrt(volume) : std::cbrt(volume);
      const double speed = std::sqrt(wave_modulus[p] / rho);
      const double damping = viscosity.linear - viscosity.quadratic * length * rate / speed;
      block.damping = std::max(block.damping, damping);
      q = -rho * length * rate * speed * damping;
      Mat<dim> f;
      for (int i = 0; i < dim; ++i)
        for (int k = 0; k < dim; ++k) f(i, k) = deformation[static_cast<std::size_t>(i * dim + k)][p];
      const Mat<dim> cofactor = J * f.inverse().transpose();
      for (int i = 0; i < dim; ++i)
        for (int k = 0; k < dim; ++k) total[static_cast<std::size_t>(i * dim + k)][p] -= q * cofactor(i, k);
      if constexpr (dim == 2) total[4][p] -= q * J / deformation[4][p];
    }
    block.dissipated -= 0.5 * (pressure[p] + q) * operators.volume[p] * (J - J0);
    pressure[p] = q;
    jacobian_before[p] = J;
  }
  return block;
}

template ViscousBlock add_bulk_viscosity<2>(const BulkViscosity&, const DiscreteOperators<2>&,
                                            const Fields<5>&, const Field&, const Field&, double, Field&,
                                            Field&, Fields<5>&, std::size_t, std::size_t);
template ViscousBlock add_bulk_viscosity<3>(const BulkViscosity&, const DiscreteOperators<3>&,
                                            const Fields<9>&, const Field&, const Field&, double, Field&,
                                            Field&, Fields<9>&, std::size_t, std::size_t);

} // namespace cnem
