#pragma once
// What triangles take of others that covered the same domain: how history goes over between triangulations.
#include "core/geometry/cloud.hpp"
#include "core/geometry/revolution.hpp"
#include "core/operators/parcels.hpp"
#include "voronoi/linear_simplices.hpp"

#include <span>

namespace cnem::voronoi {

/// Of two triangulations of one domain with the same nodes: row t of `now` over the triangles of `old` with
/// the fractions of their area (of revolution of the volume of their rings) that t covers, in increasing
/// order, Σ_t f_tk = 1. Triangles that are in both have the row {itself, 1}. Only what is not in both is cut,
/// found along edges of old triangles, so that nothing passes a wall, whose two faces have their own nodes.
/// Corners may stand in any order. O(nodes + triangles), the same for any number of threads. Throws
/// GeometryError, with a position, where the two do not cover each other.
SourceRows<SimplexIndex> overlaps(const IndexedVector<NodeIndex, Vec2>& position,
                                  std::span<const Simplex<2>> old, std::span<const Simplex<2>> now,
                                  Space space = Space::plane);

} // namespace cnem::voronoi
