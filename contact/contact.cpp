#include "contact/contact.hpp"

#include "contact/contact_parts.hpp"
#include "contact/sweeper.hpp"
#include "core/error.hpp"
#include "core/index.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <utility>

namespace cnem::contact {
namespace {

constexpr int passes = 8;   ///< of detection; each sees what the last corrected
constexpr int sweeps = 100; ///< of Gauss-Seidel in a pass, at most

/// Of vectors about their mean.
template<class List> double standard_deviation(const List& list) {
  if (list.size() == 0) return 0.0;
  auto sum = list.front();
  sum.setZero();
  for (const auto& v : list) sum += v;
  const auto mean = (sum / static_cast<double>(list.size())).eval();
  double squared = 0.0;
  for (const auto& v : list) squared += (v - mean).squaredNorm();
  return std::sqrt(squared / static_cast<double>(list.size()));
}

} // namespace

template<int dim>
RigidContact<dim>::RigidContact(std::vector<Tool<dim>> tools, Space space, BodyContactLaw bodies)
    : tools_(std::move(tools)), motions_(tools_), space_(space), law_(bodies) {
  for (const Tool<dim>& tool : tools_) {
    if (!tool.shape) throw InputError(fmt::format("tool '{}' has no shape", tool.name));
    tool.friction.check(fmt::format("tool '{}'", tool.name));
    for (const Friction& friction : tool.friction_by_material)
      friction.check(fmt::format("tool '{}'", tool.name));
    if (tool.drive && !(tool.drive->mass > 0.0))
      throw InputError(
          fmt::format("tool '{}': its mass must be positive, got {}", tool.name, tool.drive->mass));
    const Box<dim> box = tool.shape->bounds();
    size_ = std::max(size_, (box.high - box.low).norm());
  }
  results_.resize(tools_.size());
}

template<int dim>
void RigidContact<dim>::set_boundary(const std::vector<Facet<dim>>& facets, std::size_t nodes,
                                     const std::vector<NodeConstraint<dim>>& constraints,
                                     IndexedSpan<NodeIndex, const std::int32_t> group) {
  Surface<dim> surface(facets, nodes);
  if (surface.node != surface_.node || surface.facets != surface_.facets) kept_.clear();
  surface_ = std::move(surface);
  if (law_.active) bodies_.set_boundary(surface_, group);
  const std::size_t n = surface_.node.size();
  free_.assign(n, Mat<dim>::Identity());
  for (const NodeConstraint<dim>& constraint : constraints) {
    const auto found = std::lower_bound(surface_.node.begin(), surface_.node.end(), constraint.node);
    if (found != surface_.node.end() && *found == constraint.node)
      free_[index_of(found - surface_.node.begin())] = constraint.free;
  }
  set_tied(group);
  before_.assign(n, Vec<dim>::Zero());
  start_.resize(n);
  end_.resize(n);
  reactions_.resize(n);
  taken_.clear();
  is_taken_.assign(n, 0);
  near_.clear();
  heat_.assign(n, 0.0);
  nodal_impulse_.assign(n, Vec<dim>::Zero());
  points_.clear();
  touches_.clear();
  rubbed_.clear();
}

template<int dim> void RigidContact<dim>::remember(const Fields<dim>& velocity) {
  if (!active()) return;
  for (const BoundaryNodeIndex b : before_.indices()) before_[b] = at<dim>(velocity, surface_.node[b]);
  if (law_.active) spread_ = standard_deviation(before_);
}

template<int dim> bool RigidContact<dim>::flow_stress_needed() const {
  return (law_.active && law_.friction.needs_flow_stress()) ||
         std::any_of(tools_.begin(), tools_.end(),
                     [](const Tool<dim>& tool) { return tool.any_friction(&Friction::needs_flow_stress); });
}

template<int dim> bool RigidContact<dim>::rubs() const {
  return (law_.active && law_.friction.rubs()) ||
         std::any_of(tools_.begin(), tools_.end(),
                     [](const Tool<dim>& tool) { return tool.any_friction(&Friction::rubs); });
}

template<int dim> bool RigidContact<dim>::by_material() const {
  return std::any_of(tools_.begin(), tools_.end(),
                     [](const Tool<dim>& tool) { return !tool.friction_by_material.empty(); });
}

template<int dim> void RigidContact<dim>::correct(const ContactStep<dim>& step) {
  if (flow_stress_needed() && step.flow_stress.size() != surface_.node.size())
    throw InputError(fmt::format("this friction needs the flow stress of all {} boundary nodes, "
                                 "got {}",
                                 surface_.node.size(), step.flow_stress.size()));
  const double longest = gather(step);
  Poses<dim> poses = motions_.predict(tools_, step.time, step.dt, step.dt_mean);
  tool_reactions_ = motions_.reactions(tools_, poses);
  look_for_passages(poses, step, longest);
  near_.look(surface_, tools_, poses, end_);
  if (law_.active) {
    bodies_.look(surface_, start_, end_);
    size_ = std::max(size_, bodies_.size());
  }
  respond(poses, step);
  if (!answered_.empty()) {
    move(poses, step.dt);
    near_.look(surface_, tools_, poses, end_, taken_);
  }
  deepest_ = 0.0;
  for (int pass = 0; pass < passes; ++pass) {
    from_earlier_passes_ = contacts_.size();
    first_pass_ = pass == 0;
    const bool faces = find_on_faces(poses, step), ridges = find_on_ridges(poses, step),
               bodies = find_on_bodies(poses, step);
    if (!faces && !ridges && !bodies) break;
    if (first_pass_) begin_with_kept(step);
    const double depth =
        solver_.solve(contacts_, reactions_, tool_reactions_, step.dt, 1e-16 * size_, sweeps, deepest_);
    if constexpr (dim == 3) deepest_ = depth;
    move(poses, step.dt);
    near_.look(surface_, tools_, poses, end_, taken_);
  }
  kept_.keep(contacts_, step.dt_mean, ImpulseSolver<dim>::rest_of_swept * deepest_);
  share_out(contacts_, twins_, step.mass);
  share_out(answered_, answered_twins_, step.mass);
  contacts_.insert(contacts_.end(), answered_.begin(), answered_.end());
  scatter(step);
  motions_.accept(tools_, poses);
  book(poses, step);
  list_points();
  list_touches();
  if (in_sub_steps_)
    add_sub_step(step.dt_mean);
  else
    merge_touches();
}

/// Whether a contact that bore nothing in the last step, of nodes that bore by others, need not be solved
/// for: in the first pass it may not have to bear now, in later ones it overlaps by no more than sweeps
/// leave. Where nodes are tied it is one that bears for several.
template<int dim> bool RigidContact<dim>::waits(const Contact<dim>& contact, double missing) {
  if (kept_.empty() || !kept_.covers(contact)) return false;
  for (std::size_t a = 0; a < Contact<dim>::slots; ++a)
    if (contact.weight[a] != 0.0 && exists(tied_[contact.node[a]].first)) return false;
  if (!first_pass_) return missing <= ImpulseSolver<dim>::rest_of_swept * deepest_;
  if (kept_.find(contact)) return false;
  deepest_ = std::max(deepest_, missing);
  return true;
}

/// Gives contacts what they bore in the last step.
template<int dim> void RigidContact<dim>::begin_with_kept(const ContactStep<dim>& step) {
  if (kept_.empty()) return;
  Reaction<dim> none;
  for (Contact<dim>& contact : contacts_) {
    const Contact<dim>* const kept = kept_.find(contact);
    Sweeper<dim> sweeper(contact, reactions_, exists(contact.tool) ? tool_reactions_[contact.tool] : none,
                         step.dt);
    if (!kept || sweeper.along(contact.normal) == 0.0) continue; // what is held now never lets go of it
    deepest_ = std::max(deepest_, -gap(contact, step.dt));
    contact.swept = true;
    const Vec<dim> sliding = kept->sliding - kept->sliding.dot(contact.normal) * contact.normal;
    sweeper.set(step.dt_mean * kept->pressing, step.dt_mean * sliding);
  }
}

/// Takes nodes and tools to where the impulses found so far bring them.
template<int dim> void RigidContact<dim>::move(Poses<dim>& poses, double dt) {
  for (const BoundaryNodeIndex b : taken_) end_[b] = reactions_[b].position + dt * change(b);
  for (const ToolIndex t : poses.indices()) {
    poses[t].end = tool_reactions_[t].position + dt * tool_reactions_[t].change;
    poses[t].velocity = tool_reactions_[t].velocity + tool_reactions_[t].change;
  }
}

/// Where all nodes are; returns the longest path of a node, m.
template<int dim> double RigidContact<dim>::gather(const ContactStep<dim>& step) {
  double longest2 = 0.0;
  for (const BoundaryNodeIndex b : end_.indices()) {
    end_[b] = at<dim>(step.position, surface_.node[b]);
    start_[b] = end_[b] - step.dt * at<dim>(step.velocity, surface_.node[b]);
    if (const double path2 = (end_[b] - start_[b]).squaredNorm(); !(path2 <= longest2)) longest2 = path2;
  }
  for (const BoundaryNodeIndex b : taken_) is_taken_[b] = 0;
  taken_.clear();
  contacts_.clear();
  twins_.clear();
  std::fill(heat_.begin(), heat_.end(), 0.0);
  std::fill(nodal_impulse_.begin(), nodal_impulse_.end(), Vec<dim>::Zero());
  return std::sqrt(longest2);
}

template<int dim>
void RigidContact<dim>::look_for_passages(const Poses<dim>& poses, const ContactStep<dim>& step,
                                          double longest) const {
  for (const ToolIndex t : tools_.indices()) {
    const ToolShape<dim>& shape = *tools_[t].shape;
    if (longest + (poses[t].end - poses[t].start).norm() < shape.least_thickness()) continue;
    for (const BoundaryNodeIndex b : end_.indices()) {
      const Vec<dim> from = start_[b] - poses[t].start, to = end_[b] - poses[t].end;
      const double thickness = shape.passed(from, to);
      if (thickness == 0.0) continue;
      const int node = static_cast<int>(index_of(surface_.node[b]));
      throw DivergenceError(
          fmt::format("node {} went through tool '{}' unseen, from one side to the other, between t = {:.9g} "
                      "s and {:.9g} s: {:.3g} m past each other, and the tool is {:.3g} m thick there; make "
                      "it thicker, or the step shorter with time.step.max",
                      node, tools_[t].name, step.time, step.time + step.dt, (to - from).norm(), thickness),
          node, "tool velocity");
    }
  }
}

/// Takes a contact into the list; where it is there already and the surface is curved, or the facet has
/// turned, raises its plane by what is still missing. `start` is its gap at the start of the step, `level`
/// the place of the surface along its normal. True when there is anything to solve.
template<int dim>
bool RigidContact<dim>::add(Contact<dim> contact, double start, double level, const Pose<dim>& pose,
                            const ContactStep<dim>& step) {
  const auto mean = [&](const IndexedVector<BoundaryNodeIndex, Vec<dim>>& list) {
    return at_contact(contact, [&](BoundaryNodeIndex b) { return list[b]; });
  };
  contact.level = level;
  if (start < 0.0) {
    double relative = (mean(before_) - pose.before).norm();
    if (!exists(contact.tool)) relative = std::min(relative, spread_); // what pushes out must not feed itself
    const double speed = std::max(pose.recovery, 0.5 * relative);
    const double left = kept_.covers(contact) ? kept_.left() : 0.0; // else what sweeps leave would add up
    contact.level += std::min(0.0, start + std::max(step.dt * speed, left));
  }
  double missing = contact.level - contact.normal.dot(mean(end_));
  if (missing <= 0.0) return false;
  if (waits(contact, missing)) return first_pass_;
  if (exists(contact.tool))
    contact.level -= step.dt * contact.normal.dot(tool_reactions_[contact.tool].change);
  const auto earlier = contacts_.begin() + static_cast<std::ptrdiff_t>(from_earlier_passes_);
  const auto is_same = [&](const Contact<dim>& c) {
    return c.tool == contact.tool && c.feature == contact.feature && c.facet == contact.facet &&
           c.node == contact.node && c.shift == contact.shift;
  };
  auto known = std::find_if(contacts_.begin(), earlier, is_same);
  bool rubs_anew = false;
  if (known == earlier) {
    const auto twin = twin_of(contact, contacts_);
    if (!twin) {
      take(contact, step);
      contacts_.push_back(contact);
      return true;
    }
    known = contacts_.begin() + static_cast<std::ptrdiff_t>(*twin);
    missing += gap(*known, step.dt); // the deepest of them says how far all are pushed
    if (std::none_of(twins_.begin(), twins_.end(), [&](const Twin& t) { return is_same(t.contact); }))
      rubs_anew = join(*known, contact, *twin, twins_, step.mass);
  }
  const double rest = known->swept ? ImpulseSolver<dim>::rest_of_swept * deepest_ : 0.0;
  if (missing <= std::max(1e-14 * size_, rest)) return rubs_anew;
  known->level += missing;
  return true;
}

template<int dim> void RigidContact<dim>::scatter(const ContactStep<dim>& step) {
  for (const BoundaryNodeIndex b : taken_) {
    const Vec<dim> change = this->change(b);
    const auto node = index_of(surface_.node[b]);
    for (int k = 0; k < dim; ++k) {
      step.velocity[index_of(k)][node] += change[k];
      step.position[index_of(k)][node] += step.dt * change[k];
    }
  }
}

template class RigidContact<2>;
template class RigidContact<3>;

} // namespace cnem::contact
