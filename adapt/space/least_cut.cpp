#include "adapt/space/least_cut.hpp"

#include <algorithm>
#include <boost/graph/boykov_kolmogorov_max_flow.hpp>
#include <boost/graph/compressed_sparse_row_graph.hpp>
#include <boost/range/iterator_range.hpp>
#include <numeric>
#include <utility>

namespace cnem::adapt {

std::vector<char> side_of_least_cut(std::size_t vertices, const std::vector<GraphEdge>& edges,
                                    std::size_t source, std::size_t sink) {
  const auto ends_of = [&](std::size_t e) { // each there and back
    const GraphEdge& edge = edges[e / 2];
    return e % 2 == 0 ? std::pair(edge.from, edge.to) : std::pair(edge.to, edge.from);
  };
  using Graph = boost::compressed_sparse_row_graph<boost::directedS, boost::no_property, boost::no_property,
                                                   boost::no_property, std::size_t, std::size_t>;
  std::vector<std::size_t> order(2 * edges.size()), place(2 * edges.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return ends_of(a).first < ends_of(b).first; });
  for (std::size_t e = 0; e < order.size(); ++e) place[order[e]] = e;
  std::vector<std::pair<std::size_t, std::size_t>> sorted;
  std::vector<double> sorted_capacity;
  for (const std::size_t e : order) {
    sorted.push_back(ends_of(e));
    sorted_capacity.push_back(edges[e / 2].weight);
  }
  const Graph graph(boost::edges_are_sorted, sorted.begin(), sorted.end(), vertices);
  std::vector<boost::graph_traits<Graph>::edge_descriptor> descriptor(sorted.size()), reverse(sorted.size());
  for (const auto e : boost::make_iterator_range(boost::edges(graph)))
    descriptor[boost::get(boost::edge_index, graph, e)] = e;
  for (std::size_t e = 0; e < order.size(); ++e) reverse[e] = descriptor[place[order[e] ^ 1]];
  std::vector<double> residual(sorted.size()), distance(vertices, 0.0);
  std::vector<boost::graph_traits<Graph>::edge_descriptor> predecessor(vertices);
  std::vector<boost::default_color_type> colour(vertices);
  const auto of_edge = boost::get(boost::edge_index, graph);
  const auto of_vertex = boost::get(boost::vertex_index, graph);
  boost::boykov_kolmogorov_max_flow(
      graph, boost::make_iterator_property_map(sorted_capacity.begin(), of_edge),
      boost::make_iterator_property_map(residual.begin(), of_edge),
      boost::make_iterator_property_map(reverse.begin(), of_edge),
      boost::make_iterator_property_map(predecessor.begin(), of_vertex),
      boost::make_iterator_property_map(colour.begin(), of_vertex),
      boost::make_iterator_property_map(distance.begin(), of_vertex), of_vertex, source, sink);
  std::vector<char> with_source(vertices);
  for (std::size_t v = 0; v < vertices; ++v) with_source[v] = colour[v] == colour[source];
  return with_source;
}

} // namespace cnem::adapt
