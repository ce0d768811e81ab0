#pragma once
// Over which width a discretisation spreads an opening between nodes.
#include "core/operators/operators.hpp"
#include "core/vec.hpp"

namespace cnem {

/// Width of the strip, m, over which the gradient at stress point p spreads an opening across a direction:
/// 1/∫ s(c)² dc, s(c) = Σ_J b_pJ·n over the nodes with n·x_J > c, which is the strain that p sees of a unit
/// opening at n·x = c. As ∫ s dc = 1, 1/width is the mean of s over openings, each weighted with what p sees
/// of it. Where a point sees the same of all openings that it sees, Σ V_p/width_p over the points that see
/// one is its area: cells of a square lattice (two spacings), triangles (one). docs/theory.md, Plies.
///
/// x: [node] places side by side, m, in the configuration that the gradients are of. `gradient` is F₀ n and
/// `place` F₀⁻ᵀ n, for a unit vector n in another configuration, where the width is measured, and F₀ from
/// that to this one; both n where they are the same. Cost O(k log k) of k entries of the row.
double opening_width(const DiscreteOperators<2>& operators, const Field& x, std::size_t p,
                     const Vec2& gradient, const Vec2& place);

} // namespace cnem
