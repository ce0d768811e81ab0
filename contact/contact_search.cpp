// Where nodes, ridges and edges meet tools and bodies in a step.
#include "contact/arc_offset.hpp"
#include "contact/contact.hpp"
#include "contact/contact_friction.hpp"
#include "contact/contact_parts.hpp"
#include "contact/covered_edges.hpp"
#include "core/index.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

namespace cnem::contact {

/// Whether a tool stands where it stood in the last pass: then it can have met nothing but nodes that moved.
template<int dim> bool RigidContact<dim>::stands(ToolIndex tool) const {
  return from_earlier_passes_ > 0 && tool_reactions_[tool].inverse.isZero(0.0);
}

/// A node on the face of a tool, with its friction.
template<int dim>
Contact<dim> RigidContact<dim>::on_face(ToolIndex tool, BoundaryNodeIndex node, const SurfacePoint<dim>& at,
                                        const ContactStep<dim>& step) const {
  Contact<dim> contact;
  contact.tool = tool;
  contact.feature = at.feature;
  contact.node[0] = node;
  contact.weight[0] = 1.0;
  contact.normal = at.normal;
  set_friction(contact, step, [&] { return rubbing_area(node, contact.normal, step.window); });
  return contact;
}

template<int dim>
bool RigidContact<dim>::find_on_faces(const Poses<dim>& poses, const ContactStep<dim>& step) {
  bool any = false;
  for (const ToolIndex t : tools_.indices()) {
    if (!tools_[t].response.exact()) continue;
    const Box<dim> box = tools_[t].shape->bounds();
    inside_.clear(), from_.clear(), to_.clear(), entries_.clear();
    for (const BoundaryNodeIndex b : near_.nodes(t)) {
      if (stands(t) && !is_taken_[b]) continue;
      Vec<dim> from = start_[b] - poses[t].start, to = end_[b] - poses[t].end;
      if (tools_[t].equal_areas) {
        const Vec<dim> ahead = arc_offset<dim>(surface_, *tools_[t].shape, b, start_, poses[t].start);
        from += ahead, to += ahead;
      }
      if (!box.contains(to)) continue;
      inside_.push_back(b);
      from_.push_back(from);
      to_.push_back(to);
    }
    if (inside_.empty()) continue;
    tools_[t].shape->entries(from_, to_, entries_);
    for (const Entry<dim>& entry : entries_) {
      const BoundaryNodeIndex b = inside_[index_of(entry.index)];
      const Contact<dim> contact = on_face(t, b, entry.at, step);
      const double level = entry.at.normal.dot(end_[b]) - entry.at.distance;
      any |= add(contact, entry.start, level, poses[t], step);
    }
  }
  return any;
}

/// Of pairs of ridge and edge or facet those with a node that moved.
template<int dim>
std::span<const RidgePair> RigidContact<dim>::moved_among(std::span<const RidgePair> pairs) requires(dim ==
                                                                                                     3) {
  moved_.clear();
  for (const RidgePair& pair : pairs) {
    const auto& nodes = exists(pair.edge) ? surface_.edges[pair.edge].node : surface_.facets[pair.facet];
    if (std::any_of(nodes.begin(), nodes.end(), [&](BoundaryNodeIndex b) { return is_taken_[b] != 0; }))
      moved_.push_back(pair);
  }
  return moved_;
}

template<int dim>
bool RigidContact<dim>::find_on_ridges(const Poses<dim>& poses, const ContactStep<dim>& step) {
  bool any = false;
  std::vector<RidgeHit<dim>> hits;
  for (const ToolIndex t : tools_.indices()) {
    if (!tools_[t].response.exact()) continue;
    hits.clear();
    std::span<const RidgeCandidate<dim>> pairs = near_.at_ridges(t);
    if constexpr (dim == 3)
      if (stands(t)) pairs = moved_among(pairs);
    ridge_hits<dim>(surface_, pairs, *tools_[t].shape, start_, end_, poses[t].start, poses[t].end, hits);
    if (tools_[t].equal_areas)
      share_with_faces<dim>(surface_, *tools_[t].shape, start_, end_, poses[t].start, poses[t].end, hits);
    for (const RidgeHit<dim>& hit : hits) {
      Contact<dim> contact;
      contact.tool = t;
      contact.feature = hit.ridge;
      contact.facet = hit.facet;
      std::copy(hit.node.begin(), hit.node.end(), contact.node.begin());
      std::copy(hit.weight.begin(), hit.weight.end(), contact.weight.begin());
      contact.normal = hit.normal;
      set_friction(contact, step, [&] {
        double area = 0.0; // of nodes that do not rub on a face themselves
        for (std::size_t a = 0; a < Contact<dim>::slots; ++a) {
          const auto is_face = [&](const Contact<dim>& c) {
            return c.tool == contact.tool && !exists(c.facet) && c.node[0] == contact.node[a];
          };
          const bool on_face = std::any_of(contacts_.begin(), contacts_.end(), is_face) ||
                               std::any_of(twins_.begin(), twins_.end(),
                                           [&](const Twin& twin) { return is_face(twin.contact); });
          if (contact.weight[a] != 0.0 && !on_face)
            area += contact.weight[a] * rubbing_area(contact.node[a], contact.normal, step.window);
        }
        return area;
      });
      const Vec<dim> x = at_contact(contact, [&](BoundaryNodeIndex b) { return end_[b]; });
      any |= add(contact, hit.start, hit.normal.dot(x) - hit.gap, poses[t], step);
    }
  }
  return any;
}

/// m^(dim−1), of a node in what faces against a normal, times its window.
template<int dim>
double RigidContact<dim>::rubbing_area(BoundaryNodeIndex node, const Vec<dim>& normal,
                                       BoundaryValues window) const {
  return surface_.area_against(node, normal, end_, space_) * (window.empty() ? 1.0 : window[node]);
}

template<int dim>
bool RigidContact<dim>::find_on_bodies(const Poses<dim>& poses, const ContactStep<dim>& step) {
  if (!law_.active) return false;
  bool any = false;
  Pose<dim> rest;
  for (const Pose<dim>& pose : poses) rest.recovery = pose.recovery; // all have the same
  std::vector<FacetHit<dim>> hits;
  bodies_.find(surface_, start_, end_, hits);
  for (const FacetHit<dim>& hit : hits) {
    const auto& ends = surface_.facets[hit.facet];
    Contact<dim> contact;
    contact.facet = hit.facet;
    contact.shift = hit.shift;
    contact.node[0] = hit.node;
    contact.weight[0] = 1.0;
    for (std::size_t a = 0; a < dim; ++a) {
      contact.node[a + 1] = ends[a];
      contact.weight[a + 1] = -hit.weight[a];
    }
    contact.normal = hit.normal;
    set_friction(contact, step, [&] {
      // The forces of either side may arrive alone; over a macro step each has the same windows in all.
      const double area = surface_.area_against(hit.node, hit.normal, end_, space_);
      if (step.window.empty()) return area;
      double both = step.window[hit.node];
      for (std::size_t a = 0; a < dim; ++a) both += hit.weight[a] * step.window[ends[a]];
      return 0.5 * both * area;
    });
    any |= add(contact, hit.start, hit.clearance + hit.normal.dot(contact.shift), rest, step);
  }
  if constexpr (dim == 3) any |= find_on_edges(rest, step);
  return any;
}

/// Edges of bodies that cross each other.
template<int dim>
bool RigidContact<dim>::find_on_edges(const Pose<dim>& rest,
                                      const ContactStep<dim>& step) requires(dim == 3) {
  bool any = false;
  std::vector<EdgeHit> hits;
  bodies_.find_edges(surface_, start_, end_, hits);
  for (const EdgeHit& hit : hits) {
    const SurfaceEdge &one = surface_.edges[hit.pair.one], &other = surface_.edges[hit.pair.other];
    Contact<3> contact;
    contact.feature = 1 + as<std::int32_t>(hit.pair.other);
    contact.facet = one.facet[0]; // with its first node it is the edge
    contact.shift = hit.pair.shift;
    contact.node = {one.node[0], one.node[1], other.node[0], other.node[1]};
    contact.weight = {hit.weight_one[0], hit.weight_one[1], -hit.weight_other[0], -hit.weight_other[1]};
    contact.normal = hit.normal;
    set_friction(contact, step, [&] { // of a quarter of each end: its facets touch elsewhere too
      double area = 0.0;
      for (std::size_t a = 0; a < 4; ++a)
        area += 0.125 * std::abs(contact.weight[a]) *
                rubbing_area(contact.node[a], a < 2 ? hit.normal : Vec3(-hit.normal), step.window);
      return area;
    });
    any |= add(contact, hit.start, hit.clearance + hit.normal.dot(contact.shift), rest, step);
  }
  return any;
}

template const Friction& RigidContact<2>::friction_of(const Contact<2>&, const ContactStep<2>&) const;
template bool RigidContact<2>::stands(ToolIndex) const;
template double RigidContact<2>::rubbing_area(BoundaryNodeIndex, const Vec2&, BoundaryValues) const;
template Contact<2> RigidContact<2>::on_face(ToolIndex, BoundaryNodeIndex, const SurfacePoint<2>&,
                                             const ContactStep<2>&) const;
template bool RigidContact<2>::find_on_faces(const Poses<2>&, const ContactStep<2>&);
template bool RigidContact<2>::find_on_ridges(const Poses<2>&, const ContactStep<2>&);
template bool RigidContact<2>::find_on_bodies(const Poses<2>&, const ContactStep<2>&);
template const Friction& RigidContact<3>::friction_of(const Contact<3>&, const ContactStep<3>&) const;
template bool RigidContact<3>::stands(ToolIndex) const;
template double RigidContact<3>::rubbing_area(BoundaryNodeIndex, const Vec3&, BoundaryValues) const;
template Contact<3> RigidContact<3>::on_face(ToolIndex, BoundaryNodeIndex, const SurfacePoint<3>&,
                                             const ContactStep<3>&) const;
template bool RigidContact<3>::find_on_faces(const Poses<3>&, const ContactStep<3>&);
template bool RigidContact<3>::find_on_ridges(const Poses<3>&, const ContactStep<3>&);
template bool RigidContact<3>::find_on_edges(const Pose<3>&, const ContactStep<3>&);
template std::span<const RidgePair> RigidContact<3>::moved_among(std::span<const RidgePair>);
template bool RigidContact<3>::find_on_bodies(const Poses<3>&, const ContactStep<3>&);

} // namespace cnem::contact
