#pragma once
// The body that whole steps are measured on.
#include "cnem/scni.hpp"
#include "mechanics/explicit_solver.hpp"
#include "voronoi/generate.hpp"

#include <cmath>
#include <memory>
#include <utility>
#include <vector>

namespace cnem::benchmarks {

/// A 304L block in steady simple shear at 1e5 /s, its boundary driven, so that every node flows.
inline ExplicitSolver<2> sheared_block(int nodes) {
  CurvePiece side;
  voronoi::DomainShape domain;
  const double size = 1e-2;
  const Vec2 corner[4] = {{0, 0}, {size, 0}, {size, size}, {0, size}};
  for (int i = 0; i < 4; ++i) {
    side.from = corner[i];
    side.to = corner[(i + 1) % 4];
    side.name = "side";
    domain.outer.pieces.push_back(side);
  }
  voronoi::SpacingField spacing;
  spacing.spacing = size / std::sqrt(nodes * std::sqrt(0.75));
  Model<2> model;
  model.cloud = voronoi::generate_cloud(domain, spacing, {}).cloud;
  model.method = std::make_unique<scni::Cnem>();
  model.materials = {
      {.name = "304L",
       .density = 7850.0,
       .elasticity = {210e9, 0.33},
       .hardening = plasticity::JohnsonCook{253e6, 685e6, 0.312, 0.0973, 1.0, 2.044, 296.0, 1698.0},
       .damage = {},
       .specific_heat = 500.0,
       .conductivity = 5.86}};
  const auto n = static_cast<std::size_t>(model.cloud.nodes());
  const double rate = 1e5;
  std::vector<Support<2>> supports;
  for (const Facet<2>& facet : model.cloud.facets) {
    const std::int32_t i = facet.node[0];
    const double vx = rate * model.cloud.position[static_cast<std::size_t>(i)].y();
    supports.push_back({"side", Support<2>::Kind::velocity, Vec2(1, 0), TimeTable(vx), {i}});
    supports.push_back({"side", Support<2>::Kind::velocity, Vec2(0, 1), TimeTable(0.0), {i}});
  }
  model.supports = Supports<2>(std::move(supports), n);
  model.loads = Loads<2>({}, {}, {}, model.cloud.position);
  Fields<2> velocity;
  resize_all(velocity, n);
  for (std::size_t i = 0; i < n; ++i) velocity[0][i] = rate * model.cloud.position[i].y();
  return ExplicitSolver<2>(std::move(model), std::move(velocity), Field(n, 296.0));
}

} // namespace cnem::benchmarks
