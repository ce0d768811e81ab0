#pragma once
// What faces of tools beside their corners bear of the edges that the corners meet.
#include "contact/surface.hpp"

namespace cnem::contact {

/// Where the face beside a ridge lies on the workpiece (the node before the edge touches it) it covers the
/// edge up to the ridge and presses on what it covers: evenly, so that the resultant is in the middle of that
/// part, along the normal of the face, and the gap is the mean over it: equal areas on both sides of the
/// face. Were the ridge to keep off the edge there, the node beyond it would have to go with the tool, and a
/// punch would bear as if it reached to that node. The ridge bears alone where a sheet bends over it, where
/// the edge is turned from the face by half of the ridge, and where it is no longer than the arc of a rounded
/// ridge. What was let in while the edge turned stays in: to push it out would be work from nothing. Changes
/// and drops `hits` that `ridge_hits` found in the same step. Nothing for tools in space.
template<int dim>
void share_with_faces(const Surface<dim>& surface, const ToolShape<dim>& shape, PlacesOnBoundary<dim> start,
                      PlacesOnBoundary<dim> end, const Vec<dim>& shift_start, const Vec<dim>& shift_end,
                      std::vector<RidgeHit<dim>>& hits);

} // namespace cnem::contact
