#pragma once
// Bulk viscosity: spreads shocks over a few cells.
#include "core/fields/state.hpp"
#include "core/operators/operators.hpp"
#include "mechanics/kinematics.hpp"
#include "mechanics/step_kernels.hpp"
#include "mechanics/ties.hpp"

namespace cnem {

/// q = ρ l (c₁ l tr²D − c₂ c_d tr D) where tr D < 0, else 0; c_d is the dilatational wave speed and l = s
/// V^{1/dim} of the current cell (of revolution √ of its meridian area), with the share s of
/// set_length_shares. Both coefficients zero switch it off.
struct BulkViscosity {
  double quadratic = 0.0; ///< c₁
  double linear = 0.0;    ///< c₂
};

/// [point] s = min(1, 2c_d/(ω V^{1/dim})) of a reference: the length l of a cell is not larger than that with
/// which ω = 2c_d/l is the frequency of a chain of such cells, ω² = c_d² ρ V max_n Σ_J w_J (b_J·n)²/M_J with
/// unit vectors n and w_J = min(2, Σ_q V_q |b_qJ|²/(V |b_J|²)): twice what a cell has alone, where its nodes
/// have neighbours. `mass` (kg/m^(3−dim)) is that of inertia; tied nodes add theirs up. It is 1 but in flat
/// cells and beside much smaller ones, whose nodes would be damped by more than ξ, which the step is made for
/// (docs/theory.md).
template<int dim>
void set_length_shares(const DiscreteOperators<dim>& operators, const Field& density, const Field& mass,
                       const Ties<dim>& ties, Field& length_share);

/// Writes P − q J F⁻ᵀ of the points [begin, end) to `total`, P from the stress in `point`, and returns what q
/// dissipated in the step, J/m^(3−dim), and the largest share of critical damping ξ = c₂ + c₁ l |tr D|/c_d,
/// which shortens the stable step. The point's `jacobian` and `viscous_pressure` hold det F and q of the step
/// before and are brought up to date, as are its flow stress and the `edge` records.
template<int dim>
ViscousSums add_bulk_viscosity(const BulkViscosity& viscosity, const DiscreteOperators<dim>& operators,
                               const Field& length_share, PointState<dim>& point, double dt,
                               const EdgePoints& edge, ColumnStress<dim>& total, std::size_t begin,
                               std::size_t end);

} // namespace cnem
