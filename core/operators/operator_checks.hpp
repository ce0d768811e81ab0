#pragma once
// What must hold of operators whatever the method (core/operators/operators.hpp), for assertions: the
// contract suite tests it to rounding.
#include "core/indexed.hpp"
#include "core/operators/operators.hpp"
#include "core/vec.hpp"

namespace cnem {

/// Whether sizes fit, each row has more than `dim` nodes in increasing order, and volumes are positive. O(N).
template<int dim> bool rows_are_complete(const DiscreteOperators<dim>& op);

/// Whether constants have no gradient and positions (m) the identity: to 1e-9 of the terms of the
/// sums and the rounding of the positions. Points so thin that rounding decides, V < 1e-9 of the width of the
/// row to the power dim, are not looked at. O(N).
template<int dim>
bool reproduces_linear_fields(const DiscreteOperators<dim>& op,
                              const IndexedVector<NodeIndex, Vec<dim>>& position);

} // namespace cnem
