#include "contact/contact.hpp"

#include "core/error.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>
#include <utility>

namespace cnem::contact {
namespace {

constexpr int passes = 8;   ///< of detection; each sees what the last corrected
constexpr int sweeps = 100; ///< of Gauss-Seidel in a pass

template<int dim> Vec<dim> at(const Fields<dim>& field, std::int32_t node) {
  Vec<dim> x;
  for (int k = 0; k < dim; ++k) x[k] = field[static_cast<std::size_t>(k)][static_cast<std::size_t>(node)];
  return x;
}

/// Velocity of the point where a contact acts, from one vector per boundary node.
template<int dim, class PerNode> Vec<dim> at_contact(const Contact<dim>& contact, PerNode&& value) {
  Vec<dim> sum = Vec<dim>::Zero();
  for (std::size_t a = 0; a < dim; ++a)
    if (contact.weight[a] != 0.0) sum += contact.weight[a] * value(static_cast<std::size_t>(contact.node[a]));
  return sum;
}

} // namespace

ContactWork& operator+=(ContactWork& a, const ContactWork& b) {
  a.workpiece += b.workpiece;
  a.tool += b.tool;
  a.recovery += b.recovery;
  a.friction += b.friction;
  a.impact += b.impact;
  return a;
}

template<int dim>
RigidContact<dim>::RigidContact(std::vector<Tool<dim>> tools, Space space)
    : tools_(std::move(tools)), motions_(tools_), space_(space) {
  for (const Tool<dim>& tool : tools_) {
    if (!tool.shape) throw InputError(fmt::format("tool '{}' has no shape", tool.name));
    if (!(tool.friction.coulomb >= 0.0) || !(tool.friction.shear_factor >= 0.0))
      throw InputError(
          fmt::format("tool '{}': friction coefficient and shear factor must not be negative, got "
                      "{} and {}",
                      tool.name, tool.friction.coulomb, tool.friction.shear_factor));
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
                                     const std::vector<NodeConstraint<dim>>& constraints) {
  surface_ = Surface<dim>(facets, nodes);
  const std::size_t n = surface_.node.size();
  free_.assign(n, Mat<dim>::Identity());
  for (const NodeConstraint<dim>& constraint : constraints) {
    const auto found = std::lower_bound(surface_.node.begin(), surface_.node.end(), constraint.node);
    if (found != surface_.node.end() && *found == constraint.node)
      free_[static_cast<std::size_t>(found - surface_.node.begin())] = constraint.free;
  }
  before_.assign(n, Vec<dim>::Zero());
  start_.resize(n);
  end_.resize(n);
  reactions_.resize(n);
  heat_.assign(n, 0.0);
  nodal_impulse_.assign(n, Vec<dim>::Zero());
  points_.clear();
}

template<int dim> void RigidContact<dim>::remember(const Fields<dim>& velocity) {
  for (std::size_t b = 0; b < before_.size(); ++b) before_[b] = at<dim>(velocity, surface_.node[b]);
}

template<int dim> bool RigidContact<dim>::flow_stress_needed() const {
  return std::any_of(tools_.begin(), tools_.end(), [](const Tool<dim>& tool) {
    return tool.friction.coulomb > 0.0 && std::isfinite(tool.friction.shear_factor);
  });
}

template<int dim> void RigidContact<dim>::correct(const ContactStep<dim>& step) {
  if (flow_stress_needed() && step.flow_stress.size() != surface_.node.size())
    throw InputError(
        fmt::format("friction with a shear factor needs the flow stress of all {} boundary nodes, "
                    "got {}",
                    surface_.node.size(), step.flow_stress.size()));
  gather(step);
  std::vector<Pose<dim>> poses = motions_.predict(tools_, step.time, step.dt, step.dt_mean);
  tool_reactions_ = motions_.reactions(tools_, poses);
  for (int pass = 0; pass < passes; ++pass) {
    from_earlier_passes_ = contacts_.size();
    const bool faces = find_on_faces(poses, step), ridges = find_on_ridges(poses, step);
    if (!faces && !ridges) break;
    solve_impulses(contacts_, reactions_, tool_reactions_, step.dt, 1e-16 * size_, sweeps);
    for (std::size_t b = 0; b < end_.size(); ++b)
      end_[b] = reactions_[b].position + step.dt * reactions_[b].change;
    for (std::size_t t = 0; t < poses.size(); ++t) {
      poses[t].end = tool_reactions_[t].position + step.dt * tool_reactions_[t].change;
      poses[t].velocity = tool_reactions_[t].velocity + tool_reactions_[t].change;
    }
  }
  scatter(step);
  motions_.accept(tools_, poses);
  book(poses, step);
  list_points(poses, step);
  if (in_sub_steps_) add_sub_step(step.dt_mean);
}

template<int dim> void RigidContact<dim>::gather(const ContactStep<dim>& step) {
  for (std::size_t b = 0; b < reactions_.size(); ++b) {
    const std::int32_t node = surface_.node[b];
    Reaction<dim>& reaction = reactions_[b];
    reaction.inverse = free_[b] / step.mass[static_cast<std::size_t>(node)];
    reaction.position = end_[b] = at<dim>(step.position, node);
    reaction.velocity = at<dim>(step.velocity, node);
    reaction.change.setZero();
    start_[b] = reaction.position - step.dt * reaction.velocity;
  }
  rubbing_ = area_ = surface_.areas(end_, space_);
  for (std::size_t b = 0; b < step.window.size(); ++b) rubbing_[b] *= step.window[b];
  contacts_.clear();
  std::fill(heat_.begin(), heat_.end(), 0.0);
  std::fill(nodal_impulse_.begin(), nodal_impulse_.end(), Vec<dim>::Zero());
}

/// Takes a contact into the list; where it is there already and the surface is curved, or the facet has
/// turned, raises its plane by what is still missing. `start` is its gap at the start of the step, `level`
/// the place of the surface along its normal. True when there is anything to solve.
template<int dim>
bool RigidContact<dim>::add(Contact<dim> contact, double start, double level, const Pose<dim>& pose,
                            double dt) {
  const auto mean = [&](const std::vector<Vec<dim>>& list) {
    return at_contact(contact, [&](std::size_t b) { return list[b]; });
  };
  contact.level = level;
  if (start < 0.0) {
    const double speed = std::max(pose.recovery, 0.5 * (mean(before_) - pose.before).norm());
    contact.level += std::min(0.0, start + dt * speed);
  }
  const double gap = contact.normal.dot(mean(end_)) - contact.level;
  if (gap >= 0.0) return false;
  contact.level -= dt * contact.normal.dot(tool_reactions_[static_cast<std::size_t>(contact.tool)].change);
  const auto earlier = contacts_.begin() + static_cast<std::ptrdiff_t>(from_earlier_passes_);
  const auto known = std::find_if(contacts_.begin(), earlier, [&](const Contact<dim>& c) {
    return c.tool == contact.tool && c.feature == contact.feature && c.facet == contact.facet &&
           (c.facet >= 0 || c.node[0] == contact.node[0]);
  });
  if (known == earlier)
    contacts_.push_back(contact);
  else if (gap < -1e-14 * size_)
    known->level -= gap;
  else
    return false;
  return true;
}

template<int dim>
bool RigidContact<dim>::find_on_faces(const std::vector<Pose<dim>>& poses, const ContactStep<dim>& step) {
  bool any = false;
  std::vector<std::int32_t> inside;
  std::vector<Vec<dim>> from, to;
  std::vector<Entry<dim>> entries;
  for (std::size_t t = 0; t < tools_.size(); ++t) {
    const Tool<dim>& tool = tools_[t];
    const Box<dim> box = tool.shape->bounds();
    inside.clear(), from.clear(), to.clear(), entries.clear();
    for (std::size_t b = 0; b < end_.size(); ++b) {
      const Vec<dim> x = end_[b] - poses[t].end;
      if (!box.contains(x)) continue;
      inside.push_back(static_cast<std::int32_t>(b));
      from.push_back(start_[b] - poses[t].start);
      to.push_back(x);
    }
    if (inside.empty()) continue;
    tool.shape->entries(from, to, entries);
    for (const Entry<dim>& entry : entries) {
      const auto b = static_cast<std::size_t>(inside[static_cast<std::size_t>(entry.index)]);
      Contact<dim> contact;
      contact.tool = static_cast<std::int32_t>(t);
      contact.feature = entry.at.feature;
      contact.node[0] = static_cast<std::int32_t>(b);
      contact.weight[0] = 1.0;
      contact.normal = entry.at.normal;
      set_friction(contact, rubbing_[b], step);
      const double level = entry.at.normal.dot(end_[b]) - entry.at.distance;
      any |= add(contact, entry.start, level, poses[t], step.dt);
    }
  }
  return any;
}

template<int dim>
bool RigidContact<dim>::find_on_ridges(const std::vector<Pose<dim>>& poses, const ContactStep<dim>& step) {
  bool any = false;
  std::vector<RidgeHit<dim>> hits;
  for (std::size_t t = 0; t < tools_.size(); ++t) {
    hits.clear();
    ridge_hits(surface_, *tools_[t].shape, start_, end_, poses[t].start, poses[t].end, hits);
    for (const RidgeHit<dim>& hit : hits) {
      Contact<dim> contact;
      contact.tool = static_cast<std::int32_t>(t);
      contact.feature = hit.ridge;
      contact.facet = hit.facet;
      contact.node = surface_.facets[static_cast<std::size_t>(hit.facet)];
      contact.weight = hit.weight;
      contact.normal = hit.normal;
      double area = 0.0; // of nodes that do not rub on a face themselves
      for (std::size_t a = 0; a < dim; ++a) {
        const bool on_face = std::any_of(contacts_.begin(), contacts_.end(), [&](const Contact<dim>& c) {
          return c.tool == contact.tool && c.facet < 0 && c.node[0] == contact.node[a];
        });
        if (!on_face) area += contact.weight[a] * rubbing_[static_cast<std::size_t>(contact.node[a])];
      }
      set_friction(contact, area, step);
      const Vec<dim> x = at_contact(contact, [&](std::size_t b) { return end_[b]; });
      any |= add(contact, hit.start, hit.normal.dot(x) - hit.gap, poses[t], step.dt);
    }
  }
  return any;
}

template<int dim>
void RigidContact<dim>::set_friction(Contact<dim>& contact, double area, const ContactStep<dim>& step) const {
  const Friction& friction = tools_[static_cast<std::size_t>(contact.tool)].friction;
  contact.surface = tool_reactions_[static_cast<std::size_t>(contact.tool)].velocity;
  contact.coulomb = friction.coulomb;
  contact.limit = std::numeric_limits<double>::infinity();
  if (friction.coulomb == 0.0 || std::isinf(friction.shear_factor)) return;
  double flow_stress = 0.0;
  for (std::size_t a = 0; a < dim; ++a)
    if (contact.weight[a] != 0.0)
      flow_stress += contact.weight[a] * step.flow_stress[static_cast<std::size_t>(contact.node[a])];
  contact.limit = friction.shear_factor * flow_stress / std::numbers::sqrt3 * area * step.dt_mean;
}

template<int dim> void RigidContact<dim>::scatter(const ContactStep<dim>& step) {
  for (std::size_t b = 0; b < reactions_.size(); ++b) {
    const Vec<dim>& change = reactions_[b].change;
    if (change.squaredNorm() == 0.0) continue;
    const auto node = static_cast<std::size_t>(surface_.node[b]);
    for (int k = 0; k < dim; ++k) {
      step.velocity[static_cast<std::size_t>(k)][node] += change[k];
      step.position[static_cast<std::size_t>(k)][node] += step.dt * change[k];
    }
  }
}

/// Work of each contact with the mean of the velocities before and after (design: with the predicted velocity
/// it would be wrong by its own size), split so that each part has one sign.
template<int dim>
void RigidContact<dim>::book(const std::vector<Pose<dim>>& poses, const ContactStep<dim>& step) {
  for (std::size_t t = 0; t < tools_.size(); ++t) {
    results_[t].displacement = poses[t].end;
    results_[t].force.setZero();
    results_[t].step = {};
  }
  for (const Contact<dim>& contact : contacts_) {
    const auto t = static_cast<std::size_t>(contact.tool);
    const Vec<dim> impulse = contact.impulse();
    if (impulse.squaredNorm() == 0.0) continue;
    const Vec<dim> node = at_contact(contact, [&](std::size_t b) {
      return Vec<dim>(0.5 * (before_[b] + reactions_[b].velocity + reactions_[b].change));
    });
    const Vec<dim> tool = 0.5 * (poses[t].before + poses[t].velocity);
    const double normal = (tool - node).dot(contact.normal) * contact.pressing;
    const double tangential = (tool - node).dot(contact.sliding);

    ContactWork& work = results_[t].step;
    work.workpiece += node.dot(impulse);
    work.tool += tool.dot(impulse);
    work.impact += std::max(0.0, normal);
    work.friction += std::max(0.0, tangential);
    work.recovery -= std::min(0.0, normal) + std::min(0.0, tangential);
    results_[t].force += impulse / step.dt_mean;
    results_[t].impulse += impulse;

    const double e_tool = tools_[t].thermal.effusivity;
    for (std::size_t a = 0; a < dim; ++a) {
      if (contact.weight[a] == 0.0) continue;
      const auto b = static_cast<std::size_t>(contact.node[a]);
      nodal_impulse_[b] += contact.weight[a] * impulse;
      const double heat = contact.weight[a] * std::max(0.0, tangential);
      const double share =
          step.effusivity.empty() || e_tool == 0.0 ? 1.0 : step.effusivity[b] / (step.effusivity[b] + e_tool);
      heat_[b] += share * heat;
      results_[t].heat_to_tool += (1.0 - share) * heat;
    }
  }
  for (ToolResult<dim>& result : results_) result.total += result.step;
}

template<int dim>
void RigidContact<dim>::list_points(const std::vector<Pose<dim>>& poses, const ContactStep<dim>& step) {
  points_.clear();
  for (const Contact<dim>& contact : contacts_)
    for (std::size_t a = 0; a < dim; ++a) {
      if (contact.weight[a] == 0.0 || contact.pressing == 0.0) continue;
      const auto b = static_cast<std::size_t>(contact.node[a]);
      ContactPoint<dim> point;
      point.node = surface_.node[b];
      point.boundary = contact.node[a];
      point.tool = contact.tool;
      point.area = area_[b];
      point.force = contact.weight[a] / step.dt_mean * contact.impulse();
      point.pressure = contact.weight[a] * contact.pressing / (step.dt_mean * area_[b]);
      points_.push_back(point);
    }
  merge_points();
  for (ContactPoint<dim>& point : points_) {
    const auto t = static_cast<std::size_t>(point.tool);
    const Vec<dim> x = end_[static_cast<std::size_t>(point.boundary)] - poses[t].end;
    point.gap = tools_[t].shape->closest(x).distance;
  }
}

template<int dim>
std::vector<Overlap<dim>> RigidContact<dim>::overlaps(const Fields<dim>& position, double time) const {
  std::vector<Overlap<dim>> found;
  std::vector<Vec<dim>> all, local;
  for (const std::int32_t node : surface_.node) all.push_back(at<dim>(position, node));
  const double rounding = 1e-9 * size_;
  for (std::size_t t = 0; t < tools_.size(); ++t) {
    const Vec<dim> shift = displacement(t, time);
    local = all;
    for (Vec<dim>& x : local) x -= shift;
    std::vector<Entry<dim>> entries;
    tools_[t].shape->entries(local, local, entries);
    for (const Entry<dim>& entry : entries) {
      const auto b = static_cast<std::size_t>(entry.index);
      if (entry.at.distance < -rounding)
        found.push_back({static_cast<std::int32_t>(t), surface_.node[b], -entry.at.distance, all[b], false});
    }
    for (const RidgeDepth<dim>& ridge : ridges_inside(surface_, *tools_[t].shape, all, shift))
      if (ridge.depth > rounding)
        found.push_back({static_cast<std::int32_t>(t), surface_.node[static_cast<std::size_t>(ridge.node)],
                         ridge.depth, ridge.position, true});
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
}

template class RigidContact<2>;

} // namespace cnem::contact
