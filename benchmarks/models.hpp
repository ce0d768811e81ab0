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

inline plasticity::Material steel_304L() {
  plasticity::Material steel;
  steel.name = "304L";
  steel.density = 7850.0;
  steel.elasticity = {210e9, 0.33};
  steel.hardening = plasticity::JohnsonCook{253e6, 685e6, 0.312, 0.0973, 1.0, 2.044, 296.0, 1698.0};
  steel.specific_heat = 500.0;
  steel.conductivity = 5.86;
  return steel;
}

/// A cloud free of supports and loads.
template<int dim> Problem<dim> model_304L(Cloud<dim> cloud, std::unique_ptr<Discretisation<dim>> method) {
  Problem<dim> model;
  model.cloud = std::move(cloud);
  model.method = std::move(method);
  model.materials = {steel_304L()};
  model.supports = Supports<dim>({}, static_cast<std::size_t>(model.cloud.nodes()));
  model.loads = Loads<dim>({}, {}, {}, model.cloud.position);
  return model;
}

/// C-NEM in the plane.
inline Problem<2> model_304L(const Curve& outline, const clouds::SpacingField& spacing) {
  return model_304L<2>(clouds::generate_cloud({outline, {}, {}}, spacing, {}).cloud,
                       std::make_unique<scni::Cnem>());
}

/// With the given velocities, [component][node] m/s, at 296 K.
template<int dim> ExplicitSolver<dim> start(Problem<dim> model, Fields<dim> velocity) {
  Field temperature(velocity[0].size(), 296.0);
  return ExplicitSolver<dim>(std::move(model), std::move(velocity), std::move(temperature));
}

} // namespace cnem::benchmarks
