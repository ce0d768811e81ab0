#pragma once
// Graded bodies for tests of local time steps.
#include "clouds/generate.hpp"
#include "tests/unit/mechanics/tools.hpp"

#include <cmath>
#include <vector>

namespace cnem::testing {

/// Rectangle [0, a] × [0, b] with sides 0 bottom, 1 right, 2 top, 3 left; `fine` along the polyline,
/// growing to `coarse`.
inline Cloud<2> graded_rectangle(double a, double b, double coarse, double fine, std::vector<Vec2> along,
                                 double growth = 0.3) {
  clouds::DomainShape domain;
  domain.outer = box({0, 0}, {a, b});
  const char* name[4] = {"bottom", "right", "top", "left"};
  for (std::size_t k = 0; k < 4; ++k) domain.outer.pieces[k].name = name[k];
  clouds::SpacingField spacing;
  spacing.spacing = coarse;
  spacing.refinements = {{.points = std::move(along), .spacing = fine, .growth = growth}};
  return clouds::generate_cloud(domain, spacing, {}).cloud;
}

/// A half blank between punch and die, refined where it will shear, with friction and heat: spacings differ
/// by a factor of 8.
inline Problem<2> graded_shearing(double speed, double coarse = 4e-4) {
  const double fine = coarse / 8.0, clearance = 1e-4, edge = 4e-3;
  Cloud<2> cloud = graded_rectangle(10e-3, 4e-3, coarse, fine, {{edge, 0}, {edge, 4e-3}});
  std::vector<Support<2>> axis{
      {"axis", Support<2>::Kind::symmetry, Vec2(-1, 0), {}, nodes_on(cloud, 3_piece)}};
  Problem<2> model = model_of(cloud, Method::cnem, steel_304L());
  model.supports = Supports<2>(std::move(axis), static_cast<std::size_t>(cloud.nodes()));
  const contact::Friction friction = contact::TrescaLimited{0.1, 0.5};
  model.contact = contact::RigidContact<2>(
      {warm_box("punch", {-1e-3, 4e-3}, {edge - clearance, 8e-3}, {0, -speed}, friction),
       warm_box("die", {edge + clearance, -4e-3}, {12e-3, 0}, {0, 0}, friction),
       warm_box("holder", {edge + clearance, 4e-3}, {12e-3, 8e-3}, {0, 0}, friction)});
  model.viscosity = {1.2, 0.06};
  model.thermal = true;
  return model;
}

inline ExplicitSolver<2> at_rest(Problem<2> model) {
  return start(std::move(model), [](const Vec2&) -> Vec2 { return {0, 0}; });
}

/// To a time; every `rereference_every` calls of `advance` on a new reference.
inline void advance(ExplicitSolver<2>& solver, double end, int rereference_every = 0) {
  double dt = 0.0;
  for (int n = 0; solver.state().time < end * (1.0 - 1e-9); ++n) {
    const bool rereference = rereference_every > 0 && n % rereference_every == rereference_every - 1;
    if (rereference) solver.prepare();
    if (n % 4 == 0 || rereference) dt = solver.stable_step().dt;
    const double left = end - solver.state().time;
    solver.advance(left / std::ceil(left / dt * (1.0 - 1e-9)));
  }
}

/// All fields of a state, one after the other.
inline Field all_of(const ExplicitSolver<2>& solver) {
  const State<2>& s = solver.state();
  Field all;
  const auto add = [&](const Field& f) { all.insert(all.end(), f.begin(), f.end()); };
  for (const Fields<2>* f : {&s.node.position, &s.node.velocity, &s.node.force})
    for (const Field& component : *f) add(component);
  add(s.node.temperature);
  for (const Field& f : s.point.piola) add(f);
  add(s.point.plastic_strain);
  return all;
}

/// A square whose middle is twelve times as fine as its sides, in four levels.
inline Problem<2> graded_square() {
  Problem<2> model = model_of(graded_rectangle(1e-2, 1e-2, 3e-4, 2.5e-5, {{4.9e-3, 5e-3}, {5.1e-3, 5e-3}}),
                              Method::cnem, steel());
  model.local = {.on = true, .least_gain = 0.0};
  return model;
}

} // namespace cnem::testing
