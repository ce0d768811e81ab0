#pragma once
// How far nodes stay off rounded edges of tools, so that chords between them and arcs enclose equal areas.
#include "contact/surface.hpp"

namespace cnem::contact {

/// m, from a boundary node towards the tool: the part of the way to it that is no gap. Chords between nodes
/// on a convex arc of radius r cut l³/12r off the tool; nodes that stay off it by l²/12r make that the area
/// between chords and arc outside the tool. Of what a chord cuts each end takes ∫κ x (l − x)/2 N_a dx over
/// the part that faces the arc (κ = 1/r, x from one end), so that the offset changes with continuous slope as
/// an edge slides on to the arc and off it. A chord with an end that is off the tool by more than l²/6r
/// counts less, by four times that not at all; one that is longer than the whole arc meets it as a corner
/// (Ridge::sharpness). shift: of the tool, m. Zero for tools in space.
template<int dim>
Vec<dim> arc_offset(const Surface<dim>& surface, const ToolShape<dim>& shape, BoundaryNodeIndex node,
                    PlacesOnBoundary<dim> position, const Vec<dim>& shift);

} // namespace cnem::contact
