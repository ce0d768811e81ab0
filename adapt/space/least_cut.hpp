#pragma once
// The least cut of a graph between two of its vertices.
#include <cstddef>
#include <vector>

namespace cnem::adapt {

/// An edge of a graph, that counts alike both ways.
struct GraphEdge {
  std::size_t from, to;
  double weight;
};

/// [vertex] whether it is on the side of the source once the links with the least sum of weights are cut that
/// parts it from the sink (Boykov and Kolmogorov, IEEE PAMI 26, 2004).
std::vector<char> side_of_least_cut(std::size_t vertices, const std::vector<GraphEdge>& links,
                                    std::size_t source, std::size_t sink);

} // namespace cnem::adapt
