#pragma once
// The body that whole steps are measured on.
#include "benchmarks/models.hpp"

#include <cmath>
#include <utility>
#include <vector>

namespace cnem::benchmarks {

/// A 304L block in steady simple shear at 1e5 /s, its boundary driven, so that every node flows.
inline ExplicitSolver<2> sheared_block(int nodes) {
  const double size = 1e-2;
  clouds::SpacingField spacing;
  spacing.spacing = size / std::sqrt(nodes * std::sqrt(0.75));
  Problem<2> model = model_304L(testing::box({0, 0}, {size, size}, "side"), spacing);
  const auto n = static_cast<std::size_t>(model.cloud.nodes());
  const double rate = 1e5;
  std::vector<Support<2>> supports;
  for (const Facet<2>& facet : model.cloud.facets) {
    const NodeIndex i = facet.node[0];
    const double vx = rate * model.cloud.position[i].y();
    supports.push_back({"side", Support<2>::Kind::velocity, Vec2(1, 0), TimeTable(vx), {i}});
    supports.push_back({"side", Support<2>::Kind::velocity, Vec2(0, 1), TimeTable(0.0), {i}});
  }
  model.supports = Supports<2>(std::move(supports), n);
  Fields<2> velocity;
  resize_all(velocity, n);
  for (std::size_t i = 0; i < n; ++i) velocity[0][i] = rate * model.cloud.position[i].y();
  return start(std::move(model), std::move(velocity));
}

} // namespace cnem::benchmarks
