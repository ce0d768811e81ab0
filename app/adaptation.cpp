#include "app/adaptation.hpp"

#include "mechanics/kinematics.hpp"

#include <algorithm>
#include <cmath>

namespace cnem::app {

namespace {

std::size_t u(std::int32_t i) { return static_cast<std::size_t>(i); }

/// Nodes at which the boundary turns by more than 30 degrees.
std::vector<std::int32_t> corners(const Cloud<2>& cloud) {
  constexpr double least_cosine = 0.866;
  std::vector<std::int32_t> corner(cloud.position.size(), 0), next(corner.size(), -1);
  for (const Facet<2>& facet : cloud.facets) next[u(facet.node[0])] = facet.node[1];
  for (const Facet<2>& facet : cloud.facets) {
    const auto [a, b] = facet.node;
    const std::int32_t c = next[u(b)];
    const Vec2 in = (cloud.position[u(b)] - cloud.position[u(a)]).normalized(),
               out = (cloud.position[u(c)] - cloud.position[u(b)]).normalized();
    if (in.dot(out) < least_cosine) corner[u(b)] = 1;
  }
  return corner;
}

/// Mean distance to the neighbours each node is linked with.
Field spacing_of(const ExplicitSolver<2>& solver) {
  const StabilisationLinks<2>& links = solver.approximation().links;
  const std::vector<Vec2>& x = solver.model().cloud.position;
  Field size(x.size());
  for (std::size_t i = 0; i < size.size(); ++i) {
    double sum = 0.0;
    for (std::int32_t l = links.begin[i]; l < links.begin[i + 1]; ++l)
      sum += (x[u(links.neighbour[u(l)])] - x[i]).norm();
    size[i] = sum / static_cast<double>(links.begin[i + 1] - links.begin[i]);
  }
  return size;
}

} // namespace

Adaptation::Adaptation(const io::Case& input, const ExplicitSolver<2>& solver) : input_(&input) {
  if (!active()) return;
  size_ = spacing_of(solver);
  birth_.assign(size_.size(), 0.0);
  corner_ = corners(solver.model().cloud);
}

adapt::NodeProperties Adaptation::properties(const ExplicitSolver<2>& solver) const {
  const State<2>& state = solver.state();
  const std::size_t n = state.node.size();
  adapt::NodeProperties properties;
  properties.mass = state.node.mass;
  properties.size = size_;
  properties.held.assign(corner_.begin(), corner_.end());
  properties.log_jacobian.resize(n);
  properties.density.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    properties.log_jacobian[i] =
        std::log(jacobian<2>(state.point.deformation, i) / state.point.stress_free[i]);
    properties.density[i] = solver.model().materials[u(state.point.material[i])].density;
  }
  return properties;
}

Resampling<2> Adaptation::renew(ExplicitSolver<2>& solver) {
  adapt::PassReport report;
  Resampling<2> change = adapt::resample(solver.present_cloud(), properties(solver), {},
                                         static_cast<adapt::Placement>(input_->adapt.placement), report);
  solver.prepare(change);
  carry_label(change.labels, size_);
  carry_label(change.labels, birth_);
  for (std::size_t p = 0; p < change.old_of.size(); ++p)
    if (change.old_of[p] < 0) birth_[p] = solver.state().time;
  std::vector<std::int32_t> corner(change.old_of.size(), 0);
  for (std::size_t p = 0; p < corner.size(); ++p)
    if (change.old_of[p] >= 0) corner[p] = corner_[u(change.old_of[p])];
  corner_ = std::move(corner);
  ++passes_;
  total_ += report;
  return change;
}

std::vector<std::pair<std::string, double>> Adaptation::metrics() const {
  if (!active()) return {};
  return {{"adapt.passes", static_cast<double>(passes_)},
          {"adapt.outside", total_.outside},
          {"adapt.removed", total_.removed},
          {"adapt.removed_boundary", total_.removed_boundary},
          {"adapt.promoted", total_.promoted},
          {"adapt.inserted", total_.inserted},
          {"adapt.inserted_boundary", total_.inserted_boundary},
          {"adapt.balanced", total_.balanced},
          {"adapt.undone", total_.undone},
          {"adapt.area_change", total_.area_change}};
}

void Adaptation::archive(Archive& archive) {
  if (!active()) return;
  archive.integers("run/adapt/corner", corner_);
  if (archive.loading()) {
    size_.resize(corner_.size());
    birth_.resize(corner_.size());
  }
  archive.field("run/adapt/size", "m", size_);
  archive.field("run/adapt/birth", "s", birth_);
  archive.integer("run/adapt/passes", passes_);
  for (auto& [name, count] : {std::pair{"outside", &total_.outside},
                              {"removed", &total_.removed},
                              {"removed_boundary", &total_.removed_boundary},
                              {"promoted", &total_.promoted},
                              {"inserted", &total_.inserted},
                              {"inserted_boundary", &total_.inserted_boundary},
                              {"balanced", &total_.balanced},
                              {"undone", &total_.undone}})
    archive.integer(fmt::format("run/adapt/count/{}", name), *count);
  archive.number("run/adapt/area_change", "m^2", total_.area_change);
}

} // namespace cnem::app
