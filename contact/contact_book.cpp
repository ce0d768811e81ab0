// What contact has done in a step: work, heat, touching nodes; and penetrations, and what a checkpoint keeps.
#include "contact/contact.hpp"
#include "contact/contact_parts.hpp"
#include "core/index.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace cnem::contact {

ContactWork& operator+=(ContactWork& a, const ContactWork& b) {
  a.workpiece += b.workpiece;
  a.tool += b.tool;
  a.recovery += b.recovery;
  a.friction += b.friction;
  a.impact += b.impact;
  return a;
}

/// Work of each contact with the mean of the velocities before and after (design: with the predicted velocity
/// it would be wrong by its own size), split so that each part has one sign.
template<int dim> void RigidContact<dim>::book(const Poses<dim>& poses, const ContactStep<dim>& step) {
  for (const ToolIndex t : tools_.indices()) {
    results_[t].displacement = poses[t].end;
    results_[t].force.setZero();
    results_[t].step = {};
  }
  body_result_.pressing = 0.0;
  body_result_.step = {};
  rubbed_.clear();
  const Pose<dim> rest;
  for (const Contact<dim>& contact : contacts_) {
    const bool on_tool = exists(contact.tool);
    const ToolIndex t = contact.tool;
    const Pose<dim>& pose = on_tool ? poses[t] : rest;
    const Vec<dim> impulse = contact.impulse();
    if (impulse.squaredNorm() == 0.0) continue;
    const Vec<dim> node = at_contact(contact, [&](BoundaryNodeIndex b) {
      return Vec<dim>(0.5 * (before_[b] + reactions_[b].velocity + change(b)));
    });
    const Vec<dim> tool = 0.5 * (pose.before + pose.velocity);
    const double normal = (tool - node).dot(contact.normal) * contact.pressing;
    const double tangential = (tool - node).dot(contact.sliding);

    ContactWork& work = on_tool ? results_[t].step : body_result_.step;
    work.workpiece += node.dot(impulse);
    work.tool += tool.dot(impulse);
    work.impact += std::max(0.0, normal);
    work.friction += std::max(0.0, tangential);
    work.recovery -= std::min(0.0, normal) + std::min(0.0, tangential);
    if (on_tool) {
      results_[t].force += impulse / step.dt_mean;
      results_[t].impulse += impulse;
    } else {
      body_result_.pressing += contact.pressing / step.dt_mean;
    }
    for (std::size_t a = 0; a < Contact<dim>::slots; ++a)
      if (contact.weight[a] != 0.0) nodal_impulse_[contact.node[a]] += contact.weight[a] * impulse;
    share_heat(contact, std::max(0.0, tangential), step);
  }
  for (ToolResult<dim>& result : results_) result.total += result.step;
  body_result_.total += body_result_.step;
}

/// Friction heat of one contact, J/m^(3−dim): each side takes its share.
template<int dim>
void RigidContact<dim>::share_heat(const Contact<dim>& contact, double heat, const ContactStep<dim>& step) {
  if (heat == 0.0) return;
  const auto effusivity = [&](bool of_node) {
    double mean = 0.0;
    for (std::size_t a = 0; a < Contact<dim>::slots; ++a)
      if (const double w = contact.weight[a]; of_node ? w > 0.0 : w < 0.0)
        mean += std::abs(w) * step.effusivity[contact.node[a]];
    return mean;
  };
  if (!exists(contact.tool)) {
    const double one = step.effusivity.empty() ? 1.0 : effusivity(true),
                 other = step.effusivity.empty() ? 1.0 : effusivity(false);
    const double share = one + other > 0.0 ? one / (one + other) : 0.5;
    for (std::size_t a = 0; a < Contact<dim>::slots; ++a)
      if (const double w = contact.weight[a]; w != 0.0)
        heat_[contact.node[a]] += std::abs(w) * (w > 0.0 ? share : 1.0 - share) * heat;
    return;
  }
  const ToolIndex t = contact.tool;
  const ToolThermal& tool = tools_[t].thermal;
  for (std::size_t a = 0; a < Contact<dim>::slots; ++a) {
    if (contact.weight[a] == 0.0) continue;
    const BoundaryNodeIndex b = contact.node[a];
    const double share = step.effusivity.empty() ? 1.0 : tool.share_of_workpiece(step.effusivity[b]);
    const double taken = (1.0 - share) * contact.weight[a] * heat;
    heat_[b] += share * contact.weight[a] * heat;
    results_[t].heat_to_tool += taken;
    if (taken > 0.0) rubbed_.push_back({surface_.node[b], t, taken});
  }
}

template<int dim> void RigidContact<dim>::list_points() {
  points_.clear();
  for (const Contact<dim>& contact : contacts_)
    for (std::size_t a = 0; a < Contact<dim>::slots; ++a)
      if (contact.weight[a] != 0.0 && contact.pressing > 0.0 && exists(contact.tool))
        points_.push_back({surface_.node[contact.node[a]], contact.tool,
                           surface_.area_against(contact.node[a], contact.normal, end_, space_)});
  merge_points();
}

/// Pairs that are closed at the end of the step: which of several redundant ones bear, and which of them a
/// step looks at, says nothing about touching.
template<int dim> void RigidContact<dim>::list_touches() {
  touches_.clear();
  if (law_.conductance == 0.0) return;
  constexpr double closed = 1e-3; // of the facet
  std::vector<FacetHit<dim>> hits;
  bodies_.find_closed(surface_, end_, closed, hits);
  for (const FacetHit<dim>& hit : hits) {
    BodyTouch<dim> touch;
    touch.node = surface_.node[hit.node];
    for (std::size_t a = 0; a < dim; ++a) touch.facet[a] = surface_.node[surface_.facets[hit.facet][a]];
    touch.weight = hit.weight;
    touch.area = 0.5 * surface_.area_against(hit.node, hit.normal, end_, space_);
    touches_.push_back(touch);
  }
}

namespace {

constexpr double least_penetration = 1e-9; ///< of the size

/// m, of boundary nodes, from the area around one.
template<int dim> double spacing_of(double area) { return dim == 2 ? area : std::sqrt(area); }

} // namespace

template<int dim>
IndexedVector<BoundaryNodeIndex, Vec<dim>> RigidContact<dim>::places(const Fields<dim>& position) const {
  IndexedVector<BoundaryNodeIndex, Vec<dim>> all;
  for (const NodeIndex node : surface_.node) all.push_back(at<dim>(position, node));
  return all;
}

template<int dim>
std::vector<Overlap<dim>> RigidContact<dim>::nodes_inside(const Fields<dim>& position, double time) const {
  std::vector<Overlap<dim>> found;
  const auto all = places(position);
  std::vector<Vec<dim>> local;
  std::vector<Entry<dim>> entries;
  for (const ToolIndex t : tools_.indices()) {
    const Vec<dim> shift = displacement(index_of(t), time);
    local.clear(), entries.clear();
    for (const Vec<dim>& x : all) local.push_back(x - shift);
    tools_[t].shape->entries(local, local, entries);
    for (const Entry<dim>& entry : entries) {
      const auto b = as<BoundaryNodeIndex>(entry.index);
      if (entry.at.distance >= -least_penetration * size_) continue;
      found.push_back({t, surface_.node[b], -entry.at.distance, all[b],
                       spacing_of<dim>(surface_.area(b, all, Space::plane)), false});
    }
  }
  return found;
}

template<int dim>
std::vector<Overlap<dim>> RigidContact<dim>::overlaps(const Fields<dim>& position, double time) const {
  std::vector<Overlap<dim>> found = nodes_inside(position, time);
  const auto all = places(position);
  for (const ToolIndex t : tools_.indices()) {
    const Vec<dim> shift = displacement(index_of(t), time);
    for (const RidgeDepth<dim>& ridge : ridges_inside<dim>(surface_, *tools_[t].shape, all, shift))
      if (ridge.depth > least_penetration * size_)
        found.push_back({t, surface_.node[ridge.node], ridge.depth, ridge.position,
                         spacing_of<dim>(surface_.area(ridge.node, all, Space::plane)), true});
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const Overlap<dim>& a, const Overlap<dim>& b) { return a.depth > b.depth; });
  return found;
}

template<int dim> void RigidContact<dim>::archive(Archive& archive) {
  for (std::size_t t = 0; t < results_.size(); ++t) {
    const std::string at = fmt::format("solver/tools/{}/", t);
    ToolResult<dim>& result = results_[t];
    archive.vector<dim>(at + "displacement", "m", result.displacement);
    archive.vector<dim>(at + "force", "N/m", result.force);
    archive.vector<dim>(at + "impulse", "N s/m", result.impulse);
    archive.number(at + "heat_to_tool", "J/m", result.heat_to_tool);
    archive.number(at + "work/workpiece", "J/m", result.total.workpiece);
    archive.number(at + "work/tool", "J/m", result.total.tool);
    archive.number(at + "work/recovery", "J/m", result.total.recovery);
    archive.number(at + "work/friction", "J/m", result.total.friction);
    archive.number(at + "work/impact", "J/m", result.total.impact);
    if (tools_[t].drive) motions_.archive(archive, t);
  }
  if (!law_.active) return;
  bodies_.archive(archive, surface_);
  if constexpr (dim == 3) kept_.archive(archive);
  archive.number("solver/body_contact/size", "m", size_);
  archive.number("solver/body_contact/pressing", "N/m", body_result_.pressing);
  archive.number("solver/body_contact/energy/workpiece", "J/m", body_result_.total.workpiece);
  archive.number("solver/body_contact/energy/recovery", "J/m", body_result_.total.recovery);
  archive.number("solver/body_contact/energy/friction", "J/m", body_result_.total.friction);
  archive.number("solver/body_contact/energy/impact", "J/m", body_result_.total.impact);
}

template void RigidContact<2>::book(const Poses<2>&, const ContactStep<2>&);
template void RigidContact<2>::share_heat(const Contact<2>&, double, const ContactStep<2>&);
template void RigidContact<2>::list_touches();
template void RigidContact<2>::list_points();
template IndexedVector<BoundaryNodeIndex, Vec2> RigidContact<2>::places(const Fields<2>&) const;
template std::vector<Overlap<2>> RigidContact<2>::nodes_inside(const Fields<2>&, double) const;
template std::vector<Overlap<2>> RigidContact<2>::overlaps(const Fields<2>&, double) const;
template void RigidContact<2>::archive(Archive&);
template void RigidContact<3>::book(const Poses<3>&, const ContactStep<3>&);
template void RigidContact<3>::share_heat(const Contact<3>&, double, const ContactStep<3>&);
template void RigidContact<3>::list_touches();
template void RigidContact<3>::list_points();
template IndexedVector<BoundaryNodeIndex, Vec3> RigidContact<3>::places(const Fields<3>&) const;
template std::vector<Overlap<3>> RigidContact<3>::nodes_inside(const Fields<3>&, double) const;
template std::vector<Overlap<3>> RigidContact<3>::overlaps(const Fields<3>&, double) const;
template void RigidContact<3>::archive(Archive&);

} // namespace cnem::contact
