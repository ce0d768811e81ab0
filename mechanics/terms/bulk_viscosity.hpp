#pragma once
// Bulk viscosity: spreads shocks over a few cells.
#include "core/fields/state.hpp"
#include "core/operators/operators.hpp"
#include "mechanics/kinematics.hpp"
#include "mechanics/step_kernels.hpp"

namespace cnem {

/// q = ρ l (c₁ l tr²D − c₂ c_d tr D) where tr D < 0, else 0; l = V^{1/dim} of the current cell (of
/// revolution √ of its meridian area), c_d the
/// dilatational wave speed. Both coefficients zero switch it off.
struct BulkViscosity {
  double quadratic = 0.0; ///< c₁
  double linear = 0.0;    ///< c₂
};

/// Writes P − q J F⁻ᵀ of the points [begin, end) to `total`, P from the stress in `point`, and returns what q
/// dissipated in the step, J/m^(3−dim), and the largest share of critical damping ξ = c₂ + c₁ l |tr D|/c_d,
/// which shortens the stable step. The point's `jacobian` and `viscous_pressure` hold det F and q of the step
/// before and are brought up to date, as are its flow stress and the `edge` records.
template<int dim>
ViscousSums add_bulk_viscosity(const BulkViscosity& viscosity, const DiscreteOperators<dim>& operators,
                               PointState<dim>& point, double dt, const EdgePoints& edge,
                               ColumnStress<dim>& total, std::size_t begin, std::size_t end);

} // namespace cnem
