#pragma once
// What operators in space keep on any cloud whose boundary is recovered: told in words where it is broken.
#include "cnem/space.hpp"
#include "core/geometry/facets.hpp"
#include "core/operators/operator_checks.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <numeric>
#include <string>
#include <vector>

namespace cnem::testing {

/// Positive volumes that fill the body to 1e-12; to 1e-11, in units of the spacing, the gradients of
/// constants and linear fields, and constant stress in balance with its tractions. thin: gradients of cells
/// whose volume is below it, over the cube of the spacing, are let go by rounding over their volume, at most
/// 1e-6. Empty: all is well.
inline std::string broken_promise(const Cloud<3>& cloud, const DiscreteOperators<3>& op, double spacing,
                                  double thin = 0.0) {
  constexpr double rounding = 1e-11, most = 1e-6;
  if (!rows_are_complete(op)) return "rows are not complete";
  const double filled =
      std::accumulate(op.volume.begin(), op.volume.end(), 0.0) / enclosed_measure(cloud) - 1.0;
  if (!(std::abs(filled) <= 1e-12)) return fmt::format("volumes are off by {:.3g}", filled);
  std::vector<Vec3> force(cloud.position.size(), Vec3::Zero());
  for (std::size_t i = 0; i < op.volume.size(); ++i) {
    if (!(op.volume[i] > 0.0)) return fmt::format("volume {:.3g} of node {}", op.volume[i], i);
    Vec3 sum = Vec3::Zero();
    Mat<3> positions = -Mat<3>::Identity();
    for (auto e = index_of(op.row_begin[i]); e < index_of(op.row_begin[i + 1]); ++e) {
      const Vec3 b(op.gradient[0][e], op.gradient[1][e], op.gradient[2][e]);
      sum += b;
      // from the node: from the origin the rounding of a constant counts as often as it is spacings away
      positions += (cloud.position[op.node[e]] - cloud.position[as<NodeIndex>(i)]) * b.transpose();
      force[index_of(op.node[e])] += op.volume[i] * b;
    }
    const double volume = op.volume[i] / (spacing * spacing * spacing);
    const double allowed = volume < thin ? std::min(most, rounding * thin / volume) : rounding;
    if (!(sum.norm() * spacing <= allowed))
      return fmt::format("a constant has the gradient {:.3g} at node {}", sum.norm(), i);
    if (!(positions.norm() <= allowed))
      return fmt::format("positions are off their gradient by {:.3g} at node {}", positions.norm(), i);
  }
  for (const auto& facet : cloud.facets)
    for (const NodeIndex i : facet.node)
      force[index_of(i)] -= area_normal<3>(corners_of<3>(facet, cloud.position)) / 3.0;
  for (const Vec3& f : force)
    if (!(f.norm() <= rounding * spacing * spacing))
      return fmt::format("constant stress leaves the force {:.3g} at node {}", f.norm(), &f - force.data());
  return {};
}

/// The choices of cells, functions and points on facets.
inline const std::vector<scni::SpaceOptions>& space_options() {
  using enum voronoi::Functions;
  using enum scni::CellKind;
  static const std::vector<scni::SpaceOptions> list{
      {.cells = median},
      {.cells = voronoi, .functions = laplace, .gauss_points = 1},
      {.cells = voronoi, .functions = laplace, .gauss_points = 3},
      {.cells = voronoi, .functions = sibson, .gauss_points = 1},
      {.cells = voronoi, .functions = sibson, .gauss_points = 3}};
  return list;
}

} // namespace cnem::testing
