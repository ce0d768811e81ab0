// Cohesive interfaces whose zone of softening has too few cells.
#include "app/plausibility/list.hpp"
#include "core/index.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace cnem::app {

namespace {

/// E' of a crack along the facet from a to b, Pa: K²/E' is what it lets go per area.
double crack_modulus_of(const input::Case& input, const plasticity::Material& material, const Vec2& a,
                        const Vec2& b) {
  const bool stress_free = input.analysis.kinematics == input::Analysis::Kinematics::plane_stress;
  const Vec2 along = b - a;
  if (material.ply)
    return plasticity::crack_modulus(plasticity::ply_constants(*material.ply, stress_free),
                                     std::atan2(along.y(), along.x()) - material.ply->angle);
  const auto& [young, poisson] = material.elasticity;
  return stress_free ? young : young / (1.0 - poisson * poisson);
}

} // namespace

void doubt_interfaces(const input::Case& input, const ExplicitSolver<2>& solver, Doubts& doubts) {
  constexpr double asked = 5.5; // cells; 5.3 stick, 6 do not: docs/theory.md, Cohesive interfaces
  const Cloud<2>& cloud = solver.conditions().cloud;
  for (const CohesiveInterface& interface : solver.conditions().cohesive.interfaces()) {
    const plasticity::CohesiveLaw& law = interface.spec.law;
    const double by_modulus = law.energy / (law.strength * law.strength); // the zone over E'
    double fewest = std::numeric_limits<double>::infinity(), zone = 0.0, cell = 0.0;
    for (const auto& face : interface.face)
      for (const BondedSegment& segment : face) {
        const plasticity::Material& material =
            solver.model().materials[index_of(solver.state().node.material[index_of(segment.node[0])])];
        const double length = by_modulus * crack_modulus_of(input, material, cloud.position[segment.node[0]],
                                                            cloud.position[segment.node[1]]);
        const double own = std::min(segment.arc[1] - segment.arc[0], adapted_spacing(input));
        if (length / own < fewest) fewest = length / own, zone = length, cell = own;
      }
    if (fewest < asked)
      doubts.push_back(doubt_about(
          input, fmt::format("domain.interfaces.{}.cohesive", interface.spec.name),
          fmt::format("it softens over E' G/strength² = {:.3g} mm ahead of a crack, {:.2g} cells of {:.3g} "
                      "mm: below {:g} a crack sticks and jumps; expected a spacing of {:.3g} mm at most, or "
                      "a strength of {:.3g} MPa at most, which leaves the energy as it is",
                      1e3 * zone, fewest, 1e3 * cell, asked, 1e3 * zone / asked,
                      1e-6 * law.strength * std::sqrt(fewest / asked))));
  }
}

} // namespace cnem::app
