// Several steps of contact reported as one: what local time steps show of a macro step.
#include "contact/contact.hpp"

#include <algorithm>
#include <utility>

namespace cnem::contact {

/// One entry for each node and tool, the last of them.
template<int dim> void RigidContact<dim>::merge_points() {
  const auto before = [](const ContactPoint<dim>& a, const ContactPoint<dim>& b) {
    return std::pair(a.tool, a.node) < std::pair(b.tool, b.node);
  };
  if (!std::is_sorted(points_.begin(), points_.end(), before))
    std::stable_sort(points_.begin(), points_.end(), before);
  std::size_t kept = 0;
  for (const ContactPoint<dim>& point : points_) {
    const bool again = kept > 0 && !before(points_[kept - 1], point);
    points_[again ? kept - 1 : kept++] = point;
  }
  points_.resize(kept);
}

/// A node against several facets has its area shared out to them; of a pair in several sub-steps the last
/// counts.
template<int dim> void RigidContact<dim>::merge_touches() {
  const auto by_node = [](const BodyTouch<dim>& a, const BodyTouch<dim>& b) { return a.node < b.node; };
  std::stable_sort(touches_.begin(), touches_.end(), by_node);
  std::vector<BodyTouch<dim>> merged;
  for (auto from = touches_.begin(); from != touches_.end();) {
    const auto to = std::upper_bound(from, touches_.end(), *from, by_node);
    const std::size_t first = merged.size();
    for (auto touch = from; touch != to; ++touch) {
      const auto same =
          std::find_if(merged.begin() + static_cast<std::ptrdiff_t>(first), merged.end(),
                       [&](const BodyTouch<dim>& other) { return other.facet == touch->facet; });
      if (same == merged.end())
        merged.push_back(*touch);
      else
        *same = *touch;
    }
    for (std::size_t k = first; k < merged.size(); ++k)
      merged[k].area /= static_cast<double>(merged.size() - first);
    from = to;
  }
  touches_ = std::move(merged);
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
  sub_steps_.touches.clear();
  sub_steps_.rubbed.clear();
  sub_steps_.heat.assign(heat_.size(), 0.0);
  sub_steps_.nodal_impulse.assign(nodal_impulse_.size(), Vec<dim>::Zero());
}

template<int dim> void RigidContact<dim>::add_sub_step(double dt_mean) {
  sub_steps_.pressing += dt_mean * body_result_.pressing;
  sub_steps_.points.insert(sub_steps_.points.end(), points_.begin(), points_.end());
  sub_steps_.touches.insert(sub_steps_.touches.end(), touches_.begin(), touches_.end());
  sub_steps_.rubbed.insert(sub_steps_.rubbed.end(), rubbed_.begin(), rubbed_.end());
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
  std::swap(points_, sub_steps_.points);
  merge_points();
  std::swap(touches_, sub_steps_.touches);
  merge_touches();
  std::swap(rubbed_, sub_steps_.rubbed);
  std::swap(heat_, sub_steps_.heat);
  std::swap(nodal_impulse_, sub_steps_.nodal_impulse);
}

template void RigidContact<2>::merge_points();
template void RigidContact<2>::merge_touches();
template void RigidContact<2>::begin_sub_steps();
template void RigidContact<2>::add_sub_step(double);
template void RigidContact<2>::end_sub_steps(double);
template void RigidContact<3>::merge_points();
template void RigidContact<3>::merge_touches();
template void RigidContact<3>::begin_sub_steps();
template void RigidContact<3>::add_sub_step(double);
template void RigidContact<3>::end_sub_steps(double);

} // namespace cnem::contact
