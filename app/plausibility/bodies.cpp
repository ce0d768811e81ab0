// Cells beside the length that breaking has, and parts that nothing keeps apart.
#include "app/plausibility/list.hpp"
#include "core/index.hpp"
#include "mechanics/statics/rigid_motion.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <set>

namespace cnem::app {

namespace {

/// The finest cells there will be, m.
double finest_spacing(const input::Case& input, const ExplicitSolver<2>& solver) {
  const Field& volume = solver.approximation().node_volume;
  const Cloud<2>& cloud = solver.conditions().cloud;
  double finest = INFINITY;
  for (std::size_t i = 0; i < volume.size(); ++i) {
    const double around =
        input.analysis.space() == Space::revolution ? cloud.position[i].x() * 2.0 * M_PI : 1.0;
    if (around > 0.0) finest = std::min(finest, std::sqrt(volume[i] / around));
  }
  return std::min(finest, adapted_spacing(input));
}

void doubt_fracture(const input::Case& input, const ExplicitSolver<2>& solver, Doubts& doubts) {
  const double spacing = finest_spacing(input, solver);
  for (const plasticity::Material* one : materials_in_use(input)) {
    const plasticity::Material& material = *one;
    if (!material.damage || !material.hardening) continue;
    const double flow = material.hardening->flow_stress(0.0, 1.0, input.initial.temperature);
    const double opening = 2.0 * material.damage->fracture_energy / flow;
    if (spacing > opening)
      doubts.push_back(doubt_about(
          input, fmt::format("materials.{}.damage.fracture_energy", material.name),
          fmt::format(
              "with {:.3g} J/m² a crack has opened by 2 G_f/σ_y = {:.3g} mm when nothing holds it, which is "
              "less than the finest spacing, {:.3g} mm: cells break at once, one after another",
              material.damage->fracture_energy, 1e3 * opening, 1e3 * spacing)));
  }
}

void doubt_parts(const input::Case& input, const ExplicitSolver<2>& solver, Doubts& doubts) {
  if (input.contact.active || !input.domain.interfaces.empty() || !input.periodic.empty()) return;
  const std::vector<std::size_t> root =
      parts_of(solver.approximation().mechanics, solver.state().node.size());
  const std::set<std::size_t> parts(root.begin(), root.end());
  if (parts.size() > 1)
    doubts.push_back(doubt_about(
        input, "contact.deformable",
        fmt::format("the workpiece has {} parts that pass through each other where they meet, expected "
                    "contact.deformable = true",
                    parts.size())));
}

} // namespace

void doubt_bodies(const input::Case& input, const ExplicitSolver<2>& solver, Doubts& doubts) {
  doubt_fracture(input, solver, doubts);
  doubt_parts(input, solver, doubts);
}

} // namespace cnem::app
