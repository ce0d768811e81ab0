#include "methods/efg.hpp"

#include "cnem/moving_least_squares.hpp"
#include "core/error.hpp"
#include "core/geometry/facets.hpp"
#include "core/index.hpp"
#include "core/machine/parallel.hpp"
#include "core/operators/operator_checks.hpp"
#include "voronoi/linear_simplices.hpp"
#include "voronoi/plane/triangulation.hpp"

#include <algorithm>
#include <cassert>
#include <fmt/format.h>

namespace cnem::methods {
namespace {

constexpr std::size_t corners = 3; ///< and points of a triangle

/// The edges of all triangles, each once, and the edge of each triangle across from each corner.
struct Edges {
  std::vector<std::array<NodeIndex, 2>> ends;
  IndexedVector<SimplexIndex, std::array<std::size_t, corners>> of_triangle;
};

Edges edges_of(const voronoi::Triangulation& mesh) {
  Edges edges;
  edges.of_triangle.resize(mesh.node.size());
  for (const SimplexIndex t : mesh.node.indices())
    for (std::size_t k = 0; k < corners; ++k) {
      const SimplexIndex other = mesh.neighbour[t][k];
      if (exists(other) && other < t) {
        const auto& back = mesh.neighbour[other];
        const auto across = index_of(std::find(back.begin(), back.end(), t) - back.begin());
        edges.of_triangle[t][k] = edges.of_triangle[other][across];
      } else {
        edges.of_triangle[t][k] = edges.ends.size();
        edges.ends.push_back({mesh.node[t][(k + 1) % corners], mesh.node[t][(k + 2) % corners]});
      }
    }
  return edges;
}

/// [node] the longest of its edges, m: each point of a triangle is nearer to all of its corners.
Field longest_edges(const Cloud<2>& cloud, const Edges& edges) {
  Field longest(cloud.position.size(), 0.0);
  for (const auto& ends : edges.ends)
    for (const NodeIndex i : ends)
      longest[index_of(i)] =
          std::max(longest[index_of(i)], (cloud.position[ends[1]] - cloud.position[ends[0]]).norm());
  return longest;
}

/// Rows of the points of consecutive triangles.
struct GaussRows {
  std::vector<NodeIndex> node;
  std::vector<std::int32_t> size;
  std::vector<double> value;
  std::array<std::vector<double>, 2> gradient;

  void append(const scni::MovingLeastSquares& functions) {
    node.insert(node.end(), functions.nodes().begin(), functions.nodes().end());
    value.insert(value.end(), functions.values().begin(), functions.values().end());
    for (const Vec2& g : functions.gradients())
      for (std::size_t k = 0; k < 2; ++k) gradient[k].push_back(g[static_cast<Eigen::Index>(k)]);
    size.push_back(static_cast<std::int32_t>(functions.nodes().size()));
  }
};

DiscreteOperators<2> gauss_rows(const Cloud<2>& cloud, const voronoi::Triangulation& mesh,
                                const scni::Supports& supports) {
  constexpr double at_own_corner = 2.0 / 3.0, at_others = 1.0 / 6.0;
  DiscreteOperators<2> op;
  op.points = static_cast<int>(corners * mesh.node.size());
  op.nodes = cloud.nodes();
  op.volume.resize(index_of(op.points));
  std::vector<GaussRows> rows(blocks(mesh.node.size()));
  for_each_block(mesh.node.size(), [&](std::size_t begin, std::size_t end) {
    scni::MovingLeastSquares functions(cloud, supports);
    for (std::size_t t = begin; t < end; ++t) {
      const auto& corner = mesh.node[t];
      const std::array<Vec2, corners> x{cloud.position[corner[0]], cloud.position[corner[1]],
                                        cloud.position[corner[2]]};
      const Vec2 sum = x[0] + x[1] + x[2];
      for (std::size_t k = 0; k < corners; ++k) {
        functions.evaluate_with_gradients(at_others * sum + (at_own_corner - at_others) * x[k], corner[k]);
        rows[begin / block_size].append(functions);
        op.volume[corners * t + k] = measure<2>(x) / 3.0;
      }
    }
  });
  op.row_begin = {0};
  for (const GaussRows& block : rows) {
    for (const std::int32_t size : block.size) op.row_begin.push_back(op.row_begin.back() + size);
    op.node.insert(op.node.end(), block.node.begin(), block.node.end());
    op.value.insert(op.value.end(), block.value.begin(), block.value.end());
    for (std::size_t k = 0; k < 2; ++k)
      op.gradient[k].insert(op.gradient[k].end(), block.gradient[k].begin(), block.gradient[k].end());
  }
  op.build_transpose();
  assert(rows_are_complete(op) && reproduces_linear_fields(op, cloud.position));
  return op;
}

/// Each triangle in three: a corner, the middles of the edges that end there, and the centroid.
CellGeometry<2> thirds(const Cloud<2>& cloud, const voronoi::Triangulation& mesh, const Edges& edges) {
  CellGeometry<2> cells;
  cells.vertex_begin.push_back(0);
  const auto add_vertex = [&](const auto& nodes) {
    Vec2 sum = Vec2::Zero();
    const auto count = static_cast<double>(nodes.size());
    for (const NodeIndex i : nodes) {
      sum += cloud.position[i];
      cells.vertex_node.push_back(i);
      cells.vertex_weight.push_back(1.0 / count);
    }
    cells.vertex.push_back(sum / count);
    cells.vertex_begin.push_back(static_cast<std::int32_t>(cells.vertex_node.size()));
  };
  for (const NodeIndex i : cloud.position.indices()) add_vertex(std::array{i});
  for (const auto& ends : edges.ends) add_vertex(ends);
  for (const auto& corner : mesh.node) add_vertex(corner);
  const std::size_t first_middle = cloud.position.size(), first_centroid = first_middle + edges.ends.size();
  cells.begin.push_back(0);
  for (const SimplexIndex t : mesh.node.indices())
    for (std::size_t k = 0; k < corners; ++k) {
      for (const std::size_t vertex :
           {index_of(mesh.node[t][k]), first_middle + edges.of_triangle[t][(k + 2) % corners],
            first_centroid + index_of(t), first_middle + edges.of_triangle[t][(k + 1) % corners]})
        cells.index.push_back(static_cast<std::int32_t>(vertex));
      cells.begin.push_back(static_cast<std::int32_t>(cells.index.size()));
    }
  return cells;
}

} // namespace

Efg::Efg(double support) : support_(support) { scni::check_support(support); }

Approximation<2> Efg::rebuild(const Cloud<2>& cloud) {
  const auto mesh = voronoi::triangulate(cloud);
  const Edges edges = edges_of(mesh);
  Approximation<2> result;
  result.conduction = voronoi::linear_simplices<2>(cloud, mesh.node);
  const auto supports = scni::supports(cloud, other_ends(cloud.position.size(), edges.ends),
                                       longest_edges(cloud, edges), support_);
  result.mechanics = gauss_rows(cloud, mesh, supports);
  result.node_volume = result.mechanics.node_volume();
  for (std::size_t i = 0; i < result.node_volume.size(); ++i)
    if (!(result.node_volume[i] > 0.0))
      throw GeometryError(
          fmt::format("the node at ({:g}, {:g}) m has no mass: its functions are more negative "
                      "than positive, expected nodes that are spaced more evenly",
                      cloud.position[i].x(), cloud.position[i].y()));
  result.links.begin.assign(cloud.position.size() + 1, 0);
  result.cells = thirds(cloud, mesh, edges);
  return result;
}

} // namespace cnem::methods
