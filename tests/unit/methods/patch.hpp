#pragma once
// The affine patch test in time: a rectangle whose boundary is moved.
#include "core/index.hpp"
#include "tests/unit/mechanics/models.hpp"

#include <algorithm>
#include <memory>
#include <utility>

namespace cnem::testing {

/// Largest deviation of the interior from x = (1 + H) X, over |H X|, after the boundary has been moved by it.
inline double patch_error(std::unique_ptr<Discretisation<2>> method, double spacing, int rereference_every) {
  Mat2 H;
  H << 2e-3, 5e-3, -1e-3, -2e-3;
  const double end = 2e-5, width = 1e-2;
  Cloud<2> cloud = rectangle(width, 0.8 * width, spacing, Lattice::hexagonal, 0.1);
  std::vector<Support<2>> supports;
  for (const NodeIndex i : IndexRange<NodeIndex>(cloud.facets.size()))
    for (int k = 0; k < 2; ++k)
      supports.push_back({"side",
                          Support<2>::Kind::velocity,
                          k == 0 ? Vec2(1, 0) : Vec2(0, 1),
                          TimeTable(H.row(k).dot(cloud.position[i]) / end),
                          {i}});
  Problem<2> model = model_of(cloud, Method::sph, steel());
  model.method = std::move(method);
  model.supports = Supports<2>(std::move(supports), index_of(cloud.nodes()));
  ExplicitSolver<2> solver = start(std::move(model), [&](const Vec2& x) -> Vec2 { return H * x / end; });
  const int steps = static_cast<int>(0.4 / spacing);
  for (int n = 1; n <= steps; ++n) {
    solver.advance(end / steps);
    if (rereference_every > 0 && n % rereference_every == 0) solver.prepare();
  }
  double worst = 0.0;
  for (std::size_t i = 0; i < solver.state().node.size(); ++i) {
    const Vec2 X(solver.state().node.initial_position[0][i], solver.state().node.initial_position[1][i]);
    const Vec2 x(solver.state().node.position[0][i], solver.state().node.position[1][i]);
    worst = std::max(worst, (x - X - H * X).norm());
  }
  return worst / (H.norm() * width);
}

} // namespace cnem::testing
