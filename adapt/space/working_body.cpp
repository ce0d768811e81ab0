#include "adapt/space/working_body.hpp"

#include "voronoi/space/bodies.hpp"

namespace cnem::adapt {

void WorkingBody::renumber(const IndexedVector<NodeIndex, NodeIndex>& number) {
  Matter::renumber(number);
  adapt::renumber(number, cloud_.position);
  if (!cloud_.body.empty()) adapt::renumber(number, cloud_.body);
  for (auto& facet : cloud_.facets)
    for (NodeIndex& i : facet.node) i = number[i];
  std::erase_if(cloud_.twins,
                [&](const auto& pair) { return !exists(number[pair[0]]) || !exists(number[pair[1]]); });
  for (auto& pair : cloud_.twins)
    for (NodeIndex& i : pair) i = number[i];
}

Resampling<3> WorkingBody::finish(const SpaceStructure& structure) const {
  Cloud<3> cloud = cloud_;
  cloud.body = voronoi::bodies_of(structure.mesh);
  if (!structure.flipped || cloud.body == cloud_.body) {
    cloud.simplices = structure.mesh.node;
    cloud.across = structure.mesh.neighbour;
  }
  return Matter::finished(cloud);
}

} // namespace cnem::adapt
