#include "thermal/tool_section.hpp"

#include "core/geometry/facets.hpp"
#include "core/index.hpp"

#include <algorithm>
#include <limits>

namespace cnem {

template<int dim> void ToolSection<dim>::complete(double capacity_per_volume, double factor, Space space) {
  heat_capacity.clear();
  for (const double volume : approximation.node_volume)
    heat_capacity.push_back(capacity_per_volume * factor * volume);
  if (!coating) return;
  const std::size_t n = heat_capacity.size();
  Field area(n, 0.0);
  for (const Facet<dim>& facet : cloud.facets) {
    const auto shares = corner_areas<dim>(space, corners_of<dim>(facet, cloud.position));
    for (std::size_t a = 0; a < dim; ++a) area[index_of(facet.node[a])] += shares[a];
  }
  coating_node.assign(n, NodeIndex::none);
  through_coating.assign(n, 0.0);
  for (std::size_t i = 0; i < n; ++i) {
    if (area[i] == 0.0) continue;
    coating_node[i] = as<NodeIndex>(heat_capacity.size());
    through_coating[i] = 2.0 * coating->conductivity / coating->thickness * area[i];
    heat_capacity.push_back(coating->density * coating->specific_heat * factor * coating->thickness *
                            area[i]);
  }
}

template<int dim> double ToolSection<dim>::contact_conductance() const {
  if (!coating || conductance == 0.0) return conductance;
  return 1.0 / (1.0 / conductance + 0.5 * coating->thickness / coating->conductivity);
}

template<> FacePlace<2> ToolSection<2>::nearest_on_faces(const Vec2& x) const {
  FacePlace<2> best;
  double least = std::numeric_limits<double>::infinity();
  for (const Facet<2>& facet : cloud.facets) {
    const Vec2 &a = cloud.position[facet.node[0]], along = cloud.position[facet.node[1]] - a;
    const double s = std::clamp((x - a).dot(along) / along.squaredNorm(), 0.0, 1.0);
    if (const double distance = (a + s * along - x).squaredNorm(); distance < least) {
      least = distance;
      best = {facet.node, {1.0 - s, s}};
    }
  }
  if (coating)
    for (NodeIndex& node : best.node) node = coating_node[node];
  return best;
}

template struct ToolSection<2>;

} // namespace cnem
