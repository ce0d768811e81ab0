#pragma once
// Which rigid body motions a set of supports leaves free.
#include "core/operators.hpp"
#include "core/vec.hpp"
#include "mechanics/supports.hpp"

#include <string>
#include <vector>

namespace cnem {

/// First rigid motion of a part of the body that nothing holds, in words with what to hold; empty when all
/// are held. Parts are sets of nodes joined by stress points: a crack may cut a body in two. `position`:
/// [node] m.
std::string missing_support(const DiscreteOperators<2>& operators, const std::vector<Vec2>& position,
                            const Supports<2>& supports);

} // namespace cnem
