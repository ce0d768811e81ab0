#pragma once
// Interior nodes of a cloud: lattices, growing fronts, smoothing.
#include "clouds/generate.hpp"
#include "voronoi/plane/edge_tree.hpp"
#include "voronoi/plane/triangulation.hpp"

namespace cnem::clouds {

/// The nodes of a square or hexagonal lattice with spacing h, fitted to the bounding box of the boundary,
/// that lie inside and keep about half a spacing from it.
std::vector<Vec2> lattice_nodes(const Cloud<2>& boundary, const voronoi::EdgeTree& tree, double h,
                                Pattern pattern);

/// Nodes at distances of about h(x) from each other and from the boundary nodes, placed by a front that
/// grows from the boundary inwards. O(N).
std::vector<Vec2> front_nodes(const Cloud<2>& boundary, const voronoi::EdgeTree& tree,
                              const SpacingField& spacing);

/// Pairs of boundary nodes on two sides of the domain that are neighbours, with no node between them.
struct Necks {
  int pairs = 0;
  double width = 0.0; ///< distance of the closest pair, m
  Vec2 where{0, 0};   ///< middle of the closest pair
};

Necks find_necks(const Cloud<2>& cloud, const voronoi::Triangulation& mesh);

/// Moves interior nodes towards the centroids of their Voronoi cells with density h⁻⁴ (Lloyd's iteration),
/// fills holes and thins crowds, so that distances follow h(x). With a uniform spacing, only nodes within
/// 2.55 h of the boundary are touched. Returns what is left without a node between its sides.
Necks smooth_nodes(const Cloud<2>& boundary, const voronoi::EdgeTree& tree, const SpacingField& spacing,
                   std::vector<Vec2>& interior);

/// Moves each interior node by a random vector of length up to `jitter` h(x), less near the boundary. The
/// same seed gives the same moves everywhere.
void jitter_nodes(const voronoi::EdgeTree& tree, const SpacingField& spacing, double jitter,
                  std::uint64_t seed, std::vector<Vec2>& interior);

} // namespace cnem::clouds
