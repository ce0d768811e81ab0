#include "clouds/space/generate.hpp"

#include "clouds/space/facet_tree.hpp"
#include "clouds/space/interior.hpp"
#include "clouds/space/surface.hpp"
#include "core/geometry/place_text.hpp"
#include "core/index.hpp"
#include "voronoi/order.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace cnem::clouds {

namespace {

Cloud<3> surface_of(const SpaceDomain& domain, const SpaceSpacing& spacing) {
  return std::visit(
      [&](const auto& shape) {
        using Shape = std::decay_t<decltype(shape)>;
        if constexpr (std::is_same_v<Shape, Extrusion>)
          return extruded_surface(shape, spacing);
        else if constexpr (std::is_same_v<Shape, Revolution>)
          return revolved_surface(shape, spacing);
        else
          return Cloud<3>{};
      },
      domain);
}

} // namespace

GeneratedSpaceCloud generate_cloud(const SpaceDomain& domain, const SpaceSpacing& spacing,
                                   double nodes_limit) {
  spacing.check();
  (void)nodes_limit;
  GeneratedSpaceCloud result;
  Cloud<3> cloud = surface_of(domain, spacing);
  const FacetTree tree(cloud);
  const Room room{tree};
  std::vector<Vec3> interior =
      spacing.uniform() ? lattice_nodes(cloud, room, spacing.spacing) : front_nodes(cloud, room, spacing);
  smooth_nodes(cloud, room, spacing, interior);
  cloud.position.insert(cloud.position.end(), interior.begin(), interior.end());
  result.cloud = voronoi::renumber(cloud, voronoi::hilbert_order(cloud.position));
  return result;
}

} // namespace cnem::clouds
