#pragma once
// Which rigid body motions a set of supports leaves free.
#include "core/operators/operators.hpp"
#include "core/vec.hpp"
#include "mechanics/supports.hpp"

#include <string>
#include <vector>

namespace cnem {

/// Parts of the body as the smallest node of each, [node]: sets of nodes joined by stress points. `nodes`:
/// how many of the functions are those of nodes.
template<int dim>
std::vector<std::size_t> parts_of(const DiscreteOperators<dim>& operators, std::size_t nodes);

/// First rigid motion of a part of the body that nothing holds, in words with what to hold; empty when all
/// are held. A crack may cut a body in two. `position`: [node] m.
template<int dim>
std::string missing_support(const DiscreteOperators<dim>& operators, const std::vector<Vec<dim>>& position,
                            const Supports<dim>& supports);

} // namespace cnem
