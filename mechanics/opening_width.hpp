#pragma once
// Over which width a discretisation spreads an opening between nodes.
#include "core/operators/operators.hpp"
#include "core/vec.hpp"

namespace cnem {

/// Width of the strip, m, of openings across a direction that the gradient at stress point p sees: of those
/// at n·x = c of which s(c) = Σ_J b_pJ·n over the nodes with n·x_J > c, the strain of a unit opening, is a
/// quarter at least of what p sees of any. Each point that sees an opening breaks by it in the end, so that
/// where matter lets go G/width per volume, breaking takes G per area in the mean over places c: Σ_p V_p
/// times the length of c that p sees, over its width, is the volume. Square and hexagonal lattices have two
/// spacings and triangles one. Of less the nodes between relieve a cell that is whole, as there are as many
/// nodes as cells (cells of moving least squares see 4% of openings beyond their neighbours).
///
/// Not so at Gauss points, of which there are more: each breaks a little by openings beside it. There the
/// width is 1/∫ s² dc, 1/width the mean of s over openings, each weighted with what p sees of it (∫ s dc =
/// 1). docs/theory.md, Plies.
///
/// x: [node] places side by side, m, in the configuration that the gradients are of. `gradient` is F₀ n and
/// `place` F₀⁻ᵀ n, for a unit vector n in another configuration, where the width is measured, and F₀ from
/// that to this one; both n where they are the same. Cost O(k log k) of k entries of the row.
double opening_width(const DiscreteOperators<2>& operators, const Field& x, std::size_t p,
                     const Vec2& gradient, const Vec2& place);

} // namespace cnem
