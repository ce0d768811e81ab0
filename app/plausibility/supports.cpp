// Supports that prescribe different motions of one node along one direction.
#include "app/places.hpp"
#include "app/plausibility/list.hpp"
#include "app/plausibility/tool_gap.hpp"
#include "core/index.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace cnem::app {
namespace {

/// Whether two supports move what they hold alike until `end`. sign: of the second's direction beside the
/// first's.
template<int dim>
bool move_alike(const Supports<dim>& supports, std::int32_t one, std::int32_t other, double sign,
                double end) {
  constexpr int samples = 200;
  double most = 0.0, difference = 0.0; // m
  for (int k = 1; k <= samples; ++k) {
    const double t = end * k / samples, a = supports.displacement(one, t),
                 b = sign * supports.displacement(other, t);
    most = std::max({most, std::abs(a), std::abs(b)});
    difference = std::max(difference, std::abs(a - b));
  }
  constexpr double rounding = 1e-9;
  return difference <= rounding * most;
}

std::vector<NodeIndex> common(std::vector<NodeIndex> a, std::vector<NodeIndex> b) {
  std::sort(a.begin(), a.end());
  std::sort(b.begin(), b.end());
  std::vector<NodeIndex> both;
  std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(both));
  return both;
}

} // namespace

template<int dim>
void doubt_supports(const input::Case& input, const ExplicitSolver<dim>& solver, Doubts& doubts) {
  const Supports<dim>& supports = solver.conditions().supports;
  const auto& list = supports.list();
  for (std::size_t b = 1; b < list.size(); ++b)
    for (std::size_t a = 0; a < b; ++a) {
      if (list[a].name == list[b].name) continue;
      const double along = list[a].direction.dot(list[b].direction);
      constexpr double parallel = 1.0 - 1e-9;
      if (std::abs(along) < parallel) continue;
      const std::vector<NodeIndex> both = common(list[a].nodes, list[b].nodes);
      if (both.empty() || move_alike(supports, as<std::int32_t>(a), as<std::int32_t>(b),
                                     along > 0.0 ? 1.0 : -1.0, input.time.end))
        continue;
      doubts.push_back(doubt_about(
          input, "boundary." + list[b].name,
          fmt::format("prescribes another motion along {} than boundary.{} of {} that both hold, such as the "
                      "one at {}: boundary.{}, which is named first, stands there",
                      show_direction<dim>(list[b].direction), list[a].name,
                      both.size() == 1 ? "a node" : fmt::format("{} nodes", both.size()),
                      show_place<dim>(solver.conditions().cloud.position[both.front()]), list[a].name)));
    }
}

template void doubt_supports(const input::Case&, const ExplicitSolver<2>&, Doubts&);
template void doubt_supports(const input::Case&, const ExplicitSolver<3>&, Doubts&);

} // namespace cnem::app
