#include "contact/near_tools.hpp"

#include "core/index.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace cnem::contact {
namespace {

constexpr double skin_of_tools = 0.2; ///< skin over the mean length of facets

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
  skin_ = skin_of_tools * total / static_cast<double>(std::max<std::size_t>(surface.facets.size(), 1));
  for (const ToolIndex t : tools.indices()) {
    const ToolShape<dim>& shape = *tools[t].shape;
    const Vec<dim> shift = shift_[t] = poses[t].end;
    Near& near = of_tool_[t];
    near.nodes.clear();
    near.at_ridges.clear();
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
    list_at_ridges(surface, shape, shift, position, near);
  }
}

template<>
void NearTools<2>::list_at_ridges(const Surface<2>& surface, const ToolShape<2>& shape, const Vec2& shift,
                                  PlacesOnBoundary<2> position, Near& near) {
  for (const FacetIndex f : surface.facets.indices()) {
    const Vec2 a = position[surface.facets[f][0]] - shift, b = position[surface.facets[f][1]] - shift;
    // seen from the tool an end moves by less than the skin, and so does one end from the other
    const double size = (b - a).lpNorm<1>() + std::numbers::sqrt2 * skin_;
    const auto reached = [&](const Ridge<2>& ridge) {
      return (ridge.centre - a).norm() <= ridge_reach(ridge, size) + skin_;
    };
    if (std::any_of(shape.ridges().begin(), shape.ridges().end(), reached)) near.at_ridges.push_back(f);
  }
}

/// What overlaps the box of a ridge once it has grown by a skin, and by half a facet: so deep may ridges be.
template<>
void NearTools<3>::list_at_ridges(const Surface<3>& surface, const ToolShape<3>& shape, const Vec3& shift,
                                  PlacesOnBoundary<3> position, Near& near) {
  const std::vector<Ridge<3>>& ridges = shape.ridges();
  if (ridges.empty()) return;
  if (near.ridges.empty()) {
    std::vector<Box<3>> boxes;
    for (const Ridge<3>& ridge : ridges) boxes.push_back(ridge.bounds());
    near.ridges = BoxTree(std::move(boxes));
  }
  std::vector<std::int32_t> met;
  const auto overlapping = [&](const auto& nodes, std::size_t count) {
    Box<3> box{position[nodes[0]] - shift, position[nodes[0]] - shift};
    for (std::size_t a = 1; a < count; ++a) {
      box.low = box.low.cwiseMin(position[nodes[a]] - shift);
      box.high = box.high.cwiseMax(position[nodes[a]] - shift);
    }
    const double reach = skin_ + 0.5 * (box.high - box.low).norm();
    box.low.array() -= reach;
    box.high.array() += reach;
    met.clear();
    near.ridges.overlapping(box, [&](std::int32_t r) { met.push_back(r); });
    std::sort(met.begin(), met.end());
  };
  const Box<3> bounds = shape.bounds();
  const auto far = [&](const Vec3& x) { // what is as far from the tool as facets are long can wait
    return (x - x.cwiseMax(bounds.low).cwiseMin(bounds.high)).norm();
  };
  for (const SurfaceEdgeIndex e : surface.edges.indices()) {
    const auto& nodes = surface.edges[e].node;
    const Vec3 a = position[nodes[0]] - shift;
    if (far(a) > 2.0 * (position[nodes[1]] - position[nodes[0]]).norm() + skin_) continue;
    overlapping(nodes, 2);
    // seen from the tool an end moves by less than the skin, so that the edge grows by less than two
    const Vec3 along = position[nodes[1]] - shift - a;
    const auto reached = [&](const Ridge<3>& ridge) {
      return ridge.distance(a + 0.5 * along) <= ridge.reach(along.norm() + 2.0 * skin_) + skin_;
    };
    for (const std::int32_t r : met)
      if (const Ridge<3>& ridge = ridges[index_of(r)]; !ridge.is_point() && reached(ridge))
        near.at_ridges.push_back({.ridge = r, .edge = e});
  }
  for (const FacetIndex f : surface.facets.indices()) {
    const auto& nodes = surface.facets[f];
    const Vec3 a = position[nodes[0]];
    const double size = std::max((position[nodes[1]] - a).norm(), (position[nodes[2]] - a).norm());
    if (far(a - shift) > 2.0 * size + skin_) continue;
    overlapping(nodes, 3);
    for (const std::int32_t r : met)
      if (ridges[index_of(r)].meets_facets(4.0 * size)) near.at_ridges.push_back({.ridge = r, .facet = f});
  }
}

template class NearTools<2>;
template class NearTools<3>;

} // namespace cnem::contact
