#pragma once
// Bodies of 304L that benchmarks work on.
#include "clouds/generate.hpp"
#include "cnem/scni.hpp"
#include "mechanics/explicit_solver.hpp"
#include "plasticity/hardening_laws.hpp"
#include "tests/curves.hpp"

#include <memory>
#include <utility>

namespace cnem::benchmarks {

/// Free of supports and loads, C-NEM.
inline Problem<2> model_304L(const Curve& outline, const clouds::SpacingField& spacing) {
  Problem<2> model;
  model.cloud = clouds::generate_cloud({outline, {}, {}}, spacing, {}).cloud;
  model.method = std::make_unique<scni::Cnem>();
  model.materials = {
      {.name = "304L",
       .density = 7850.0,
       .elasticity = {210e9, 0.33},
       .hardening = plasticity::JohnsonCook{253e6, 685e6, 0.312, 0.0973, 1.0, 2.044, 296.0, 1698.0},
       .anisotropy = {},
       .damage = {},
       .measured = {},
       .specific_heat = 500.0,
       .conductivity = 5.86}};
  model.supports = Supports<2>({}, static_cast<std::size_t>(model.cloud.nodes()));
  model.loads = Loads<2>({}, {}, {}, model.cloud.position);
  return model;
}

/// With the given velocities, [component][node] m/s, at 296 K.
inline ExplicitSolver<2> start(Problem<2> model, Fields<2> velocity) {
  Field temperature(velocity[0].size(), 296.0);
  return ExplicitSolver<2>(std::move(model), std::move(velocity), std::move(temperature));
}

} // namespace cnem::benchmarks
