#include "adapt/space/working_body.hpp"

#include "voronoi/space/bodies.hpp"

#include <numeric>

namespace cnem::adapt {

void WorkingBody::drop(const IndexedVector<NodeIndex, char>& gone) {
  const IndexedVector<NodeIndex, NodeIndex> number = numbers_without(gone);
  Matter::drop(gone);
  compact(number, cloud_.position);
  if (!cloud_.body.empty()) compact(number, cloud_.body);
  for (auto& facet : cloud_.facets)
    for (NodeIndex& i : facet.node) i = number[i];
  std::erase_if(cloud_.twins, [&](const auto& pair) { return gone[pair[0]] || gone[pair[1]]; });
  for (auto& pair : cloud_.twins)
    for (NodeIndex& i : pair) i = number[i];
}

Resampling<3> WorkingBody::finish(const SpaceStructure& structure) const {
  Cloud<3> cloud = cloud_;
  cloud.body = voronoi::bodies_of(structure.mesh);
  cloud.simplices = structure.mesh.node;
  cloud.across = structure.mesh.neighbour;
  Resampling<3> change = Matter::finished(cloud);
  const bool renumbered = change.cloud.position != cloud_.position;
  if (structure.flipped && renumbered) change.cloud.simplices = {}, change.cloud.across = {};
  return change;
}

} // namespace cnem::adapt
