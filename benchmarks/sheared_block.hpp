#pragma once
// The bodies that whole steps are measured on: blocks of 304L in steady simple shear at 1e5 /s, their
// boundary driven, so that every node flows.
#include "benchmarks/models.hpp"
#include "clouds/tetrahedral_block.hpp"
#include "cnem/space.hpp"
#include "tests/clouds.hpp"
#include "voronoi/space/recovery.hpp"

#include <cmath>
#include <map>
#include <utility>
#include <vector>

namespace cnem::benchmarks {

inline constexpr double block_edge = 1e-2; ///< m

/// The block in the plane or in space, whose cloud and method the model has.
template<int dim> ExplicitSolver<dim> sheared(Problem<dim> model) {
  const auto n = static_cast<std::size_t>(model.cloud.nodes());
  const double rate = 1e5;
  std::vector<bool> held(n, false);
  std::map<double, std::vector<NodeIndex>> at_velocity;
  for (const Facet<dim>& facet : model.cloud.facets)
    for (const NodeIndex i : facet.node) {
      if (!held[index_of(i)]) at_velocity[rate * model.cloud.position[i].y()].push_back(i);
      held[index_of(i)] = true;
    }
  std::vector<Support<dim>> supports;
  for (const auto& [velocity, nodes] : at_velocity)
    for (int k = 0; k < dim; ++k)
      supports.push_back({"side", Support<dim>::Kind::velocity, Vec<dim>::Unit(k),
                          TimeTable(k == 0 ? velocity : 0.0), nodes});
  model.supports = Supports<dim>(std::move(supports), n);
  Fields<dim> velocity;
  resize_all(velocity, n);
  for (std::size_t i = 0; i < n; ++i) velocity[0][i] = rate * model.cloud.position[i].y();
  return start<dim>(std::move(model), std::move(velocity));
}

/// C-NEM.
inline ExplicitSolver<2> sheared_block(int nodes) {
  clouds::SpacingField spacing;
  spacing.spacing = block_edge / std::sqrt(nodes * std::sqrt(0.75));
  return sheared(model_304L(testing::box({0, 0}, {block_edge, block_edge}, "side"), spacing));
}

/// On a lattice of tetrahedra whose inner nodes are moved by up to a tenth of the spacing.
inline clouds::TetrahedralBlock block_in_space(int nodes) {
  const int count = static_cast<int>(std::lround(std::cbrt(nodes))) - 1;
  const double spacing = block_edge / count;
  testing::Random random(1);
  return clouds::tetrahedral_block(
      Vec3::Constant(block_edge), {count, count, count}, [&](const Vec3& x) -> Vec3 {
        if (x.minCoeff() < 0.5 * spacing || x.maxCoeff() > block_edge - 0.5 * spacing) return x;
        return x + 0.1 * spacing * Vec3{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
      });
}

/// Median cells on the lattice, or Voronoi cells with Laplace functions on the Delaunay tetrahedra of its
/// nodes.
inline ExplicitSolver<3> sheared_block_in_space(int nodes, scni::CellKind cells) {
  clouds::TetrahedralBlock block = block_in_space(nodes);
  scni::SpaceOptions options{.cells = cells};
  if (cells == scni::CellKind::median)
    options.tetrahedra = std::move(block.tetrahedra);
  else
    block.cloud = voronoi::recover_boundary(block.cloud).cloud;
  return sheared(
      model_304L<3>(std::move(block.cloud), std::make_unique<scni::CnemInSpace>(std::move(options))));
}

} // namespace cnem::benchmarks
