#include "contact/near_tools.hpp"

#include "core/index.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace cnem::contact {
namespace {

constexpr double skin_of_facets = 0.2; ///< skin over the mean length of facets

} // namespace

template<int dim> bool NearTools<dim>::tools_covered(const Poses<dim>& poses) const {
  for (const ToolIndex t : poses.indices())
    if (!((poses[t].end - shift_[t]).squaredNorm() <= 0.25 * skin_ * skin_)) return false;
  return true;
}

template<int dim>
void NearTools<dim>::look(const Surface<dim>& surface, const Tools<dim>& tools, const Poses<dim>& poses,
                          PlacesOnBoundary<dim> position) {
  if (!listed_.empty()) {
    double moved2 = 0.0;
    for (const BoundaryNodeIndex b : position.indices())
      moved2 = std::max(moved2, (position[b] - listed_[b]).squaredNorm());
    if (moved2 <= 0.25 * skin_ * skin_ && tools_covered(poses)) return;
  }
  list(surface, tools, poses, position);
}

template<int dim>
void NearTools<dim>::look(const Surface<dim>& surface, const Tools<dim>& tools, const Poses<dim>& poses,
                          PlacesOnBoundary<dim> position, std::span<const BoundaryNodeIndex> moved) {
  const bool covered = std::all_of(moved.begin(), moved.end(), [&](BoundaryNodeIndex b) {
    return (position[b] - listed_[b]).squaredNorm() <= 0.25 * skin_ * skin_;
  });
  if (!covered || !tools_covered(poses)) list(surface, tools, poses, position);
}

template<int dim>
void NearTools<dim>::list(const Surface<dim>& surface, const Tools<dim>& tools, const Poses<dim>& poses,
                          PlacesOnBoundary<dim> position) {
  ++listings_;
  listed_.assign(position.begin(), position.end());
  of_tool_.resize(tools.size());
  shift_.resize(tools.size());
  double total = 0.0;
  for (const auto& facet : surface.facets) total += (position[facet[1]] - position[facet[0]]).norm();
  skin_ = skin_of_facets * total / static_cast<double>(std::max<std::size_t>(surface.facets.size(), 1));
  for (const ToolIndex t : tools.indices()) {
    const ToolShape<dim>& shape = *tools[t].shape;
    const Vec<dim> shift = shift_[t] = poses[t].end;
    Near& near = of_tool_[t];
    near.nodes.clear();
    near.facets.clear();
    double reach = skin_;
    if constexpr (dim == 2)
      if (tools[t].equal_areas) // nodes stay off its arcs, by less than their radius
        for (const Ridge<2>& ridge : shape.ridges()) reach = std::max(reach, skin_ + ridge.radius);
    Box<dim> box = shape.bounds();
    box.low.array() -= reach;
    box.high.array() += reach;
    for (const BoundaryNodeIndex b : position.indices()) {
      const Vec<dim> x = position[b] - shift;
      if (box.contains(x) && shape.closest(x).distance <= reach) near.nodes.push_back(b);
    }
    if constexpr (dim == 2)
      for (const FacetIndex f : surface.facets.indices()) {
        const Vec2 a = position[surface.facets[f][0]] - shift, b = position[surface.facets[f][1]] - shift;
        // seen from the tool an end moves by less than the skin, and so does one end from the other
        const double size = (b - a).lpNorm<1>() + std::numbers::sqrt2 * skin_;
        const auto reached = [&](const Ridge<2>& ridge) {
          return (ridge.centre - a).norm() <= ridge_reach(ridge, size) + skin_;
        };
        if (std::any_of(shape.ridges().begin(), shape.ridges().end(), reached)) near.facets.push_back(f);
      }
  }
}

template class NearTools<2>;
template class NearTools<3>;

} // namespace cnem::contact
