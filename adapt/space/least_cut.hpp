#pragma once
// The least cut of a graph between two of its vertices.
#include <cstddef>
#include <vector>

namespace cnem::adapt {

/// An edge of a graph, that counts alike both ways.
struct GraphEdge {
  std::size_t from, to; ///< vertices
  double weight;        ///< not below zero, of any unit
};

/// [vertex] whether it is on the side of the source once the edges with the least sum of weights are cut that
/// part it from the sink; what neither reaches is not. Boykov and Kolmogorov, IEEE PAMI 26, 2004: nearly O(E)
/// for graphs as local as those of tetrahedra, though not at worst.
std::vector<char> side_of_least_cut(std::size_t vertices, const std::vector<GraphEdge>& edges,
                                    std::size_t source, std::size_t sink);

} // namespace cnem::adapt
