#pragma once
// The bodies that whole steps are measured on: blocks of 304L in steady simple shear at 1e5 /s, their
// boundary driven, so that every node flows.
#include "benchmarks/models.hpp"
#include "clouds/tetrahedral_block.hpp"
#include "cnem/median.hpp"
#include "tests/clouds.hpp"

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
        return x + 0.1 * spacing * Vec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
      });
}

/// Median cells.
inline ExplicitSolver<3> sheared_block_in_space(int nodes) {
  clouds::TetrahedralBlock block = block_in_space(nodes);
  return sheared(model_304L<3>(std::move(block.cloud),
                               std::make_unique<scni::MedianCells>(std::move(block.tetrahedra))));
}

/// Median cells whose rows are means of those of a node and its first two neighbours: as many entries as
/// functions on Voronoi cells have, and links of median cells.
class WideRows final : public Discretisation<3> {
public:
  explicit WideRows(std::vector<voronoi::Simplex<3>> tetrahedra) : cells_(std::move(tetrahedra)) {}

  Approximation<3> rebuild(const Cloud<3>& cloud) override {
    Approximation<3> result = cells_.rebuild(cloud);
    const DiscreteOperators<3> narrow = result.mechanics;
    DiscreteOperators<3>& wide = result.mechanics;
    wide.node.clear();
    for (Field& component : wide.gradient) component.clear();
    for (std::size_t i = 0; i < narrow.volume.size(); ++i) {
      std::map<NodeIndex, Vec3> row;
      const std::int32_t first = result.links.begin[i];
      for (const NodeIndex from : {as<NodeIndex>(i), result.links.neighbour[index_of(first)],
                                   result.links.neighbour[index_of(first + 1)]})
        for (auto e = index_of(narrow.row_begin[index_of(from)]);
             e < index_of(narrow.row_begin[index_of(from) + 1]); ++e)
          row.try_emplace(narrow.node[e], Vec3::Zero()).first->second +=
              Vec3(narrow.gradient[0][e], narrow.gradient[1][e], narrow.gradient[2][e]) / 3.0;
      for (const auto& [node, b] : row) {
        wide.node.push_back(node);
        for (std::size_t k = 0; k < 3; ++k) wide.gradient[k].push_back(b[static_cast<Eigen::Index>(k)]);
      }
      wide.row_begin[i + 1] = as<std::int32_t>(wide.node.size());
    }
    wide.build_transpose();
    return result;
  }
  std::string name() const override { return "wide_rows"; }
  Promises promises() const override { return scni::MedianCells::promised; }

private:
  scni::MedianCells cells_;
};

inline ExplicitSolver<3> sheared_block_of_wide_rows(int nodes) {
  clouds::TetrahedralBlock block = block_in_space(nodes);
  return sheared(
      model_304L<3>(std::move(block.cloud), std::make_unique<WideRows>(std::move(block.tetrahedra))));
}

} // namespace cnem::benchmarks
