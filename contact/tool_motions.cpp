#include "contact/tool_motions.hpp"

#include "core/error.hpp"
#include "core/index.hpp"

#include <algorithm>
#include <cmath>
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

template<int dim>
ToolMotions<dim>::ToolMotions(const Tools<dim>& tools) : body_(tools.size()), acting_(tools.size()) {
  for (const ToolIndex t : tools.indices())
    if (tools[t].drive) body_[t].velocity = tools[t].drive->free * tools[t].drive->initial_velocity;
}

/// By how far the spring of a tool has been pressed back since the start, m.
template<int dim> double ToolMotions<dim>::travel(const Tool<dim>& tool, ToolIndex t, double time) const {
  return tool.drive->spring->along.dot(tool.motion.displacement(time) - body_[t].displacement);
}

/// Takes down what acts over [from, to], around `time`.
template<int dim>
void ToolMotions<dim>::act(const Tool<dim>& tool, ToolIndex t, double time, double from, double to) {
  const ToolDrive<dim>& drive = *tool.drive;
  Acting& acting = acting_[t];
  acting.dt_mean = to - from;
  acting.force = impulse(drive, from, to);
  const Vec<dim> way = tool.motion.displacement(to) - tool.motion.displacement(from);
  acting.mount = drive.free * way / acting.dt_mean;
  if (!drive.spring) return;
  const auto& [spring, along] = *drive.spring;
  const double s = travel(tool, t, time), force = spring.force(s);
  if (!std::isfinite(force))
    throw DivergenceError(
        fmt::format("the spring of tool '{}' is pressed back by {:.3g} m at t = {:.6g} s, to the end of its "
                    "way: tools.{}.spring.length is too short for this stroke",
                    tool.name, s, time, tool.name),
        -1, "tool spring");
  acting.spring = (spring.charge.integral(to) - spring.charge.integral(from)) * force * along;
  acting.travel = along.dot(tool.motion.displacement(to));
  acting.charge = spring.charge(to);
  acting.charging = (acting.charge - spring.charge(from)) * spring.energy(s);
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
      const Body& body = body_[t];
      act(tool, t, time, time - 0.5 * dt_before, time + 0.5 * dt);
      const Acting& acting = acting_[t];
      const double damped = 0.5 * tool.drive->damping * acting.dt_mean;
      pose.start = body.displacement;
      pose.before = body.velocity;
      pose.velocity = body.velocity +
                      (acting.force + acting.spring + 2.0 * damped * Vec<dim>(acting.mount - body.velocity)) /
                          (tool.drive->mass + damped);
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
    if (const auto& drive = tools[t].drive)
      all[t].inverse = drive->free / (drive->mass + 0.5 * drive->damping * acting_[t].dt_mean);
    all[t].position = poses[t].end;
    all[t].velocity = poses[t].velocity;
  }
  return all;
}

template<int dim> void ToolMotions<dim>::accept(const Tools<dim>& tools, const Poses<dim>& poses) {
  for (const ToolIndex t : tools.indices()) {
    if (!tools[t].drive) continue;
    Body& body = body_[t];
    const Acting& acting = acting_[t];
    const Vec<dim> mean = 0.5 * (poses[t].before + poses[t].velocity);
    body.work += acting.force.dot(mean);
    const double lossy = tools[t].drive->damping * acting.dt_mean;
    if (lossy > 0.0) {
      body.work += lossy * (acting.mount - mean).dot(acting.mount);
      body.damping += lossy * (acting.mount - mean).squaredNorm();
    }
    body.displacement = poses[t].end;
    body.velocity = poses[t].velocity;
    if (const auto& sprung = tools[t].drive->spring) {
      body.work += acting.spring.dot(acting.mount) + acting.charging;
      const Vec<dim> half = 0.5 * (poses[t].start + poses[t].end);
      body.stored = acting.charge * sprung->spring.energy(acting.travel - sprung->along.dot(half));
    }
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
    sum.springs += body_[t].stored;
    sum.damping += body_[t].damping;
  }
  return sum;
}

template<int dim>
double ToolMotions<dim>::spring_force(const Tool<dim>& tool, std::size_t t, double time) const {
  if (!tool.drive || !tool.drive->spring) return 0.0;
  const Spring& spring = tool.drive->spring->spring;
  return spring.charge(time) * spring.force(travel(tool, as<ToolIndex>(t), time));
}

template<int dim> double ToolMotions<dim>::stable_step(const Tools<dim>& tools, double time) const {
  double least = infinite;
  for (const ToolIndex t : tools.indices()) {
    const auto& drive = tools[t].drive;
    if (!drive || !drive->spring) continue;
    const double slope = drive->spring->spring.slope(travel(tools[t], t, time));
    if (slope > 0.0) least = std::min(least, 2.0 * std::sqrt(drive->mass / slope));
  }
  return least;
}

template<int dim> void ToolMotions<dim>::archive(Archive& archive, std::size_t t) {
  const std::string at = fmt::format("solver/tools/{}/body/", t);
  archive.vector<dim>(at + "displacement", "m", body_[t].displacement);
  archive.vector<dim>(at + "velocity", "m/s", body_[t].velocity);
  archive.number(at + "work", "J/m", body_[t].work);
  archive.number(at + "stored", "J/m", body_[t].stored);
  archive.number(at + "damping", "J/m", body_[t].damping);
}

template class ToolMotions<2>;
template class ToolMotions<3>;

} // namespace cnem::contact
