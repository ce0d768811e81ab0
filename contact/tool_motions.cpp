#include "contact/tool_motions.hpp"

#include "core/index.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace cnem::contact {
namespace {

/// ∫F dt over [from, to] along the directions the tool may move in.
template<int dim> Vec<dim> impulse(const ToolDrive<dim>& drive, double from, double to) {
  Vec<dim> sum;
  for (int k = 0; k < dim; ++k) {
    const TimeTable& force = drive.force[index_of(k)];
    sum[k] = force.integral(to) - force.integral(from);
  }
  return drive.free * sum;
}

} // namespace

template<int dim> ToolMotions<dim>::ToolMotions(const Tools<dim>& tools) : body_(tools.size()) {
  for (const ToolIndex t : tools.indices())
    if (tools[t].drive) body_[t].velocity = tools[t].drive->free * tools[t].drive->initial_velocity;
}

template<int dim>
Poses<dim> ToolMotions<dim>::predict(const Tools<dim>& tools, double time, double dt, double dt_mean) {
  Poses<dim> all;
  const double dt_before = 2.0 * dt_mean - dt;
  double fastest = 0.0;
  for (const ToolIndex t : tools.indices()) {
    const Tool<dim>& tool = tools[t];
    Pose<dim> pose;
    if (tool.drive) {
      Body& body = body_[t];
      body.impulse = impulse(*tool.drive, time - 0.5 * dt_before, time + 0.5 * dt);
      pose.start = body.displacement;
      pose.before = body.velocity;
      pose.velocity = body.velocity + body.impulse / tool.drive->mass;
      pose.end = pose.start + dt * pose.velocity;
    } else {
      pose.start = tool.motion.displacement(time);
      pose.end = tool.motion.displacement(time + dt);
      pose.velocity = (pose.end - pose.start) / dt;
      pose.before = dt_before > 1e-9 * dt
                        ? Vec<dim>((pose.start - tool.motion.displacement(time - dt_before)) / dt_before)
                        : tool.motion.velocity_at(time);
    }
    fastest = std::max(fastest, pose.velocity.norm());
    all.push_back(pose);
  }
  for (Pose<dim>& pose : all) pose.recovery = 0.5 * fastest;
  return all;
}

template<int dim>
ReactionsOfTools<dim> ToolMotions<dim>::reactions(const Tools<dim>& tools, const Poses<dim>& poses) const {
  ReactionsOfTools<dim> all(tools.size());
  for (const ToolIndex t : tools.indices()) {
    if (tools[t].drive) all[t].inverse = tools[t].drive->free / tools[t].drive->mass;
    all[t].position = poses[t].end;
    all[t].velocity = poses[t].velocity;
  }
  return all;
}

template<int dim> void ToolMotions<dim>::accept(const Tools<dim>& tools, const Poses<dim>& poses) {
  for (const ToolIndex t : tools.indices()) {
    if (!tools[t].drive) continue;
    Body& body = body_[t];
    body.work += 0.5 * body.impulse.dot(poses[t].before + poses[t].velocity);
    body.displacement = poses[t].end;
    body.velocity = poses[t].velocity;
  }
}

template<int dim>
Vec<dim> ToolMotions<dim>::displacement(const Tool<dim>& tool, std::size_t t, double time) const {
  return tool.drive ? body_[t].displacement : tool.motion.displacement(time);
}

template<int dim>
Vec<dim> ToolMotions<dim>::velocity(const Tool<dim>& tool, std::size_t t, double time) const {
  return tool.drive ? body_[t].velocity : tool.motion.velocity_at(time);
}

template<int dim> DriveEnergy ToolMotions<dim>::energy(const Tools<dim>& tools) const {
  DriveEnergy sum;
  for (const ToolIndex t : tools.indices()) {
    if (!tools[t].drive) continue;
    sum.kinetic += 0.5 * tools[t].drive->mass * body_[t].velocity.squaredNorm();
    sum.work += body_[t].work;
  }
  return sum;
}

template<int dim> void ToolMotions<dim>::archive(Archive& archive, std::size_t t) {
  const std::string at = fmt::format("solver/tools/{}/body/", t);
  archive.vector<dim>(at + "displacement", "m", body_[t].displacement);
  archive.vector<dim>(at + "velocity", "m/s", body_[t].velocity);
  archive.number(at + "work", "J/m", body_[t].work);
}

template class ToolMotions<2>;
template class ToolMotions<3>;

} // namespace cnem::contact
