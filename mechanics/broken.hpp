#pragma once
// What is left of the strength of points, for those who part broken matter.
#include "core/fields/state.hpp"

namespace cnem {

/// [point] – the share of its strength that a point has lost, from 1 on it carries nothing: softening, of
/// plies the damage of the matrix over the largest there is (plasticity/failure.hpp). Empty where nothing
/// breaks.
template<int dim> Field lost_share(const PointState<dim>& point);

} // namespace cnem
