#include "clouds/space/generate.hpp"

#include "clouds/space/facet_tree.hpp"
#include "clouds/space/interior.hpp"
#include "clouds/space/repeat.hpp"
#include "clouds/space/surface.hpp"
#include "core/geometry/facets.hpp"
#include "core/geometry/place_text.hpp"
#include "core/index.hpp"
#include "voronoi/order.hpp"
#include "voronoi/space/surface_flips.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>

namespace cnem::clouds {

namespace {

void check_count(const SpaceDomain& domain, const SpaceSpacing& spacing, double nodes_limit) {
  const double nodes = estimate_nodes(domain, spacing, nodes_limit);
  if (nodes > nodes_limit)
    throw SpacingError(
        fmt::format("a spacing of {:.3g} m (finest {:.3g} m) makes about {:.2g} nodes or more in this "
                    "domain; expected at most {:.2g}",
                    spacing.spacing, spacing.finest(), nodes, nodes_limit));
}

/// Edges of the surface that are much shorter than the spacing: one warning per piece, about the worst.
void warn_of_short_edges(const Cloud<3>& cloud, const SpaceSpacing& spacing,
                         std::vector<std::string>& warnings) {
  struct Worst {
    double ratio = 0.35, length = 0.0;
    Vec3 where{0, 0, 0};
  };
  std::map<PieceIndex, Worst> worst;
  for (const Facet<3>& f : cloud.facets)
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 &a = cloud.position[f.node[k]], &b = cloud.position[f.node[(k + 1) % 3]];
      const double length = (b - a).norm(), ratio = length / spacing.at(0.5 * (a + b));
      if (ratio < Worst{}.ratio && ratio < worst[f.piece].ratio)
        worst[f.piece] = {ratio, length, 0.5 * (a + b)};
    }
  for (const auto& [piece, edge] : worst)
    warnings.push_back(
        fmt::format("boundary piece '{}' has an edge of {:.3g} m near {}, where the spacing is {:.3g} m: "
                    "refine there, or the stable step suffers",
                    cloud.piece_names[piece], edge.length, place_text(edge.where), spacing.at(edge.where)));
}

/// Round faces that are so few triangles that the body is another one.
void warn_of_coarse_faces(const SpaceDomain& domain, const Cloud<3>& surface,
                          std::vector<std::string>& warnings) {
  const double enclosed = enclosed_measure(surface), change = enclosed / domain_volume(domain) - 1.0;
  if (std::abs(change) < 0.02) return;
  warnings.push_back(fmt::format("the triangles of the boundary enclose {:.4g} m³, {:.2g}% {} than the "
                                 "domain: its round faces are few triangles; refine along them",
                                 enclosed, 100.0 * std::abs(change), change < 0.0 ? "less" : "more"));
}

/// Where the body is so thin that hardly a node has room inside.
void warn_of_thin_bodies(const Cloud<3>& surface, std::size_t inner, std::vector<std::string>& warnings) {
  if (20 * inner > surface.position.size()) return;
  warnings.push_back(
      fmt::format("{} nodes stand on the boundary and only {} inside: the domain is hardly two "
                  "spacings thick; refine",
                  surface.position.size(), inner));
}

} // namespace

GeneratedSpaceCloud generate_cloud(const SpaceDomain& domain, const SpaceSpacing& spacing, double nodes_limit,
                                   std::span<const std::array<std::string, 2>> periods) {
  check_count(domain, spacing, nodes_limit);
  GeneratedSpaceCloud result;
  Cloud<3> cloud = surface_of(domain, spacing);
  voronoi::flip_surface(cloud, flat_angle);
  for (const auto& pieces : periods) repeat_piece(cloud, pieces, spacing);
  warn_of_short_edges(cloud, spacing, result.warnings);
  warn_of_coarse_faces(domain, cloud, result.warnings);
  const FacetTree tree(cloud);
  const Room room{tree};
  std::vector<Vec3> interior =
      spacing.uniform() ? lattice_nodes(cloud, room, spacing.spacing) : front_nodes(cloud, room, spacing);
  smooth_nodes(cloud, room, spacing, interior);
  warn_of_thin_bodies(cloud, interior.size(), result.warnings);
  cloud.position.insert(cloud.position.end(), interior.begin(), interior.end());
  result.cloud = voronoi::renumber(cloud, voronoi::hilbert_order(cloud.position));
  return result;
}

} // namespace cnem::clouds
