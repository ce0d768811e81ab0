#include "clouds/generate.hpp"
#include "core/index.hpp"

#include "clouds/generate_boundary.hpp"
#include "clouds/generate_interior.hpp"
#include "clouds/generate_list.hpp"
#include "core/geometry/place_text.hpp"
#include "voronoi/order.hpp"
#include "voronoi/plane/edge_tree.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>

namespace cnem::clouds {

namespace {

void check_options(const SpacingField& spacing, const CloudOptions& options) {
  if (options.pattern == Pattern::list) {
    if (options.nodes.size() < 3)
      throw GeometryError(
          fmt::format("the node list has {} nodes; expected at least 3", options.nodes.size()));
    return;
  }
  spacing.check();
  if (options.pattern == Pattern::jittered && !(options.jitter >= 0.0 && options.jitter <= 0.4))
    throw SpacingError(fmt::format("the jitter is {}; expected a number in [0, 0.4]", options.jitter));
  if (options.pattern == Pattern::regular && !spacing.uniform())
    throw SpacingError(
        "the regular pattern has one spacing everywhere; expected no refinements, or the pattern "
        "hexagonal or jittered");
}

void check_count(const DomainShape& domain, const SpacingField& spacing, const CloudOptions& options) {
  const double nodes = estimate_nodes(domain, spacing, options);
  if (nodes <= options.nodes_limit) return;
  throw SpacingError(
      fmt::format("a spacing of {:.3g} m (finest {:.3g} m) makes about {:.2g} nodes or more in "
                  "this domain; expected at most {:.2g}",
                  spacing.spacing, spacing.finest(), nodes, options.nodes_limit));
}

/// Edges of the boundary that are much shorter than the spacing: one warning per piece, about the worst.
void warn_of_short_edges(const Cloud<2>& cloud, const SpacingField& spacing,
                         std::vector<std::string>& warnings) {
  struct Worst {
    double ratio = 0.4;
    double length = 0.0;
    Vec2 where{0, 0};
  };
  std::map<PieceIndex, Worst> worst;
  for (const Facet<2>& f : cloud.facets) {
    const Vec2 a = cloud.position[f.node[0]], b = cloud.position[f.node[1]];
    const double length = (b - a).norm(), ratio = length / spacing.at(0.5 * (a + b));
    if (ratio < Worst{}.ratio && ratio < worst[f.piece].ratio)
      worst[f.piece] = {ratio, length, 0.5 * (a + b)};
  }
  for (const auto& [piece, edge] : worst)
    warnings.push_back(
        fmt::format("boundary piece '{}' has an edge of {:.3g} m near {}, where the spacing is "
                    "{:.3g} m: refine there, or the stable step suffers",
                    cloud.piece_names[piece], edge.length, place_text(edge.where), spacing.at(edge.where)));
}

/// Arcs that are so few chords that the body is another one.
void warn_of_coarse_arcs(const DomainShape& shape, const Cloud<2>& cloud,
                         std::vector<std::string>& warnings) {
  double area = std::abs(shape.outer.area()), enclosed = 0.0;
  for (const Curve& hole : shape.holes) area -= std::abs(hole.area());
  for (const Facet<2>& f : cloud.facets)
    enclosed += 0.5 * cross(cloud.position[f.node[0]], cloud.position[f.node[1]]);
  const double change = enclosed / area - 1.0;
  if (std::abs(change) < 0.01) return;
  warnings.push_back(
      fmt::format("the nodes on the boundary enclose {:.4g} m², {:.2g}% {} than the domain: its "
                  "arcs are few chords; refine along them",
                  enclosed, 100.0 * std::abs(change), change < 0.0 ? "less" : "more"));
}

void warn_of_necks(const Necks& necks, std::vector<std::string>& warnings) {
  if (necks.pairs > 0)
    warnings.push_back(
        fmt::format("the domain is only {:.3g} m wide near {}: no node lies between its two sides "
                    "(so at {} pairs of boundary nodes); refine there",
                    necks.width, place_text(necks.where), necks.pairs));
}

Cloud<2> listed(const DomainShape& domain, const CloudOptions& options) {
  Cloud<2> cloud = assemble_boundary(list_boundary(domain, options.nodes));
  std::vector<bool> on_boundary(index_of(cloud.nodes()), false);
  for (const Facet<2>& f : cloud.facets) on_boundary[index_of(f.node[0])] = true;
  const voronoi::EdgeTree tree(cloud);
  for (std::size_t k = 0; k < options.nodes.size(); ++k)
    if (!on_boundary[k] && !tree.inside(options.nodes[k]))
      throw GeometryError(fmt::format(
          "node {} of the list at {} lies outside the domain; expected nodes in or on the polygon "
          "through the nodes on the boundary",
          k, place_text(options.nodes[k])));
  return cloud;
}

} // namespace

GeneratedCloud generate_cloud(const DomainShape& domain, const SpacingField& spacing,
                              const CloudOptions& options) {
  check_options(spacing, options);
  const DomainShape shape = checked_and_oriented(domain);
  check_holes(shape);
  GeneratedCloud result;
  if (options.pattern == Pattern::list) {
    result.cloud = listed(shape, options);
    warn_of_necks(find_necks(result.cloud, voronoi::triangulate(result.cloud)), result.warnings);
    return result;
  }
  check_count(shape, spacing, options);
  const DomainShape without_cracks{shape.outer, shape.holes, {}};
  if (!shape.cracks.empty())
    check_cracks(shape, spacing, assemble_boundary(discretise_boundary(without_cracks, spacing)));
  Cloud<2> cloud = assemble_boundary(discretise_boundary(shape, spacing));
  voronoi::triangulate(cloud); // loops that cross are reported before anything relies on them
  warn_of_short_edges(cloud, spacing, result.warnings);
  warn_of_coarse_arcs(shape, cloud, result.warnings);

  const voronoi::EdgeTree tree(cloud);
  std::vector<Vec2> interior = spacing.uniform()
                                   ? lattice_nodes(cloud, tree, spacing.spacing, options.pattern)
                                   : front_nodes(cloud, tree, spacing);
  warn_of_necks(smooth_nodes(cloud, tree, spacing, interior), result.warnings);
  if (options.pattern == Pattern::jittered)
    jitter_nodes(tree, spacing, options.jitter, options.seed, interior);
  cloud.position.insert(cloud.position.end(), interior.begin(), interior.end());
  result.cloud = voronoi::renumber(cloud, voronoi::hilbert_order(cloud.position));
  return result;
}

} // namespace cnem::clouds
