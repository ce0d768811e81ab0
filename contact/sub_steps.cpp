// Several steps of contact reported as one: what local time steps show of a macro step.
#include "contact/contact.hpp"

#include <algorithm>
#include <utility>

namespace cnem::contact {

/// One entry for each node and tool: forces and pressures add up, the rest is of the last one.
template<int dim> void RigidContact<dim>::merge_points() {
  std::stable_sort(points_.begin(), points_.end(),
                   [](const ContactPoint<dim>& a, const ContactPoint<dim>& b) {
                     return std::pair(a.tool, a.node) < std::pair(b.tool, b.node);
                   });
  std::size_t kept = 0;
  for (const ContactPoint<dim>& point : points_) {
    if (kept > 0 && points_[kept - 1].tool == point.tool && points_[kept - 1].node == point.node) {
      ContactPoint<dim> sum = point;
      sum.force += points_[kept - 1].force;
      sum.pressure += points_[kept - 1].pressure;
      points_[kept - 1] = sum;
    } else {
      points_[kept++] = point;
    }
  }
  points_.resize(kept);
}

namespace {

ContactWork between(const ContactWork& from, const ContactWork& to) {
  return {.workpiece = to.workpiece - from.workpiece,
          .tool = to.tool - from.tool,
          .recovery = to.recovery - from.recovery,
          .friction = to.friction - from.friction,
          .impact = to.impact - from.impact};
}

} // namespace

template<int dim> void RigidContact<dim>::begin_sub_steps() {
  in_sub_steps_ = true;
  sub_steps_.start = results_;
  sub_steps_.bodies = body_result_.total;
  sub_steps_.pressing = 0.0;
  sub_steps_.points.clear();
  sub_steps_.heat.assign(heat_.size(), 0.0);
  sub_steps_.nodal_impulse.assign(nodal_impulse_.size(), Vec<dim>::Zero());
}

template<int dim> void RigidContact<dim>::add_sub_step(double dt_mean) {
  sub_steps_.pressing += dt_mean * body_result_.pressing;
  for (ContactPoint<dim> point : points_) {
    point.force *= dt_mean;
    point.pressure *= dt_mean;
    sub_steps_.points.push_back(point);
  }
  for (const BoundaryNodeIndex b : heat_.indices()) {
    sub_steps_.heat[b] += heat_[b];
    sub_steps_.nodal_impulse[b] += nodal_impulse_[b];
  }
}

template<int dim> void RigidContact<dim>::end_sub_steps(double duration) {
  in_sub_steps_ = false;
  for (const ToolIndex t : results_.indices()) {
    ToolResult<dim>& result = results_[t];
    const ToolResult<dim>& start = sub_steps_.start[t];
    result.force = (result.impulse - start.impulse) / duration;
    result.step = between(start.total, result.total);
  }
  body_result_.pressing = sub_steps_.pressing / duration;
  body_result_.step = between(sub_steps_.bodies, body_result_.total);
  points_ = std::move(sub_steps_.points);
  for (ContactPoint<dim>& point : points_) {
    point.force /= duration;
    point.pressure /= duration;
  }
  merge_points();
  std::swap(heat_, sub_steps_.heat);
  std::swap(nodal_impulse_, sub_steps_.nodal_impulse);
}

template void RigidContact<2>::merge_points();
template void RigidContact<2>::begin_sub_steps();
template void RigidContact<2>::add_sub_step(double);
template void RigidContact<2>::end_sub_steps(double);
template void RigidContact<3>::merge_points();
template void RigidContact<3>::begin_sub_steps();
template void RigidContact<3>::add_sub_step(double);
template void RigidContact<3>::end_sub_steps(double);

} // namespace cnem::contact
